// Clears the general outputs whatever axes the host has selected, and whether or not it writes bit patterns.
#include <motionrack/cards/mcx314/chip/general_outputs.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

namespace {

/// Takes the held outputs out of a word that was written, and from those the ones that are written low. Returns those
/// that were written high.
std::uint32_t keep_low(std::uint32_t& held, const MaskedWrite& put, std::uint16_t& word) {
    held &= put.value | ~std::uint32_t{put.mask};
    word = static_cast<std::uint16_t>(word & ~held);
    return held & put.mask;
}

}  // namespace

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

void Chip::GeneralOutputs::write(Chip& chip, const MaskedWrite& put) {
    put(chip.state_.bus.wr4);
    if (const std::uint32_t low = keep_low(chip.state_.held.wr4, put, chip.state_.bus.wr4); low != 0)
        report(chip, 4, low);
    chip.outputs_.set_general_outputs();
}

void Chip::GeneralOutputs::write_modes(Chip& chip, int axis, const MaskedWrite& put) {
    std::uint16_t& word = chip.state_.axis[axis].wr3;
    put(word);
    if (const std::uint32_t low = keep_low(chip.state_.held.wr3[static_cast<std::size_t>(axis)], put, word); low != 0)
        report(chip, 3, low);
}

void Chip::GeneralOutputs::report(Chip& chip, int number, std::uint32_t low) {
    if (std::exchange(chip.state_.held.reported, 1) == 0) chip.kernel_.report(chip.id_, output_held, number, low);
}

}  // namespace motionrack::mcx314
