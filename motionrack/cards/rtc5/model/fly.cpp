// Commands of the pipeline: corrections on and off, waits, conditions, parking.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

namespace {

Point through(const Transform& t, Point p) {
    if (t.neutral) return p;
    return {t.product[0] * p.x + t.product[1] * p.y + t.offset.x, t.product[2] * p.x + t.product[3] * p.y + t.offset.y};
}

}  // namespace

void Engine::pipeline_command(const Command& c) {
    State& s = state_;
    const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(c.p[i]); };
    if (fly_command(c)) return;
    switch (c.op) {
        case Op::set_rot_center_list:
            s.rot_center = {c.p[0], c.p[1]};
            return;
        case Op::store_encoder:
            return encoders_.store(static_cast<std::size_t>(whole(0)));
        case Op::wait_for_encoder:
        case Op::wait_for_encoder_mode:
        case Op::wait_for_encoder_in_range:
        case Op::wait_for_mcbsp:
            return wait(c);
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
    Starts& s = state_.starts;
    switch (c.op) {
        case Op::set_ext_start_delay_list:
            s.delay = whole(0), s.encoder = whole(1);
            return;
        case Op::simulate_ext_start:
            if (s.asked_count < start_queue)
                s.asked[static_cast<std::size_t>(s.asked_count++)] = {0, whole(0), whole(1)};
            else
                flags_.raise_startstop(startstop_bit("START_LOST"));
            return;
        case Op::set_control_mode_list:
            state_.control_mode = whole(0);
            return;
        case Op::set_encoder_speed:
            static_cast<void>(set_encoder_speed(static_cast<int>(c.p[0]), c.p[1], c.p[2]));
            return;
        case Op::set_mcbsp_in_list:
            mcbsp_in(static_cast<int>(c.p[0]), c.p[1]);
            return;
        case Op::set_multi_mcbsp_in_list:
            static_cast<void>(set_multi_mcbsp_in(static_cast<int>(whole(0)), whole(1), static_cast<int>(whole(2))));
            return;
        case Op::get_mcbsp_list:
            static_cast<void>(get_mcbsp());
            return;
        case Op::set_mcbsp_x_list:
        case Op::set_mcbsp_y_list:
        case Op::set_mcbsp_rot_list:
            return set_online(static_cast<std::size_t>(c.op) - static_cast<std::size_t>(Op::set_mcbsp_x_list), c.p[0]);
        case Op::set_mcbsp_matrix_list:
            return set_mcbsp_matrix();
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
            leave_fly();
            if (c.op == Op::fly_return_z) state_.z = c.p[2];
            jump_to({c.p[0], c.p[1]});
            return true;
        default:
            return false;
    }
    set_fly(c);
    begin_hold(1);
    return true;
}

void Engine::set_fly(const Command& c) {
    Fly& f = state_.fly;
    const auto axis = [&](FlyKind kind, bool y) {
        be_kind(kind);
        (y ? f.y : f.x) = c.p[0] != 0;
        (y ? f.scale_y : f.scale_x) = c.p[0];
    };
    const auto both = [&](FlyKind kind) {
        be_kind(kind);
        f.x = c.p[0] != 0, f.y = c.p[1] != 0;
        f.scale_x = c.p[0], f.scale_y = c.p[1];
    };
    switch (c.op) {
        case Op::set_fly_x:
            axis(FlyKind::encoder, false);
            break;
        case Op::set_fly_y:
            axis(FlyKind::encoder, true);
            break;
        case Op::set_fly_x_pos:
            axis(FlyKind::mcbsp, false);
            break;
        case Op::set_fly_y_pos:
            axis(FlyKind::mcbsp, true);
            break;
        case Op::set_fly_z:
            be_kind(FlyKind::encoder);
            f.z = c.p[0] != 0, f.scale_z = c.p[0], f.z_encoder = static_cast<std::int64_t>(c.p[1]);
            break;
        case Op::set_fly_rot:
            return turn(FlyKind::encoder_rot, c.p[0]);
        case Op::set_fly_rot_pos:
            return turn(FlyKind::mcbsp_rot, c.p[0]);
        case Op::activate_fly_xy:
            both(FlyKind::encoder);
            break;
        case Op::activate_fly_2d:
            if (fly_table_ == nullptr) return flags_.raise(marking_bit("ACTIVATE_FLY_ERROR"), state_.tick);
            both(FlyKind::encoder_2d);
            break;
        default:
            both(FlyKind::encoder_2d);
            break;
    }
    settle_kind();
}

void Engine::be_kind(FlyKind kind) {
    if (state_.fly.kind != kind) state_.fly = Fly{kind};
}

void Engine::settle_kind() {
    const Fly& f = state_.fly;
    if (!f.x && !f.y && !f.z) state_.fly = Fly{};
}

void Engine::turn(FlyKind kind, double resolution) {
    state_.fly = Fly{};
    if (std::abs(resolution) < min_resolution) return;
    state_.fly.kind = kind;
    state_.fly.resolution = resolution;
}

void Engine::mcbsp_in(int mode, double scale) {
    mcbsp_.begin_axis_correction(mode);
    state_.fly = Fly{FlyKind::mcbsp, mode & 1, mode >> 1 & 1};
    state_.fly.scale_x = state_.fly.scale_y = scale;
    if (scale == 0) state_.fly = Fly{};
    settle_kind();
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
    begin_hold(1);
    return true;
}

/// Position of `p` after the correction in this tick; backwards: the position that the correction maps to `p`.
Point Engine::fly_of(Point p, bool backwards) const {
    const Fly& f = state_.fly;
    double value[2] = {0, 0};
    switch (f.kind) {
        case FlyKind::off:
            return p;
        case FlyKind::encoder:
        case FlyKind::encoder_rot:
            value[0] = encoders_.effective(0), value[1] = encoders_.effective(1);
            break;
        case FlyKind::encoder_2d: {
            const double a = encoders_.effective(0) + state_.fly_2d_offset.x,
                         b = encoders_.effective(1) + state_.fly_2d_offset.y;
            const FlyTable::Shift shift = fly_table_ != nullptr ? fly_table_->at(a, b) : FlyTable::Shift{};
            value[0] = a + shift.x, value[1] = b + shift.y;
            break;
        }
        default: {
            const Point now = mcbsp_.now();
            value[0] = now.x, value[1] = now.y;
        }
    }
    if (f.kind == FlyKind::encoder_rot || f.kind == FlyKind::mcbsp_rot) {
        const SinCos t = sin_cos(turn_of(value[0], f.resolution));
        const double s = backwards ? -t.sin : t.sin, c = t.cos;
        const Point d = p - state_.rot_center;
        return {state_.rot_center.x + (c * d.x - s * d.y), state_.rot_center.y + (s * d.x + c * d.y)};
    }
    const double sign = backwards ? -1 : 1;
    if (f.x) p.x += sign * (f.scale_x * value[0]);
    if (f.y) p.y += sign * (f.scale_y * value[1]);
    return p;
}

/// Adds the correction to p (so that the correction can be switched off), or removes it.
void Engine::move_by_fly(bool backwards) {
    if (!state_.fly.on()) return;
    const Point g = through(heads_.global(), state_.p), offset = fly_of(g, backwards) - g;
    state_.p = {clipped(state_.p.x + offset.x, Kind::coordinate), clipped(state_.p.y + offset.y, Kind::coordinate)};
}

void Engine::leave_fly() {
    move_by_fly(false);
    state_.fly = Fly{};
    state_.paused_fly = Fly{};
    state_.parked = 0;
}

void Engine::park(const Command& c) {
    State& s = state_;
    Point target{c.p[1], c.p[2]};
    if (c.op == Op::park_position) {
        s.park_from = s.p;
        if (c.p[0] == 0 && s.fly.on()) {
            const Fly paused = s.fly;
            leave_fly();
            s.paused_fly = paused;
            s.parked = 1;
        }
    } else {
        if (s.parked) {
            s.fly = s.paused_fly;
            s.parked = 0;
            move_by_fly(true);
        }
        if (c.p[0] == 0) target = s.park_from;
    }
    jump_to(target);
}

void Engine::wait(const Command& c) {
    Activity& a = state_.activity;
    a.kind = c.op == Op::wait_for_mcbsp              ? ActivityKind::wait_mcbsp
             : c.op == Op::wait_for_encoder_in_range ? ActivityKind::wait_range
                                                     : ActivityKind::wait_encoder;
    a.ending = Ending::none;
    a.done = 0;
    a.steps = 1;
    for (std::size_t i = 0; i < 4; ++i) a.value[i] = static_cast<std::int64_t>(c.p[i]);
    if (c.op == Op::wait_for_encoder) a.value[2] = 0;
    if (c.op == Op::wait_for_mcbsp) std::swap(a.value[0], a.value[1]);  // value, axis, mode
}

}  // namespace motionrack::rtc5
