// Begins lines, arcs, delays and waits, and computes their positions.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/path_generator.hpp>
#include <utility>

namespace motionrack::rtc5 {

namespace {

constexpr double nearly = 1 - 0x1p-40;  // reduces a number of steps before it is rounded up: tolerates rounding errors

std::int64_t steps_for(double length, double step) {
    const double steps = std::ceil(length / step * nearly);
    return steps < 1 ? 1 : static_cast<std::int64_t>(steps);
}

bool is_relative(Op op) {
    return op == Op::jump_rel || op == Op::mark_rel || op == Op::arc_rel || op == Op::timed_jump_rel ||
           op == Op::timed_mark_rel || op == Op::micro_vector_rel;
}

}  // namespace

Result<void> PathGenerator::set_delays(const Delays& d) {
    struct Item {
        std::string_view name;
        std::int64_t ticks;
    };
    for (const Item& item : {Item{"Jump", d.jump}, Item{"Mark", d.mark}, Item{"Polygon", d.polygon},
                             Item{"EdgeLevel", d.edge_level}, Item{"MinJumpDelay", d.min_jump}})
        MOTIONRACK_CHECK(check_parameter("", item.name, static_cast<double>(item.ticks), Kind::ticks));
    const KindInfo laser = kind_info(Kind::half_us);
    MOTIONRACK_CHECK(check_parameter("", "LaserOnDelay", static_cast<double>(d.laser_on), Kind::half_us));
    MOTIONRACK_CHECK(check_parameter("", "LaserOffDelay", static_cast<double>(d.laser_off), 0, laser.max, laser.unit));
    MOTIONRACK_CHECK(check_parameter("", "JumpLengthLimit", d.jump_limit, 0, 16777215, "bits"));
    settings_.delays = d;
    return {};
}

void PathGenerator::set_jump_speed(double bits_ms) {
    if (std::isfinite(bits_ms)) settings_.jump_speed = clipped(bits_ms, Kind::speed);
}
void PathGenerator::set_mark_speed(double bits_ms) {
    if (std::isfinite(bits_ms)) settings_.mark_speed = clipped(bits_ms, Kind::speed);
}

void PathGenerator::take(const Command& c) {
    PathSettings& s = settings_;
    const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(c.p[i]); };
    if (c.op == Op::set_jump_speed) s.jump_speed = c.p[0];
    if (c.op == Op::set_mark_speed) s.mark_speed = c.p[0];
    if (c.op == Op::set_scanner_delays) s.delays.jump = whole(0), s.delays.mark = whole(1), s.delays.polygon = whole(2);
    if (c.op == Op::set_laser_delays) s.delays.laser_on = whole(0), s.delays.laser_off = whole(1);
}

Point PathGenerator::direction_of(const Command& mark) const {
    if (mark.op != Op::arc_abs && mark.op != Op::arc_rel) return target_of(mark) - p_;
    const Point radius = p_ - target_of(mark);
    return mark.p[2] > 0 ? Point{radius.y, -radius.x} : Point{-radius.y, radius.x};
}

std::int64_t PathGenerator::corner_delay(const Command& next, bool& cut) const {
    const Delays& d = settings_.delays;
    cut = false;
    if (!d.variable_polygon) return d.polygon;
    const Point a = activity_.direction, b = direction_of(next);
    const double lengths = std::sqrt(a.x * a.x + a.y * a.y) * std::sqrt(b.x * b.x + b.y * b.y);
    const double cosine = lengths > 0 ? (a.x * b.x + a.y * b.y) / lengths : 1;
    const auto delay = static_cast<std::int64_t>(std::floor(static_cast<double>(d.polygon) * (1 - cosine) + 0.5));
    cut = d.edge_level > 0 && delay > d.edge_level;
    return delay;
}

std::int64_t PathGenerator::jump_delay(const Activity& jump) const {
    const Delays& d = settings_.delays;
    const Point delta = jump.to - jump.from;
    const double length = std::sqrt(delta.x * delta.x + delta.y * delta.y);
    if (!(length < d.jump_limit && d.min_jump < d.jump)) return d.jump;
    return static_cast<std::int64_t>(std::floor(
        static_cast<double>(d.min_jump) + static_cast<double>(d.jump - d.min_jump) * (length / d.jump_limit) + 0.5));
}

Point PathGenerator::target_of(const Command& c) const {
    if (!is_relative(c.op)) return {c.p[0], c.p[1]};
    return {clipped(p_.x + c.p[0], Kind::coordinate), clipped(p_.y + c.p[1], Kind::coordinate)};
}

void PathGenerator::begin_hold(std::int64_t ticks, Ending ending) {
    if (ticks <= 0) return;
    Activity& a = activity_;
    a.kind = ActivityKind::hold;
    a.ending = ending;
    a.done = 0;
    a.steps = ticks;
}

void PathGenerator::begin_line(Point target, double speed, Ending ending, std::int64_t steps) {
    Activity& a = activity_;
    const Point delta = target - p_;
    const double length = std::sqrt(delta.x * delta.x + delta.y * delta.y);
    a.kind = ActivityKind::line;
    a.ending = ending;
    a.done = 0;
    a.steps = steps > 0 ? steps : steps_for(length, speed / 100);
    a.from = p_;
    a.to = target;
    const double n = static_cast<double>(a.steps);
    a.step = {delta.x / n, delta.y / n};
    a.direction = delta;
}

void PathGenerator::begin_arc(const Command& c) {
    Activity& a = activity_;
    const Point centre = target_of(c), radius = p_ - centre;
    const double angle = -c.p[2] * (pi / 180), length = std::sqrt(radius.x * radius.x + radius.y * radius.y);
    a.kind = ActivityKind::arc;
    a.ending = Ending::mark;
    a.done = 0;
    a.steps = steps_for(std::abs(angle) * length, settings_.mark_speed / 100);
    a.from = radius;
    a.to = centre;
    a.step = {angle / static_cast<double>(a.steps), 0};
    const SinCos t = sin_cos(angle);
    const Point end = {t.cos * radius.x - t.sin * radius.y, t.sin * radius.x + t.cos * radius.y};
    a.direction = c.p[2] > 0 ? Point{end.y, -end.x} : Point{-end.y, end.x};
}

void PathGenerator::begin_wait(const Command& c) {
    Activity& a = activity_;
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

std::size_t PathGenerator::fill(std::size_t n, std::size_t capacity) {
    Activity& a = activity_;
    double *const x = &buffers_.x[n], *const y = &buffers_.y[n];
    std::size_t m = capacity - n;
    switch (a.kind) {
        case ActivityKind::none:
            break;
        case ActivityKind::line:
            m = static_cast<std::size_t>(std::min<std::int64_t>(a.steps - a.done, static_cast<std::int64_t>(m)));
            kernels::line(x, y, m, a.from, a.step, a.done + 1);
            a.done += static_cast<std::int64_t>(m);
            if (a.done == a.steps) x[m - 1] = a.to.x, y[m - 1] = a.to.y;
            p_ = {x[m - 1], y[m - 1]};
            wobbel_.add(x, y, m, a.done - static_cast<std::int64_t>(m) + 1);
            return n + m;
        case ActivityKind::arc:
            m = static_cast<std::size_t>(std::min<std::int64_t>(a.steps - a.done, static_cast<std::int64_t>(m)));
            for (std::size_t i = 0; i < m; ++i) {
                const Point p = a.position(++a.done, p_);
                x[i] = p.x, y[i] = p.y;
            }
            p_ = {x[m - 1], y[m - 1]};
            wobbel_.add(x, y, m, a.done - static_cast<std::int64_t>(m) + 1);
            return n + m;
        case ActivityKind::hold:
            m = static_cast<std::size_t>(std::min<std::int64_t>(a.steps - a.done, static_cast<std::int64_t>(m)));
            a.done += static_cast<std::int64_t>(m);
            break;
        default: {
            bool over = false;
            m = static_cast<std::size_t>(wait_.ticks(static_cast<std::int64_t>(m), over));
            if (over) a.done = a.steps;
        }
    }
    kernels::hold(x, y, m, p_);
    wobbel_.add(x, y, m, 0);
    return n + m;
}

void PathGenerator::stay(std::size_t n, std::size_t capacity) {
    wobbel_.clear_offset();
    kernels::hold(&buffers_.x[n], &buffers_.y[n], capacity - n, p_);
}

}  // namespace motionrack::rtc5
