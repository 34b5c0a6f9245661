// A running rack as programs outside of it use it: by names and plain numbers, every mistake an error, nothing aborts.
//
//   outside ──► Session ──► card's bus, registers by name
//                      ──► Kernel: time
//
// What the C interface (motionrack/c.h) gives to other languages; one thread at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <string>
#include <string_view>

namespace motionrack::rack {

class Session {
  public:
    /// Reads a rack file (a path, or the text itself: see read_rack), builds the rack and starts it. Errors: bad_input
    /// with everything that is wrong, a line each; io.
    static Result<std::unique_ptr<Session>> open(std::string_view path_or_text);
    ~Session();

    Rack& rack() { return rack_; }

    // ---- time ----
    /// Lets the world run for `ns` nanoseconds, 0 .. most_ns. Errors: refused beyond that, and beyond latest.
    Result<void> advance(std::uint64_t ns);
    std::uint64_t now_ns() const { return static_cast<std::uint64_t>(now().count()) / 10; }
    static constexpr std::uint64_t most_ns = 1'000'000'000'000'000;
    static constexpr Instant latest{never.count() / 2};

    // ---- the bus ----
    /// One access of the host's bus: it takes the card's bus time. `bits`: 8, 16, 32. Errors: bad_input (there is no
    /// such card), refused (the card has no accesses of that width, nothing at that address).
    Result<std::uint32_t> read(std::string_view card, int bits, std::uint32_t address);
    Result<void> write(std::string_view card, int bits, std::uint32_t address, std::uint32_t value);

  private:
    explicit Session(const RackConfig& config);
    Instant now() const { return rack_.kernel().now(); }
    Result<Card*> find_card(std::string_view name);
    Result<Card*> bus_of(std::string_view card, int bits, std::uint32_t address, bool writing);
    Result<void> room_for(Duration time) const;
    void run_to(Instant until);

    Rack rack_;
    std::unique_ptr<WireTap> tap_;
};

}  // namespace motionrack::rack
