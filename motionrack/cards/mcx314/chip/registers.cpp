// Bus writes and their effects.
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/chip/general_outputs.hpp>
#include <motionrack/cards/mcx314/chip/ramp.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

void Chip::reset() {
    for (int a = 0; a < axes_of_chip; ++a)
        if (state_.driving(a)) requests_.law_changed(a);
    state_.chain = state_.working = state_.in_place = 0;
    for (Axis& axis : state_.axis) {
        Axis fresh;
        fresh.levels = axis.levels;
        fresh.count = axis.count;
        fresh.made = axis.made;
        fresh.watch = axis.watch;
        fresh.pulses_wanted = axis.pulses_wanted;
        fresh.outputs_wanted = axis.outputs_wanted;
        fresh.drive_wanted = axis.drive_wanted;
        fresh.encoder_lines = axis.encoder_lines;
        fresh.shown = axis.shown;
        fresh.mark = axis.mark;
        fresh.reported_rate = axis.reported_rate;
        fresh.offset = options_.offset_after_reset;
        axis = fresh;
    }
    for (Extension& extension : state_.extension) extension = {};
    state_.selected = 1;
    state_.wr4 = state_.wr5 = state_.wr6 = state_.wr7 = state_.rr6 = state_.rr7 = 0;
    state_.held = {};
    state_.homing = state_.acting = 0;
    state_.next_sample = far;
    state_.emergency_high = kernel_.level(wires_.emergency) != 0;
    state_.queued = state_.decel_enabled = state_.path_interrupt = state_.stepping = false;
    patterns_.reset();
    state_.wr0_high = state_.step_low = 0;
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

/// Writes the bits in `mask`.
void Chip::write_bits(std::uint32_t offset, std::uint16_t value, std::uint16_t mask) {
    const Instant now = kernel_.now();
    catch_up(now);
    const MaskedWrite put{value, mask};
    if (state_.pattern.writable && offset >= reg::WR2 && offset <= reg::WR7)
        put(state_.pattern.registers[(offset - reg::WR2) / 2]);
    else if (offset == reg::WR0)
        command(value);
    else if (offset >= reg::WR1 && offset <= reg::WR3)
        for_each_axis(state_.selected, [&](int a) { write_mode(offset, a, put); });
    else if (offset == reg::WR4)
        GeneralOutputs::write(*this, put);
    else if (offset == reg::WR5)
        put(state_.wr5);
    else if (offset == reg::WR6)
        put(state_.wr6);
    else if (offset == reg::WR7)
        put(state_.wr7);
    if (state_.homing != 0) requests_.wake();  // WR2 may have ended the wait for nINPOS
    if (state_.acting != 0) act_together();
    requests_.look_anew();
    requests_.forget_specials();
    settle(now);
}

/// WR1 .. WR3 of an axis.
void Chip::write_mode(std::uint32_t offset, int a, const MaskedWrite& put) {
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

void Chip::command(std::uint16_t value) {
    if (field("WR0", "RESET").test(value)) return reset();
    const unsigned code = value & 0xFFu;
    const unsigned axes = value >> 8 & 0xFu;
    if (axes != 0) state_.selected = static_cast<std::uint16_t>(axes);
    auto each = [axes](auto&& call) {
        for (int a = 0; a < axes_of_chip; ++a)
            if (axes >> a & 1u) call(a);
    };
    auto from_to = [code](unsigned first, unsigned last) { return code >= first && code <= last; };
    if (from_to(cmd::R, cmd::AO)) {
        each([&](int a) { data_write(code, a); });
        if (code == cmd::P || code == cmd::DP || code == cmd::AO)
            each([&](int a) {
                if (state_.axis[a].gen.drive == Drive::fixed) generators_.check_final(a);
            });
    } else if (code == cmd::NOP) {
    } else if (from_to(cmd::READ_LP, cmd::READ_CA)) {
        if (axes != 0) data_read(code, state_.first_selected());
        if (extended_ && axes != 0 && code == cmd::READ_LP) conditions_.note(state_.first_selected(), sm::LPRD);
    } else if (from_to(cmd::FIXED_PLUS, cmd::CONTINUOUS_MINUS)) {
        drives_.command(code, axes);
    } else if (from_to(cmd::LINE2, cmd::BP3)) {
        drives_.path_command(code);
    } else if (from_to(cmd::BP_ENABLE, cmd::BP_CLEAR)) {
        patterns_.execute(code);
        if (code == cmd::BP_CLEAR && state_.chain != 0) requests_.law_changed_of(state_.master);
    } else if (code == cmd::STEP) {
        if (!generators_.ask_step(PathCommand::by_command)) kernel_.report(id_, step_ignored);
    } else if (code == cmd::HOLD) {
        each([&](int a) { state_.axis[a].hold = true; });
    } else if (code == cmd::START) {
        drives_.free_held(axes);
    } else if (code == cmd::SLOW_STOP || code == cmd::QUICK_STOP) {
        drives_.ask_stop(axes, code == cmd::QUICK_STOP);
    } else if (code == cmd::DECELERATION_ON) {
        state_.decel_enabled = true;
        if (state_.chain != 0) generators_.check_final(state_.master);
    } else if (code == cmd::DECELERATION_OFF) {
        state_.decel_enabled = false;
    } else if (code == cmd::INTERPOLATION_INTERRUPT_CLEAR) {
        state_.path_interrupt = state_.pattern.interrupt = false;
    } else if (!extended_ || !extended_command(code, axes)) {
        kernel_.report(id_, unknown_command, code, !extended_ && has_extended_command(code) ? 1 : 0);
    }
}

void Chip::data_write(int code, int a) {
    const std::uint32_t value = std::uint32_t{state_.wr7} << 16 | state_.wr6;
    Axis& axis = state_.axis[a];
    switch (code) {
        case cmd::R:
            axis.range = value & 0x00FF'FFFFu;
            break;
        case cmd::K:
            axis.jerk = state_.wr6;
            if (!extended_) axis.decel_jerk = state_.wr6;
            break;
        case cmd::A:
            axis.accel = state_.wr6;
            break;
        case cmd::D:
            axis.decel = state_.wr6;
            break;
        case cmd::SV:
            axis.start_speed = state_.wr6;
            generators_.set_drive_speed(a);
            break;
        case cmd::V:
            generators_.set_drive_speed(a, state_.wr6);
            break;
        case cmd::P:
            axis.pulses = extended_ ? value : value & 0x0FFF'FFFFu;
            break;
        case cmd::DP:
            axis.decel_point = extended_ ? value : value & 0x0FFF'FFFFu;
            break;
        case cmd::C:
            axis.centre = extended_ ? value : value & 0x00FF'FFFFu;
            break;
        case cmd::LP:
            axis.lp = stepped(axis, static_cast<std::int32_t>(value), 0);
            break;
        case cmd::EP:
            encoders_.set_position(a, static_cast<std::int32_t>(value));
            break;
        case cmd::COMP_PLUS:
            if (axis.ring)
                set_ring_end(a, static_cast<std::int32_t>(value));
            else
                axis.comp_plus = static_cast<std::int32_t>(value);
            break;
        case cmd::COMP_MINUS:
            axis.comp_minus = static_cast<std::int32_t>(value);
            break;
        default:
            axis.offset = state_.wr6;
            break;
    }
    if (code == cmd::LP || code == cmd::EP || code == cmd::COMP_PLUS || code == cmd::COMP_MINUS) {
        comparators_.compare(a);
        encoders_.watch(a);
    }
}

void Chip::data_read(int code, int a) {
    const Axis& axis = state_.axis[a];
    std::uint32_t value = 0;
    switch (code) {
        case cmd::READ_LP:
            value = static_cast<std::uint32_t>(axis.lp);
            break;
        case cmd::READ_EP:
            value = static_cast<std::uint32_t>(encoders_.position(axis, a));
            break;
        case cmd::READ_CV:
            value = axis.gen.drive == Drive::idle ? 0 : static_cast<std::uint32_t>(axis.gen.speed);
            break;
        default:
            value = static_cast<std::uint32_t>(axis.gen.rate);
            break;
    }
    state_.rr6 = static_cast<std::uint16_t>(value);
    state_.rr7 = static_cast<std::uint16_t>(value >> 16);
}

}  // namespace motionrack::mcx314
