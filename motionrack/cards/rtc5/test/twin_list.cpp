// The twin of the RTC5: lists and paths.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/test/twin.hpp>

namespace motionrack::rtc5::twin {

namespace {

std::int64_t step_count(double length, double step) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(length / step * (1 - std::ldexp(1.0, -40)))));
}
bool any_of(Op op, std::initializer_list<Op> ops) {
    return std::find(ops.begin(), ops.end(), op) != ops.end();
}
bool marks(Op op) {
    return any_of(op, {Op::mark_abs, Op::mark_rel, Op::timed_mark_abs, Op::timed_mark_rel, Op::arc_abs, Op::arc_rel});
}
/// Returns true if a polyline continues through the command.
bool goes_through(Op op) {
    return any_of(op, {Op::set_jump_speed, Op::set_mark_speed, Op::set_scanner_delays, Op::set_laser_delays,
                       Op::set_trigger, Op::set_wobbel});
}

}  // namespace

Xy Twin::target(const Command& c) const {
    if (!any_of(c.op, {Op::mark_rel, Op::jump_rel, Op::timed_mark_rel, Op::timed_jump_rel, Op::arc_rel,
                       Op::micro_vector_rel}))
        return {c.p[0], c.p[1]};
    return {std::clamp(p.x + c.p[0], -8388608.0, 8388607.0), std::clamp(p.y + c.p[1], -8388608.0, 8388607.0)};
}

void Twin::list() {
    while (true) {
        if (doing.what != Doing::nothing && doing.done == doing.steps) after();
        if (doing.what != Doing::nothing) break;
        if (!running) return;
        if (next >= begins[3]) {
            current = next;
            end_list(false);
            continue;
        }
        const Command c = memory[static_cast<std::size_t>(next)];
        const int positions = c.op == Op::wait_for_encoder_in_range || c.op == Op::set_matrix_list ? 2 : 1;
        if (!skip) current = next;
        next += positions;
        if (skip)
            skip = false;
        else
            take(c);
    }
    if (doing.what == Doing::wait) {
        doing.done = wait_over();
        return;
    }
    ++doing.done;
    const double i = static_cast<double>(doing.done);
    if (doing.what == Doing::line)
        p = doing.done == doing.steps ? doing.to : Xy{doing.from.x + i * doing.step.x, doing.from.y + i * doing.step.y};
    if (doing.what == Doing::arc) {
        const SinCos t = sin_cos(i * doing.step.x);
        p = {doing.to.x + (t.cos * doing.from.x - t.sin * doing.from.y),
             doing.to.y + (t.sin * doing.from.x + t.cos * doing.from.y)};
    }
}

void Twin::end_list(bool written) {
    skip = false;
    returns.clear();
    unwritten += !written;
    if (written && (auto_change || loop) && current < begins[2] && changed_at != now) {
        auto_change = false;
        changed_at = now;
        next = current < begins[1] ? begins[1] : begins[0];
        return;
    }
    running = false;
}

void Twin::after() {
    const Doing over = doing;
    doing = {};
    alone = false;
    if (over.ending == 'l') change_laser(now * 20, false);
    if (over.ending == 'j') {
        const double dx = over.to.x - over.from.x, dy = over.to.y - over.from.y, length = std::sqrt(dx * dx + dy * dy);
        std::int64_t delay = jump_delay;
        if (jump_limit > 0 && length < jump_limit && min_jump < jump_delay)
            delay = whole(std::floor(static_cast<double>(min_jump) +
                                     static_cast<double>(jump_delay - min_jump) * (length / jump_limit) + 0.5));
        hold(delay);
    }
    if (over.ending != 'm') return;
    std::int64_t at = next;
    while (running && at < begins[3] && goes_through(memory[static_cast<std::size_t>(at)].op)) ++at;
    const bool goes_on = running && at < begins[3] && marks(memory[static_cast<std::size_t>(at)].op);
    std::int64_t delay = goes_on ? polygon_delay : mark_delay;
    bool off = !goes_on;
    if (goes_on && variable_polygon) {
        const Command& c = memory[static_cast<std::size_t>(at)];
        const Xy to = target(c);
        Xy d{to.x - p.x, to.y - p.y};
        if (c.op == Op::arc_abs || c.op == Op::arc_rel) {
            const Xy r{p.x - to.x, p.y - to.y};
            d = c.p[2] > 0 ? Xy{r.y, -r.x} : Xy{-r.y, r.x};
        }
        const Xy b = over.direction;
        const double lengths = std::sqrt(b.x * b.x + b.y * b.y) * std::sqrt(d.x * d.x + d.y * d.y);
        const double cosine = lengths > 0 ? (b.x * d.x + b.y * d.y) / lengths : 1;
        delay = whole(std::floor(static_cast<double>(polygon_delay) * (1 - cosine) + 0.5));
        off = edge_level > 0 && delay > edge_level;
    }
    if (off) {
        change_laser(now * 20 + laser_off, false);
        marking_line = false;
    }
    hold(delay);
}

void Twin::hold(std::int64_t n, char ending) {
    if (n <= 0) return;
    doing = {};
    doing.what = Doing::hold;
    doing.steps = n;
    doing.ending = ending;
}

void Twin::line_to(Xy to, double speed, char ending, std::int64_t steps) {
    doing = {};
    doing.what = Doing::line;
    doing.ending = ending;
    const double dx = to.x - p.x, dy = to.y - p.y;
    doing.steps = steps > 0 ? steps : step_count(std::sqrt(dx * dx + dy * dy), speed / 100);
    doing.from = p;
    doing.to = to;
    doing.step = {dx / static_cast<double>(doing.steps), dy / static_cast<double>(doing.steps)};
    doing.direction = {dx, dy};
}

void Twin::mark(const Command& c) {
    if (!marking_line) {
        marking_line = true;
        wobbel_step = 0;
        wobbel_direction = {1, 0};
        const std::int64_t wait = laser_on < 0 ? (-laser_on + 19) / 20 : 0;
        change_laser((now + wait) * 20 + laser_on, true);
        if (wait > 0) {
            next = current;
            return hold(wait);
        }
    }
    if (c.op == Op::mark_abs || c.op == Op::mark_rel) return line_to(target(c), mark_speed, 'm');
    if (c.op == Op::timed_mark_abs || c.op == Op::timed_mark_rel)
        return line_to(target(c), 0, 'm', std::max<std::int64_t>(1, whole(c.p[2] / 10)));
    const Xy middle = target(c), r{p.x - middle.x, p.y - middle.y};
    const double a = -c.p[2] * (pi / 180);
    doing = {};
    doing.what = Doing::arc;
    doing.ending = 'm';
    doing.steps = step_count(std::abs(a) * std::sqrt(r.x * r.x + r.y * r.y), mark_speed / 100);
    doing.from = r;
    doing.to = middle;
    doing.step.x = a / static_cast<double>(doing.steps);
    const SinCos t = sin_cos(a);
    const Xy e{t.cos * r.x - t.sin * r.y, t.sin * r.x + t.cos * r.y};
    doing.direction = c.p[2] > 0 ? Xy{e.y, -e.x} : Xy{-e.y, e.x};
}

void Twin::take(const Command& c) {
    const double* const v = c.p.data();
    if (marks(c.op)) return mark(c);
    if (c.op >= Op::if_fly_x_overflow && c.op <= Op::if_not_fly_z_overflow) {
        skip = !condition(c);
        return;
    }
    switch (c.op) {
        case Op::none:
            return end_list(false);
        case Op::set_end_of_list:
            return end_list(true);
        case Op::list_nop:
            return hold(1);
        case Op::long_delay:
            return hold(std::max<std::int64_t>(1, whole(v[0])));
        case Op::laser_on_list:
            change_laser(now * 20, true);
            return hold(std::max<std::int64_t>(1, whole(v[0])), 'l');
        case Op::laser_signal_on_list:
            return change_laser(now * 20, true);
        case Op::laser_signal_off_list:
            return change_laser(now * 20, false);
        case Op::jump_abs:
        case Op::jump_rel:
            return jump(target(c));
        case Op::timed_jump_abs:
        case Op::timed_jump_rel: {
            const Xy to = target(c);
            jump(to);
            return line_to(to, 0, 'j', std::max<std::int64_t>(1, whole(v[2] / 10)));
        }
        case Op::micro_vector_abs:
        case Op::micro_vector_rel: {
            std::vector<std::pair<double, bool>> changes_here;
            if (v[3] >= 0 && v[3] < 20) changes_here.push_back({v[3], false});
            if (v[2] >= 0 && v[2] < 20) changes_here.push_back({v[2], true});
            std::stable_sort(changes_here.begin(), changes_here.end(),
                             [](auto& a, auto& b) { return a.first < b.first; });
            for (const auto& [at, on] : changes_here) change_laser(now * 20 + whole(at), on);
            return line_to(target(c), 0, 0, 1);
        }
        case Op::set_jump_speed:
            jump_speed = v[0];
            return;
        case Op::set_mark_speed:
            mark_speed = v[0];
            return;
        case Op::set_scanner_delays:
            jump_delay = whole(v[0]), mark_delay = whole(v[1]), polygon_delay = whole(v[2]);
            return;
        case Op::set_laser_delays:
            laser_on = whole(v[0]), laser_off = whole(v[1]);
            return;
        case Op::write_io_port_list:
            io = whole(v[0]);
            return;
        case Op::set_rot_center_list:
            centre = {v[0], v[1]};
            return;
        case Op::store_encoder:
            for (int e = 0; e < 2; ++e) stored[whole(v[0]) * 2 + e] = encoders[e].count();
            return;
        case Op::set_fly_limits:
            for (int i = 0; i < 4; ++i) limits[i] = whole(v[i]);
            return;
        case Op::set_fly_limits_z:
            limits[4] = whole(v[0]), limits[5] = whole(v[1]);
            return;
        case Op::clear_fly_overflow:
            if (v[0] == 0 || whole(v[0]) & 1) marking &= ~0x30u;
            if (v[0] == 0 || whole(v[0]) & 2) marking &= ~0xC0u;
            if (v[0] == 0 || whole(v[0]) & 4) marking &= ~0x3000000u;
            return;
        case Op::set_ext_start_delay_list:
            start_delay = whole(v[0]), start_encoder = static_cast<int>(v[1]);
            return;
        case Op::simulate_ext_start:
            if (asked.size() < 8)
                asked.push_back({0, whole(v[0]), static_cast<int>(v[1])});
            else
                startstop |= 1u << 11;
            return;
        case Op::set_control_mode_list:
            control = static_cast<std::uint32_t>(v[0]);
            return;
        case Op::set_encoder_speed:
            watch_speed = true;
            smooth = v[2];
            for (Counter& e : encoders) e.slow1 = e.slow2 = 0;
            return;
        case Op::set_mcbsp_in_list:
            return set_mcbsp_in(static_cast<int>(v[0]), v[1]);
        case Op::set_multi_mcbsp_in_list:
            return set_multi();
        case Op::get_mcbsp_list:
            if (heard) locations[0] = static_cast<std::int32_t>(word);
            return;
        case Op::set_mcbsp_x_list:
            return set_one_online(0, v[0]);
        case Op::set_mcbsp_y_list:
            return set_one_online(1, v[0]);
        case Op::set_mcbsp_rot_list:
            return set_one_online(2, v[0]);
        case Op::set_mcbsp_matrix_list:
            return set_online_matrix();
        case Op::apply_mcbsp_list:
            return apply_online(c.head, static_cast<int>(v[0]));
        case Op::set_wobbel:
            across = v[0], along = v[1], wobbel_turns = v[2] / 100000;
            wobbel_step = 0;
            wobbel_direction = {1, 0};
            return;
        case Op::list_call:
            return call(whole(v[0]));
        case Op::sub_call:
            return call(subroutines[whole(v[0])] == 0 ? -1 : subroutines[whole(v[0])]);
        case Op::list_return:
            if (returns.empty()) return hold(1);
            next = returns.back();
            returns.pop_back();
            return;
        case Op::set_trigger:
            return set_trigger(c);
        case Op::set_trigger4:
            set_trigger(c);
            return hold(1);
        case Op::set_matrix_list:
        case Op::set_offset_list:
        case Op::set_angle_list:
        case Op::set_scale_list:
            return transform_command(c);
        case Op::wait_for_encoder:
        case Op::wait_for_encoder_mode:
        case Op::wait_for_encoder_in_range:
        case Op::wait_for_mcbsp:
            doing = {};
            doing.what = Doing::wait;
            doing.steps = 1;
            doing.command = c;
            return;
        default:
            return fly_command(c);
    }
}

}  // namespace motionrack::rtc5::twin
