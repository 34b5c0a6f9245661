// Clears and writes the general outputs, independent of the selected axes and of an open bit pattern.
#include <motionrack/cards/mcx314/chip/general_outputs.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

void Chip::GeneralOutputs::clear(Chip& chip) {
    constexpr unsigned high_outputs =
        field("WR3", "OUT4").mask | field("WR3", "OUT5").mask | field("WR3", "OUT6").mask | field("WR3", "OUT7").mask;
    const Instant now = chip.kernel_.now();
    chip.catch_up(now);
    State& state = chip.state_;
    state.held.wr4 |= std::exchange(state.bus.wr4, std::uint16_t{0});
    for (std::size_t a = 0; a < state.axis.size(); ++a) {
        std::uint16_t& word = state.axis[a].wr3;
        state.held.wr3[a] |= word & high_outputs;
        word = static_cast<std::uint16_t>(word & ~high_outputs);
    }
    state.held.reported = 0;
    chip.outputs_.set_general_outputs();
    chip.settle(now);
}

void Chip::GeneralOutputs::write(Chip& chip, const sim::MaskedWrite& put) {
    report(chip, 4, sim::put_unless_held(put, chip.state_.bus.wr4, chip.state_.held.wr4));
    chip.outputs_.set_general_outputs();
}

void Chip::GeneralOutputs::write_modes(Chip& chip, int axis, const sim::MaskedWrite& put) {
    const auto a = static_cast<std::size_t>(axis);
    report(chip, 3, sim::put_unless_held(put, chip.state_.axis[a].wr3, chip.state_.held.wr3[a]));
}

void Chip::GeneralOutputs::report(Chip& chip, int number, std::uint32_t low) {
    if (low != 0 && std::exchange(chip.state_.held.reported, 1) == 0)
        chip.kernel_.report(chip.id_, output_held, number, low);
}

}  // namespace motionrack::mcx314
