// Executes accesses of the bus to the registers.
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/chip/general_outputs.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

void Chip::reset() {
    for (int a = 0; a < axes_of_chip; ++a)
        if (state_.driving(a)) requests_.law_changed(a);
    state_.chain = state_.working = state_.in_place = 0;
    for (Axis& axis : state_.axis) axis.reset(options_.offset_after_reset);
    for (Extension& extension : state_.extension) extension = {};
    state_.bus.reset();
    state_.held = {};
    state_.homing = state_.acting = 0;
    state_.sampling.reset();
    state_.emergency_high = kernel_.level(wires_.emergency) != 0;
    state_.queued = state_.decel_enabled = state_.path_interrupt = false;
    state_.steps.reset();
    patterns_.reset();
    state_.wr0_high = 0;
    inputs_.hear_step_wire(kernel_.level(wires_.step));
    // An input may be connected to an output of the chip, which then reads the chip: its state is consistent here.
    for (int a = 0; a < axes_of_chip; ++a) {
        encoders_.set_position(a, 0);
        inputs_.set_wants(a);
        encoders_.watch(a);
    }
    for (int a = 0; a < axes_of_chip; ++a) comparators_.compare(a);
    outputs_.set_general_outputs();
}

// ---- writing

void Chip::write(std::uint32_t offset, std::uint16_t value) {
    write_bits(offset, value, 0xFFFF);
}

void Chip::write_byte(std::uint32_t port, std::uint8_t value) {
    const bool high = (port & 1u) != 0;
    if (port == 1)
        state_.wr0_high = value;
    else if (port == 0)
        write_bits(reg::WR0, static_cast<std::uint16_t>(state_.wr0_high << 8 | value), 0xFFFF);
    else
        write_bits(port & ~1u, static_cast<std::uint16_t>(high ? value << 8 : value), high ? 0xFF00 : 0x00FF);
}

/// Writes the bits in `mask` of the register at `offset`.
void Chip::write_bits(std::uint32_t offset, std::uint16_t value, std::uint16_t mask) {
    const Instant now = kernel_.now();
    catch_up(now);
    const sim::MaskedWrite put{value, mask};
    if (state_.pattern.writable && offset >= reg::WR2 && offset <= reg::WR7)
        put(state_.pattern.registers[(offset - reg::WR2) / 2]);
    else if (offset == reg::WR0)
        field("WR0", "RESET").test(value) ? reset() : commands_.execute(value);
    else if (offset >= reg::WR1 && offset <= reg::WR3)
        for_each_axis(state_.bus.selected, [&](int a) { write_mode(offset, a, put); });
    else if (offset == reg::WR4)
        GeneralOutputs::write(*this, put);
    else if (offset == reg::WR5)
        put(state_.bus.wr5);
    else if (offset == reg::WR6)
        put(state_.bus.wr6);
    else if (offset == reg::WR7)
        put(state_.bus.wr7);
    if (state_.homing != 0) requests_.wake();  // WR2 may have ended the wait for nINPOS
    if (state_.acting != 0) actions_.act();
    requests_.look_anew();
    requests_.forget_specials();
    settle(now);
}

/// Writes WR1, WR2 or WR3 of axis `a`.
void Chip::write_mode(std::uint32_t offset, int a, const sim::MaskedWrite& put) {
    Axis& axis = state_.axis[a];
    if (offset == reg::WR3) {
        const std::uint16_t before = axis.wr3;
        GeneralOutputs::write_modes(*this, a, put);
        return external_.change_mode(a, before);
    }
    if (offset == reg::WR1) {
        // The counter has moved without comparisons while they were disabled: only later changes count.
        comparators_.compare(a);
        put(axis.wr1);
        conditions_.hear_comparisons(a);
    } else {
        const std::int32_t ep_now = encoders_.position(axis, a);
        put(axis.wr2);
        encoders_.set_position(a, ep_now);  // the edge ratio may have changed
        comparators_.compare(a);
    }
    inputs_.set_wants(a);
    encoders_.watch(a);
}

// ---- reading

std::uint16_t Chip::read(std::uint32_t offset) {
    const Instant now = kernel_.now();
    catch_up(now);
    const std::uint16_t value = peek(offset);
    if (offset == reg::RR3) interrupts_.clear(0xFFFF);
    settle(now);
    return value;
}

std::uint8_t Chip::read_byte(std::uint32_t port) {
    const Instant now = kernel_.now();
    catch_up(now);
    const bool high = (port & 1u) != 0;
    const unsigned value = peek(port & ~1u);
    if ((port & ~1u) == reg::RR3) interrupts_.clear(high ? 0xFF00 : 0x00FF);
    settle(now);
    return static_cast<std::uint8_t>(high ? value >> 8 : value);
}

}  // namespace motionrack::mcx314
