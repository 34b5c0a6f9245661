// Writes commands with their data as register accesses, for all hosts of the tests and benchmarks: on a chip or its
// twin.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

/// `Host` must have write(number, value), which writes WR0 .. WR7.
template <class Host>
class Commands {
  public:
    void command(unsigned axes, unsigned code) { host().write(0, axes << 8 | code); }
    void data(unsigned axes, unsigned code, std::int64_t value) {
        const auto bits = static_cast<std::uint32_t>(value);
        host().write(7, bits >> 16);
        host().write(6, bits & 0xFFFFu);
        command(axes, code);
    }
    /// Writes WR1, WR2 or WR3 (`number`) of axes.
    void mode(unsigned axes, int number, unsigned value) {
        command(axes, cmd::NOP);
        host().write(number, value);
    }

  private:
    Host& host() { return static_cast<Host&>(*this); }
};

}  // namespace motionrack::mcx314
