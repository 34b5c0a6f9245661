// Commands of WR0: what each code does with the axes that it names.
#include <motionrack/cards/mcx314/chip/chip_conditions.hpp>
#include <motionrack/cards/mcx314/chip/command_executor.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

void CommandExecutor::execute(std::uint16_t value) {
    const unsigned code = value & 0xFFu;
    const unsigned axes = value >> 8 & 0xFu;
    if (axes != 0) state_.bus.selected = static_cast<std::uint16_t>(axes);
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
    } else if (!extended_ || !execute_extended(code, axes)) {
        kernel_.report(id_, unknown_command, code, !extended_ && has_extended(code) ? 1 : 0);
    }
}

void CommandExecutor::data_write(int code, int a) {
    const std::uint32_t value = std::uint32_t{state_.bus.wr7} << 16 | state_.bus.wr6;
    Axis& axis = state_.axis[a];
    switch (code) {
        case cmd::R:
            axis.range = value & 0x00FF'FFFFu;
            break;
        case cmd::K:
            axis.jerk = state_.bus.wr6;
            if (!extended_) axis.decel_jerk = state_.bus.wr6;
            break;
        case cmd::A:
            axis.accel = state_.bus.wr6;
            break;
        case cmd::D:
            axis.decel = state_.bus.wr6;
            break;
        case cmd::SV:
            axis.start_speed = state_.bus.wr6;
            generators_.set_drive_speed(a);
            break;
        case cmd::V:
            generators_.set_drive_speed(a, state_.bus.wr6);
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
            axis.offset = state_.bus.wr6;
            break;
    }
    if (code == cmd::LP || code == cmd::EP || code == cmd::COMP_PLUS || code == cmd::COMP_MINUS) {
        comparators_.compare(a);
        encoders_.watch(a);
    }
}

void CommandExecutor::data_read(int code, int a) {
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
    state_.bus.rr6 = static_cast<std::uint16_t>(value);
    state_.bus.rr7 = static_cast<std::uint16_t>(value >> 16);
}

}  // namespace motionrack::mcx314
