// A small host for the twin: a function call for the register accesses of a command.
#pragma once

#include <motionrack/cards/mcx314/test/commands.hpp>
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

class Host : public Commands<Host> {
  public:
    void write(int number, unsigned value) {
        twin.write(static_cast<std::uint32_t>(2 * number), static_cast<std::uint16_t>(value));
    }
    /// Writes R, V, SV, A, D, K and AO of some axes.
    void speeds(unsigned axes, std::int64_t r, std::int64_t v, std::int64_t sv, std::int64_t a, std::int64_t d,
                std::int64_t k, std::int64_t ao) {
        data(axes, 0x00, r);
        data(axes, 0x05, v);
        data(axes, 0x04, sv);
        data(axes, 0x02, a);
        data(axes, 0x03, d);
        data(axes, 0x01, k);
        data(axes, 0x0D, ao);
    }
    /// Runs until no axis drives, at most `max_ticks` ticks; returns the ticks needed.
    std::int64_t until_idle(std::int64_t max_ticks) {
        const std::int64_t from = twin.now();
        while (twin.any_driving() && twin.now() - from < max_ticks) twin.tick();
        return twin.now() - from;
    }

    Twin twin;
};

}  // namespace motionrack::mcx314::twin
