// Decides whether a new connection is a G-code sender; before that, its input has no effect.
//
//   first bytes ─┬─ only ? ! ~ ^X and ends of lines ─┐
//                ├─ a first line as sent to a Grbl ──┴─► sender: all bytes are passed to a session
//                ├─ the start of such a line ─────────► open: the bytes wait for more
//                └─ anything else ─────────────────────► stranger: TLS, HTTP, SSH, binary; nothing was done
//
// A browser page of any origin can open a connection to any port of this computer, and choose the method and the target
// of an HTTP request: "$X", "G1X9", "!". It cannot choose the end of the request's first line, HTTP/1.1, or the first
// bytes of other protocols: the 16 hex of a TLS hello, the zeros of STUN.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::grbl {

class Introduction {
  public:
    enum class Verdict : std::uint8_t { open, sender, stranger };
    /// Limit of bytes without a line end from a sender.
    static constexpr std::size_t max_open_bytes = 512;

    /// Adds received bytes and returns the verdict. Requires that the verdict so far is open.
    Verdict receive(std::string_view bytes);
    /// Returns all bytes received and clears them.
    std::string take_bytes() { return std::exchange(bytes_, {}); }

  private:
    std::string bytes_;
};

}  // namespace motionrack::grbl
