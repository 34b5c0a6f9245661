// Executes list commands: vectors, arcs, delays, polylines.
#include <algorithm>
#include <motionrack/cards/rtc5/model/list_interpreter.hpp>

namespace motionrack::rtc5 {

namespace {

bool is_mark(Op op) {
    return op == Op::mark_abs || op == Op::mark_rel || op == Op::arc_abs || op == Op::arc_rel ||
           op == Op::timed_mark_abs || op == Op::timed_mark_rel;
}

}  // namespace

bool ListInterpreter::next_step(std::size_t n) {
    const std::int64_t tick = state_.tick + static_cast<std::int64_t>(n);
    Activity& a = state_.activity;
    Lists& l = state_.lists;
    while (true) {
        if (a.kind != ActivityKind::none) {
            if (a.done < a.steps) return true;
            finish(tick);
            continue;
        }
        if (!l.running) return true;
        if (l.next >= l.begin[3]) {
            if (n > 0) return false;  // a list may only end at the beginning of a block
            l.current = l.next;
            parts_.list.end(false, tick);
            continue;
        }
        const Command& c = parts_.memory[l.next];
        const ListCommandInfo& what = info(c.op);
        if (n > 0 && what.timing != Timing::shortly && what.timing != Timing::motion) return false;
        if (n > 0 && parts_.heads.wait_for_jump()) return false;  // a jump would change the transforms
        if (l.skip) {
            l.skip = 0;
            l.next += what.positions;
            continue;
        }
        l.current = l.next;
        l.next += what.positions;
        take(c, tick);
    }
}

std::size_t ListInterpreter::micro_vectors(std::size_t n, std::size_t capacity) {
    Lists& l = state_.lists;
    Activity& a = state_.activity;
    if (!l.running || l.paused || l.skip || a.kind != ActivityKind::line || a.done != a.steps ||
        a.ending != Ending::none)
        return n;
    const auto silent = [](double at) { return !(at >= 0 && at < half_us_per_tick); };
    const std::int64_t first = l.next,
                       end = std::min<std::int64_t>(l.begin[3], first + static_cast<std::int64_t>(capacity - n));
    std::int64_t at = first;
    for (; at < end; ++at, ++n) {
        const Command& c = parts_.memory[at];
        if (c.op != Op::micro_vector_abs || !silent(c.p[2]) || !silent(c.p[3])) break;
        buffers_.x[n] = c.p[0];
        buffers_.y[n] = c.p[1];
    }
    if (at == first) return n;
    l.current = at - 1;
    l.next = at;
    const Point before = at - first > 1 ? Point{buffers_.x[n - 2], buffers_.y[n - 2]} : state_.p;
    parts_.wobbel.clear_offset();
    a.from = before;
    state_.p = a.to = {buffers_.x[n - 1], buffers_.y[n - 1]};
    a.step = a.direction = a.to - before;
    return n;
}

/// Starts the activity that follows a finished one by itself, such as the delay after a jump.
void ListInterpreter::finish(std::int64_t tick) {
    const Ending ending = state_.activity.ending;
    const Activity over = state_.activity;
    state_.activity.kind = ActivityKind::none;
    state_.lists.moving_alone = 0;
    const Delays& d = parts_.path.delays();
    if (ending == Ending::laser_off) parts_.laser.switch_at(tick * half_us_per_tick, false, tick);
    if (ending == Ending::jump) parts_.path.begin_hold(parts_.path.jump_delay(over));
    if (ending != Ending::mark) return;
    state_.activity.direction = over.direction;
    bool cut = true;
    const Command* const next = next_mark();
    const std::int64_t delay = next != nullptr ? parts_.path.corner_delay(*next, cut) : d.mark;
    if (next == nullptr || cut) {
        parts_.laser.switch_at(tick * half_us_per_tick + d.laser_off, false, tick);
        state_.lists.marking = 0;
    }
    parts_.path.begin_hold(delay);
}

/// Returns the next mark command if it continues the polyline, else nullptr.
const Command* ListInterpreter::next_mark() const {
    const Lists& l = state_.lists;
    if (!l.running) return nullptr;
    for (std::int64_t at = l.next; at < l.begin[3];) {
        const Command& c = parts_.memory[at];
        if (is_mark(c.op)) return &c;
        if (info(c.op).timing != Timing::shortly && info(c.op).timing != Timing::across) return nullptr;
        at += info(c.op).positions;
    }
    return nullptr;
}

void ListInterpreter::jump_to(Point target) {
    parts_.heads.begin_jump();
    parts_.path.begin_jump(target);
}

/// Switches the laser on for a mark. Returns false if the mark must wait before it moves; its command is repeated after
/// the wait.
bool ListInterpreter::begin_polyline(std::int64_t tick) {
    if (state_.lists.marking) return true;
    state_.lists.marking = 1;
    parts_.wobbel.begin_polyline();
    const std::int64_t delay = parts_.path.delays().laser_on,
                       wait = delay < 0 ? (-delay + half_us_per_tick - 1) / half_us_per_tick : 0;
    parts_.laser.switch_at((tick + wait) * half_us_per_tick + delay, true, tick);
    if (wait == 0) return true;
    parts_.path.begin_hold(wait);
    state_.lists.next = state_.lists.current;
    return false;
}

void ListInterpreter::take(const Command& c, std::int64_t tick) {
    State& s = state_;
    const auto whole = [&](int i) { return static_cast<std::int64_t>(c.p[static_cast<std::size_t>(i)]); };
    switch (c.op) {
        case Op::none:
            return parts_.list.end(false, tick);
        case Op::set_end_of_list:
            return parts_.list.end(true, tick);
        case Op::set_jump_speed:
        case Op::set_mark_speed:
        case Op::set_scanner_delays:
        case Op::set_laser_delays:
            return parts_.path.take(c);
        case Op::laser_signal_on_list:
        case Op::laser_signal_off_list:
            return parts_.laser.switch_at(tick * half_us_per_tick, c.op == Op::laser_signal_on_list, tick);
        case Op::write_io_port_list:
            s.io = whole(0);
            return;
        case Op::set_wobbel:
            return parts_.wobbel.set(c);
        case Op::list_call:
            if (!parts_.list.call(whole(0), tick)) parts_.path.begin_hold(1);
            return;
        case Op::sub_call:
            if (!parts_.list.call(parts_.list.subroutine(whole(0)), tick)) parts_.path.begin_hold(1);
            return;
        case Op::list_return:
            if (!parts_.list.come_back()) parts_.path.begin_hold(1);
            return;
        case Op::set_trigger:
        case Op::set_trigger4:
            parts_.recorder.begin(c, tick);
            return c.op == Op::set_trigger4 ? parts_.path.begin_hold(1) : void();
        default:
            break;
    }
    if (info(c.op).timing == Timing::motion) return take_motion(c, tick);
    pipeline_command(c);
}

void ListInterpreter::take_motion(const Command& c, std::int64_t tick) {
    const auto whole = [&](int i) { return static_cast<std::int64_t>(c.p[static_cast<std::size_t>(i)]); };
    const Point target = parts_.path.target_of(c);
    const std::int64_t start = tick * half_us_per_tick;
    switch (c.op) {
        case Op::jump_abs:
        case Op::jump_rel:
            return jump_to(target);
        case Op::timed_jump_abs:
        case Op::timed_jump_rel:
            parts_.heads.begin_jump();
            return parts_.path.begin_line(target, 0, Ending::jump,
                                          std::max<std::int64_t>(1, static_cast<std::int64_t>(c.p[2] / 10)));
        case Op::mark_abs:
        case Op::mark_rel:
            if (begin_polyline(tick)) parts_.path.begin_mark(target);
            return;
        case Op::timed_mark_abs:
        case Op::timed_mark_rel:
            if (begin_polyline(tick))
                parts_.path.begin_line(target, 0, Ending::mark,
                                       std::max<std::int64_t>(1, static_cast<std::int64_t>(c.p[2] / 10)));
            return;
        case Op::arc_abs:
        case Op::arc_rel:
            if (begin_polyline(tick)) parts_.path.begin_arc(c);
            return;
        case Op::micro_vector_abs:
        case Op::micro_vector_rel: {
            const auto of_this_tick = [](double v) { return v >= 0 && v < half_us_per_tick; };
            const bool on = of_this_tick(c.p[2]), off = of_this_tick(c.p[3]);
            if (on && (!off || whole(2) < whole(3))) parts_.laser.switch_at(start + whole(2), true, tick);
            if (off) parts_.laser.switch_at(start + whole(3), false, tick);
            if (on && off && whole(3) <= whole(2)) parts_.laser.switch_at(start + whole(2), true, tick);
            return parts_.path.begin_line(target, 0, Ending::none, 1);
        }
        case Op::long_delay:
            return parts_.path.begin_hold(std::max<std::int64_t>(1, whole(0)));
        case Op::laser_on_list:
            parts_.laser.switch_at(start, true, tick);
            return parts_.path.begin_hold(std::max<std::int64_t>(1, whole(0)), Ending::laser_off);
        default:
            return parts_.path.begin_hold(1);
    }
}

}  // namespace motionrack::rtc5
