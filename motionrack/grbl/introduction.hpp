// Whether who has connected is a G-code sender: before that is known nothing that it says acts.
//
//   first bytes ─┬─ only ? ! ~ ^X and ends of lines ─┐
//                ├─ a first line as a Grbl has them ─┴─► sender: all of them go on to a session
//                ├─ the begin of such a line ──────────► open: they wait for more
//                └─ anything else ─────────────────────► stranger: TLS, HTTP, SSH, binary; nothing was done
//
// A page in a browser, from wherever it is, can open a connection to any port of this computer, but not choose how it
// begins: with the 16 hex of a TLS hello, with the method of HTTP, with zeros of STUN.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::grbl {

class Introduction {
  public:
    enum class Verdict : std::uint8_t { open, sender, stranger };
    /// So many bytes without the end of a line are no sender's.
    static constexpr std::size_t max_open_bytes = 512;

    /// Needs an open verdict so far.
    Verdict hear(std::string_view bytes);
    /// All that was said so far; empties it.
    std::string take_bytes() { return std::exchange(bytes_, {}); }

  private:
    std::string bytes_;
};

}  // namespace motionrack::grbl
