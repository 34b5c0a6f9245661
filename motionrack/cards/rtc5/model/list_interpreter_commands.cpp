// Executes the list commands of the pipeline: corrections on and off, waits, conditions, parking.
#include <motionrack/cards/rtc5/model/list_interpreter.hpp>

namespace motionrack::rtc5 {

void ListInterpreter::pipeline_command(const Command& c) {
    State& s = state_;
    const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(c.p[i]); };
    if (fly_command(c)) return;
    switch (c.op) {
        case Op::set_rot_center_list:
            return parts_.fly.turn_about({c.p[0], c.p[1]});
        case Op::store_encoder:
            return parts_.encoders.store(static_cast<std::size_t>(whole(0)));
        case Op::wait_for_encoder:
        case Op::wait_for_encoder_mode:
        case Op::wait_for_encoder_in_range:
        case Op::wait_for_mcbsp:
            return parts_.path.begin_wait(c);
        case Op::set_fly_limits:
        case Op::set_fly_limits_z:
            return parts_.flags.set_limits(c);
        case Op::clear_fly_overflow:
            return parts_.flags.clear_limit_flags(whole(0));
        case Op::park_position:
        case Op::park_return:
            return park(c);
        case Op::set_matrix_list:
        case Op::set_offset_list:
        case Op::set_angle_list:
        case Op::set_scale_list:
            return parts_.heads.take(c);
        default:
            break;
    }
    if (c.op >= Op::if_fly_x_overflow && c.op <= Op::if_not_fly_z_overflow)
        s.lists.skip = !parts_.flags.take_condition(c);
    else
        control_command(c);
}

/// Executes a list command that is the list form of a control command.
void ListInterpreter::control_command(const Command& c) {
    const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(c.p[i]); };
    switch (c.op) {
        case Op::set_ext_start_delay_list:
            return parts_.starts.set_delay(whole(0), whole(1));
        case Op::simulate_ext_start:
            return parts_.starts.ask(whole(0), whole(1));
        case Op::set_control_mode_list:
            state_.control_mode = whole(0);
            return;
        case Op::set_encoder_speed:
            static_cast<void>(parts_.encoders.watch_speed(static_cast<int>(c.p[0]), c.p[1], c.p[2]));
            return;
        case Op::set_mcbsp_in_list:
            parts_.fly.correct_axes(static_cast<int>(c.p[0]), c.p[1]);
            return;
        case Op::set_multi_mcbsp_in_list:
            static_cast<void>(
                parts_.fly.set_multi_mcbsp_in(static_cast<int>(whole(0)), whole(1), static_cast<int>(whole(2))));
            return;
        case Op::get_mcbsp_list:
            static_cast<void>(parts_.mcbsp.store_now());
            return;
        case Op::set_mcbsp_x_list:
        case Op::set_mcbsp_y_list:
        case Op::set_mcbsp_rot_list:
            return parts_.fly.set_online(
                static_cast<std::size_t>(c.op) - static_cast<std::size_t>(Op::set_mcbsp_x_list), c.p[0]);
        case Op::set_mcbsp_matrix_list:
            return parts_.fly.set_mcbsp_matrix();
        case Op::apply_mcbsp_list:
            static_cast<void>(parts_.heads.apply(parts_.mcbsp, c.head, static_cast<int>(c.p[0])));
            return;
        default:
            return;
    }
}

/// Executes a command that switches a correction on or off. Returns true if it is such a command and has its own tick.
bool ListInterpreter::fly_command(const Command& c) {
    switch (c.op) {
        case Op::set_fly_x:
            if (empty_cycle({0})) return true;
            break;
        case Op::set_fly_y:
            if (empty_cycle({1})) return true;
            break;
        case Op::set_fly_z:
            if (empty_cycle({static_cast<std::size_t>(c.p[1])})) return true;
            break;
        case Op::set_fly_rot:
            if (empty_cycle({0})) return true;
            break;
        case Op::set_fly_2d:
            if (empty_cycle({0, 1})) return true;
            break;
        case Op::set_fly_x_pos:
        case Op::set_fly_y_pos:
        case Op::set_fly_rot_pos:
            parts_.mcbsp.begin_correction();
            break;
        case Op::activate_fly_xy:
        case Op::activate_fly_2d:
            break;
        case Op::fly_return:
        case Op::fly_return_z:
            state_.p = parts_.fly.leave(state_.p, parts_.heads.global());
            if (c.op == Op::fly_return_z) parts_.fly.set_z(c.p[2]);
            jump_to({c.p[0], c.p[1]});
            return true;
        default:
            return false;
    }
    parts_.fly.take(c);
    parts_.path.begin_hold(1);
    return true;
}

/// Zeroes the encoders, or requests this for the next external start if control_reset_at_start is set. Returns true if,
/// with a tracking error, one tick passes first and the command is repeated.
bool ListInterpreter::empty_cycle(std::initializer_list<std::size_t> encoders) {
    Lists& l = state_.lists;
    if (l.again) {
        l.again = 0;
        return false;
    }
    bool needed = false;
    for (const std::size_t e : encoders) {
        if (state_.control_mode & control_reset_at_start)
            parts_.encoders.zero_at_start(e);
        else
            parts_.encoders.zero(e);
        needed = needed || parts_.encoders.tracking_error(e) != 0;
    }
    if (!needed) return false;
    l.again = 1;
    l.next = l.current;
    parts_.path.begin_hold(1);
    return true;
}

void ListInterpreter::park(const Command& c) {
    Point& p = state_.p;
    Point target{c.p[1], c.p[2]};
    if (c.op == Op::park_position) {
        p = parts_.fly.park(p, parts_.heads.global(), c.p[0] == 0);
    } else {
        p = parts_.fly.end_parking(p, parts_.heads.global());
        if (c.p[0] == 0) target = parts_.fly.park_from();
    }
    jump_to(target);
}

}  // namespace motionrack::rtc5
