// Clears the general outputs whatever axes the host has selected, and whether or not it writes bit patterns.
#include <motionrack/cards/mcx314/chip/general_outputs.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

void Chip::GeneralOutputs::clear(Chip& chip) {
    constexpr unsigned high_outputs =
        field("WR3", "OUT4").mask | field("WR3", "OUT5").mask | field("WR3", "OUT6").mask | field("WR3", "OUT7").mask;
    const Instant now = chip.kernel_.now();
    chip.catch_up(now);
    chip.state_.wr4 = 0;
    for (Axis& axis : chip.state_.axis) axis.wr3 = static_cast<std::uint16_t>(axis.wr3 & ~high_outputs);
    chip.update_outputs();
    chip.settle(now);
}

}  // namespace motionrack::mcx314
