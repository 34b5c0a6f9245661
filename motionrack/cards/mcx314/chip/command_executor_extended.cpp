// Commands of the MCX314As only: its modes, rings, speeds of a home search and conditions.
#include <motionrack/cards/mcx314/chip/command_executor.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

bool CommandExecutor::has_extended(int code) {
    for (const CommandInfo& command : map::commands)
        if (command.variant == map::as_only && static_cast<int>(command.code) == code) return true;
    return false;
}

/// Executes a command that only the MCX314As has; returns false if `code` is not one.
bool CommandExecutor::execute_extended(int code, unsigned axes) {
    if (!has_extended(code)) return false;
    if (code == cmd::READ_BR) {
        const std::uint32_t value = state_.extension[state_.first_selected()].buffer;
        if (axes == 0) return true;
        state_.bus.rr6 = static_cast<std::uint16_t>(value);
        state_.bus.rr7 = static_cast<std::uint16_t>(value >> 16);
        return true;
    }
    for_each_axis(axes, [&](int a) { write_extended(code, a); });
    return true;
}

void CommandExecutor::write_extended(int code, int a) {
    Extension& ext = state_.extension[a];
    switch (code) {
        case cmd::L:
            state_.axis[a].decel_jerk = state_.bus.wr6;
            break;
        case cmd::EM:
            set_extension(a);
            break;
        case cmd::HV:
            ext.hv = state_.bus.wr6;
            generators_.set_drive_speed(a);
            break;
        case cmd::HOME:
            homes_.start(a);
            break;
        case cmd::DCC:
            homes_.ask_clear(a);
            break;
        case cmd::SM:
            comparators_.compare(a);  // unsubscribed comparisons are not evaluated
            ext.sm6 = state_.bus.wr6;
            ext.sm7 = state_.bus.wr7;
            conditions_.hear_comparisons(a);
            inputs_.set_wants(a);
            encoders_.watch(a);
            ext.sampled = state_.axis[a].levels;
            break;
        default:
            conditions_.note(a, sm::CMD);
            break;
    }
}

/// Command 60h: stores WR6 and WR7 as the extension mode EM6, EM7 of axis `a`.
void CommandExecutor::set_extension(int a) {
    Extension& ext = state_.extension[a];
    Axis& axis = state_.axis[a];
    const std::int32_t position = encoders_.position(axis, a);
    ext.em6 = state_.bus.wr6;
    ext.em7 = state_.bus.wr7;
    axis.ring = em::VRING.test(ext.em6);
    axis.lp = stepped(axis, axis.lp, 0);
    encoders_.set_position(a, position);
    comparators_.compare(a);
    filters_.set(a);
    encoders_.watch(a);
}

/// Sets COMP+, the highest count of axis `a` in ring mode.
void CommandExecutor::set_ring_end(int a, std::int32_t value) {
    Axis& axis = state_.axis[a];
    const std::int32_t position = encoders_.position(axis, a);
    axis.comp_plus = value;
    axis.lp = stepped(axis, axis.lp, 0);
    encoders_.set_position(a, position);
}

}  // namespace motionrack::mcx314
