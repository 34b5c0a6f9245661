// List commands of the pipeline: corrections on and off, waits, conditions, parking.
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <utility>

namespace motionrack::rtc5 {

void Engine::pipeline_command(const Command& c) {
    State& s = state_;
    const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(c.p[i]); };
    if (fly_command(c)) return;
    switch (c.op) {
        case Op::set_rot_center_list:
            return fly_.turn_about({c.p[0], c.p[1]});
        case Op::store_encoder:
            return encoders_.store(static_cast<std::size_t>(whole(0)));
        case Op::wait_for_encoder:
        case Op::wait_for_encoder_mode:
        case Op::wait_for_encoder_in_range:
        case Op::wait_for_mcbsp:
            return path_.begin_wait(c);
        case Op::set_fly_limits:
        case Op::set_fly_limits_z:
            return flags_.set_limits(c);
        case Op::clear_fly_overflow:
            return flags_.clear_limit_flags(whole(0));
        case Op::park_position:
        case Op::park_return:
            return park(c);
        case Op::set_matrix_list:
        case Op::set_offset_list:
        case Op::set_angle_list:
        case Op::set_scale_list:
            return heads_.take(c);
        default:
            break;
    }
    if (c.op >= Op::if_fly_x_overflow && c.op <= Op::if_not_fly_z_overflow)
        s.lists.skip = !flags_.take_condition(c);
    else
        control_command(c);
}

/// Executes commands that are list forms of control commands.
void Engine::control_command(const Command& c) {
    const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(c.p[i]); };
    switch (c.op) {
        case Op::set_ext_start_delay_list:
            return starts_.set_delay(whole(0), whole(1));
        case Op::simulate_ext_start:
            return starts_.ask(whole(0), whole(1));
        case Op::set_control_mode_list:
            state_.control_mode = whole(0);
            return;
        case Op::set_encoder_speed:
            static_cast<void>(set_encoder_speed(static_cast<int>(c.p[0]), c.p[1], c.p[2]));
            return;
        case Op::set_mcbsp_in_list:
            fly_.correct_axes(static_cast<int>(c.p[0]), c.p[1]);
            return;
        case Op::set_multi_mcbsp_in_list:
            static_cast<void>(
                fly_.set_multi_mcbsp_in(static_cast<int>(whole(0)), whole(1), static_cast<int>(whole(2))));
            return;
        case Op::get_mcbsp_list:
            static_cast<void>(get_mcbsp());
            return;
        case Op::set_mcbsp_x_list:
        case Op::set_mcbsp_y_list:
        case Op::set_mcbsp_rot_list:
            return fly_.set_online(static_cast<std::size_t>(c.op) - static_cast<std::size_t>(Op::set_mcbsp_x_list),
                                   c.p[0]);
        case Op::set_mcbsp_matrix_list:
            return fly_.set_mcbsp_matrix();
        case Op::apply_mcbsp_list:
            static_cast<void>(apply_mcbsp(c.head, static_cast<int>(c.p[0])));
            return;
        default:
            return;
    }
}

/// Executes commands that switch corrections on or off. Returns true if it was one; it has its own tick.
bool Engine::fly_command(const Command& c) {
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
            mcbsp_.begin_correction();
            break;
        case Op::activate_fly_xy:
        case Op::activate_fly_2d:
            break;
        case Op::fly_return:
        case Op::fly_return_z:
            state_.p = fly_.leave(state_.p, heads_.global());
            if (c.op == Op::fly_return_z) fly_.set_z(c.p[2]);
            jump_to({c.p[0], c.p[1]});
            return true;
        default:
            return false;
    }
    fly_.take(c);
    path_.begin_hold(1);
    return true;
}

/// Zeroes the encoders. Returns true if, with a tracking error, one tick passes first and the command is repeated.
bool Engine::empty_cycle(std::initializer_list<std::size_t> encoders) {
    Lists& l = state_.lists;
    if (l.again) {
        l.again = 0;
        return false;
    }
    bool needed = false;
    for (const std::size_t e : encoders) {
        if (state_.control_mode & control_reset_at_start)
            encoders_.zero_at_start(e);
        else
            encoders_.zero(e);
        needed = needed || encoders_.tracking_error(e) != 0;
    }
    if (!needed) return false;
    l.again = 1;
    l.next = l.current;
    path_.begin_hold(1);
    return true;
}

void Engine::park(const Command& c) {
    Point& p = state_.p;
    Point target{c.p[1], c.p[2]};
    if (c.op == Op::park_position) {
        p = fly_.park(p, heads_.global(), c.p[0] == 0);
    } else {
        p = fly_.end_parking(p, heads_.global());
        if (c.p[0] == 0) target = fly_.park_from();
    }
    jump_to(target);
}

}  // namespace motionrack::rtc5
