// Greedy merging: a chord grows while the ends of its moves lie along it, in order, and within the tolerance.

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/base/result.hpp>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/path/segment_merger.hpp>
#include <motionrack/control/path_limits.hpp>

namespace motionrack::control {
namespace {

/// Upper bound on tolerances (mm).
constexpr double widest_tolerance = 10;

/// Distance from the axis (mm) at which the tolerance applies to a rotary axis.
constexpr double rotary_radius = 100;
constexpr double degrees_per_radian = 57.295779513082320877;

/// Default pulse for axes without pulses: mm or degrees.
constexpr double no_pulse = 1e-4;

/// The path stops where it turns by more than 120 degrees.
constexpr double sharpest_turn = -0.5;

/// The path stops at corners with a shorter blend (mm or degrees).
constexpr double min_width = 1e-6;

/// Arcs with a smaller sweep (rad) are shallow.
constexpr double shallow = 0.1;

double dot_from(const Point& a, const Point& b, int first) {
    return a[first] * b[first] + a[first + 1] * b[first + 1] + a[first + 2] * b[first + 2];
}

double finest_pulse(const MachineLimits& limits, int first) {
    double max_pulses_per_unit = 0;
    for (int i = first; i < first + 3; ++i)
        if (limits[i].present) max_pulses_per_unit = std::max(max_pulses_per_unit, limits[i].pulses_per_unit);
    return max_pulses_per_unit > 0 ? 1 / max_pulses_per_unit : no_pulse;
}

double merge_room(double tolerance, double pulse) {
    return std::clamp(pulse, min_merge_share * tolerance, max_merge_share * tolerance);
}

bool same_feed(double a, double b) {
    return a == b || std::fabs(a - b) <= 1e-9 * std::min(a, b);
}

}  // namespace

SegmentMerger::SegmentMerger(const MachineLimits& limits, const Point& start)
    : limits_(limits), half_pulse_{0.5 * finest_pulse(limits, 0), 0.5 * finest_pulse(limits, 3)}, position_(start) {}

Tolerance SegmentMerger::path_tolerance(const Move& move) const {
    if (move.path != PathControl::continuous) return half_pulse_;
    const double linear = std::min(move.tolerance_mm, widest_tolerance);
    return {std::max(linear, half_pulse_.linear),
            std::max(linear / rotary_radius * degrees_per_radian, half_pulse_.rotary)};
}

/// Returns the geometry of the move. An arc within tolerance of a line becomes a line, with the tangents of the arc if
/// it is shallow.
Geometry SegmentMerger::shape_of(const Move& move) const {
    const Geometry path = geometry_of(move, position_);
    if (path.shape != PathShape::arc) return path;
    const double turned = path.length / curvature_radius(path);
    const double height = std::min(2 * path.radius, turned * path.length / 8) * (1 + std::fabs(path.radius_growth));
    if (height > min_merge_share * path_tolerance(move).linear) return path;
    Move straight = move;
    straight.kind = MoveKind::feed;
    Geometry line = geometry_of(straight, position_);
    if (line.shape == PathShape::line && turned < shallow) {
        line.tangent_in = path.tangent_in;
        line.tangent_out = path.tangent_out;
    }
    return line;
}

Tolerance SegmentMerger::merge_tolerance(const Tolerance& tolerance) const {
    return {merge_room(tolerance.linear, 2 * half_pulse_.linear), merge_room(tolerance.rotary, 2 * half_pulse_.rotary)};
}

bool SegmentMerger::is_left_out(const Geometry& path) const {
    if (path.shape == PathShape::nothing) return true;
    if (path.shape == PathShape::arc || path.length > half_pulse_.linear) return false;
    double linear = 0, rotary = 0;
    for (int i = 0; i < axis_count; ++i) {
        double& max_distance = i < 3 ? linear : rotary;
        max_distance = std::max(max_distance, std::fabs(path.end[i] - path.start[i]));
    }
    return linear < half_pulse_.linear * left_out_share && rotary < half_pulse_.rotary * left_out_share;
}

/// Returns true if the skipped moves before an arc make it a turn longer or shorter: its start is then beyond its end.
bool SegmentMerger::turns_otherwise(const Move& move) const {
    if (move.kind != MoveKind::arc) return false;
    const Geometry own = geometry_of(move, skipped_move_.end), joined = geometry_of(move, position_);
    return std::fabs(own.length - joined.length) > pi * joined.radius;
}

/// Returns true if only the skipped moves before it make a rotary move one of XYZ, whose feed would be theirs.
bool SegmentMerger::is_rotary_alone(const Move& move, const Geometry& path) const {
    return path.shape == PathShape::line && geometry_of(move, skipped_move_.end).shape == PathShape::rotary;
}

/// Computes length and tangents of a line from `start` to `end`.
void SegmentMerger::make_line(MergedSegment& segment) const {
    Point change;
    for (int i = 0; i < axis_count; ++i) change[i] = segment.end[i] - segment.start[i];
    segment.length = segment.rotary ? std::max({std::fabs(change[3]), std::fabs(change[4]), std::fabs(change[5])})
                                    : std::sqrt(dot_from(change, change, 0));
    for (int i = 0; i < axis_count; ++i) segment.tangent_in[i] = segment.tangent_out[i] = change[i] / segment.length;
}

MergedSegment SegmentMerger::segment_of(const Move& move, const Geometry& path) const {
    MergedSegment segment;
    segment.kind = MergedSegmentKind::line;
    segment.rotary = path.shape == PathShape::rotary;
    segment.line = move.line;
    segment.start = path.start;
    segment.end = path.end;
    segment.tolerance = path_tolerance(move);
    Point components;
    if (path.shape == PathShape::arc) {
        segment.kind = MergedSegmentKind::arc;
        segment.arc = ArcCurve(path);
        segment.length = segment.arc.length();
        segment.tangent_in = segment.arc.at(0).tangent;
        segment.tangent_out = segment.arc.at(segment.length).tangent;
        components = max_tangent_components(path);
    } else {
        if (move.kind == MoveKind::arc) segment.merged = merge_tolerance(segment.tolerance);
        make_line(segment);
        components = segment.tangent_in;
    }
    const double max_velocity = max_velocity_along(components, limits_);
    if (move.kind == MoveKind::rapid)
        segment.feed =
            move.rapid_override < 1 ? move.rapid_override * max_velocity : std::numeric_limits<double>::infinity();
    else
        segment.feed = move.feed_mode == FeedMode::inverse_time ? move.feed * segment.length : move.feed;
    segment.velocity = std::min(segment.feed, max_velocity);
    return segment;
}

/// Returns true if the path stops between the last move and this one.
bool SegmentMerger::stops_between(const Geometry& path, const MergedSegment& segment) const {
    if (!open_ || stop_left_out_ || last_move_.path == PathControl::exact_stop || segment.rotary != last_.rotary)
        return true;
    const Point& in = last_tangent_;
    const Point& out = path.tangent_in;
    if (is_same_direction(in, out)) return false;
    if (last_move_.path == PathControl::exact_path) return true;
    const int first = segment.rotary ? 3 : 0;
    if (dot_from(in, out, first) < sharpest_turn * std::sqrt(dot_from(in, in, first) * dot_from(out, out, first)))
        return true;
    return !has_width(segment, in, out);
}

/// Returns true if the blend between the last segment and this one is long enough.
bool SegmentMerger::has_width(const MergedSegment& segment, const Point& in, const Point& out) const {
    double linear = 0, rotary = 0;
    for (int i = 0; i < axis_count; ++i) {
        double& max_change = i < 3 ? linear : rotary;
        max_change = std::max(max_change, std::fabs(out[i] - in[i]));
    }
    const Tolerance tolerance{std::min(last_.tolerance.linear, segment.tolerance.linear),
                              std::min(last_.tolerance.rotary, segment.tolerance.rotary)};
    return tolerance.linear >= min_width * linear && tolerance.rotary >= min_width * rotary;
}

/// Returns the largest distance of the path from the sides of the corner at a stop between these segments. Rotary axes
/// move in proportion.
double SegmentMerger::corner_tolerance(const MergedSegment& before, const MergedSegment& after) const {
    if (before.rotary || after.rotary) return 0;
    double tolerance = corner_share * std::min(before.tolerance.linear, after.tolerance.linear) - before.merged.linear;
    const double rotary =
        corner_share * std::min(before.tolerance.rotary, after.tolerance.rotary) - before.merged.rotary;
    for (std::size_t i = 3; i < before.tangent_out.size(); ++i) {
        const double turned = std::max(std::fabs(before.tangent_out[i]), std::fabs(after.tangent_in[i]));
        if (turned > 0) tolerance = std::min(tolerance, rotary / turned);
    }
    return std::max(0.0, tolerance);
}

/// Returns the blend length of the corner: as long as its tolerance allows, but within its moves.
double SegmentMerger::width_between(const MergedSegment& before, const MergedSegment& after) const {
    double linear = 0, rotary = 0;
    for (std::size_t i = 0; i < before.tangent_out.size(); ++i) {
        const double change = std::fabs(after.tangent_in[i] - before.tangent_out[i]);
        if (i < 3)
            linear += change * change;
        else
            rotary = std::max(rotary, change);
    }
    double width = std::min(before.length, after.length);
    if (linear > 0)
        width = std::min(
            width, corner_share * 12 * std::min(before.tolerance.linear, after.tolerance.linear) / std::sqrt(linear));
    if (rotary > 0)
        width = std::min(width, corner_share * 12 * std::min(before.tolerance.rotary, after.tolerance.rotary) / rotary);
    return width;
}

Junction SegmentMerger::junction_joining(PendingSegment& before, const MergedSegment& after) const {
    Junction junction;
    if (!after.tangent) {
        const LegLimits leg_in = leg_of(before.segment), leg_out = leg_of(after);
        const Point &in = before.segment.tangent_out, &out = after.tangent_in;
        junction = junction_between(leg_in, leg_out, in, out, width_between(before.segment, after), limits_);
        if (!junction.can_stop || before.segment.kind == MergedSegmentKind::arc || after.kind == MergedSegmentKind::arc)
            return junction;
        before.corner_tolerance_mm = corner_tolerance(before.segment, after);
        before.stop = corner_stop_between(leg_in, leg_out, in, out, before.corner_tolerance_mm, limits_);
        junction.gain = before.stop.gain;
        return junction;
    }
    junction.can_stop = false;
    junction.can_pass = true;
    junction.velocity = std::numeric_limits<double>::infinity();
    return junction;
}

LegLimits SegmentMerger::leg_of(const MergedSegment& segment) const {
    LegLimits leg{segment.length, segment.velocity, max_accel_along(segment.tangent_in, limits_),
                  max_jerk_along(segment.tangent_in, limits_)};
    if (segment.kind != MergedSegmentKind::arc) return leg;
    for (const Point& tangent : {segment.tangent_out, segment.arc.at(0.5 * segment.length).tangent}) {
        leg.accel = std::min(leg.accel, max_accel_along(tangent, limits_));
        leg.jerk = std::min(leg.jerk, max_jerk_along(tangent, limits_));
    }
    leg.velocity = std::min(leg.velocity, std::sqrt(max_curvature_share * leg.accel / segment.arc.max_curvature()));
    return leg;
}

void SegmentMerger::push(const Move& move) {
    MOTIONRACK_ASSERT(made_ - taken_ + max_a_push <= capacity);
    if (move.kind == MoveKind::dwell) {
        rest(move.seconds, move.line);
        return;
    }
    if (any_left_out_ && turns_otherwise(move)) add_left_out();
    Geometry path = shape_of(move);
    if (is_left_out(path)) {
        any_left_out_ = true;
        skipped_move_ = move;
        stop_left_out_ = stop_left_out_ || move.path == PathControl::exact_stop;
        return;
    }
    MergedSegment segment = segment_of(move, path);
    bool rests = stops_between(path, segment);
    if (any_left_out_ && (rests || is_rotary_alone(move, path))) {
        add_left_out();
        path = shape_of(move);
        segment = segment_of(move, path);
        rests = rests || stops_between(path, segment);
    }
    any_left_out_ = stop_left_out_ = false;
    if (rests || !merge(move, segment)) {
        if (rests && open_) {
            const double tolerance = last_move_.path == PathControl::continuous ? corner_tolerance(last_, segment) : 0;
            rest(0, last_move_.line);
            segments_[(made_ - 1) % capacity].corner_tolerance_mm = tolerance;
        }
        close();
        segment.tangent = !rests && is_same_direction(last_tangent_, path.tangent_in);
        last_ = segment;
        open_ = true;
        inner_count_ = 0;
    }
    last_move_ = move;
    last_tangent_ = path.tangent_out;
    position_ = move.end;
}

/// Extends the last segment by a line if everything in it then lies along the result.
bool SegmentMerger::merge(const Move& move, const MergedSegment& next) {
    const bool alike = last_.kind == MergedSegmentKind::line && next.kind == MergedSegmentKind::line &&
                       move.kind != MoveKind::arc && move.kind == last_move_.kind && move.path == last_move_.path &&
                       inner_count_ < max_merged && next.tolerance.linear == last_.tolerance.linear &&
                       same_feed(next.feed, last_.feed);
    if (!alike || !lies_along(next.end, next)) return false;
    inner_[inner_count_++] = last_.end;
    last_.merged = merge_tolerance(last_.tolerance);
    last_.end = next.end;
    make_line(last_);
    last_.feed = std::min(last_.feed, next.feed);
    last_.velocity = std::min(last_.velocity, next.velocity);
    return true;
}

bool SegmentMerger::lies_along(const Point& end, const MergedSegment& next) const {
    const int first = next.rotary ? 3 : 0;
    const Tolerance tolerance = merge_tolerance(next.tolerance);
    const double near = next.rotary ? tolerance.rotary : tolerance.linear;
    Point change;
    for (int i = 0; i < axis_count; ++i) change[i] = end[i] - last_.start[i];
    const double square = dot_from(change, change, first);
    if (!(square > near * near)) return false;
    double done = 0;
    for (std::size_t k = 0; k <= inner_count_; ++k) {
        const Point& at = k < inner_count_ ? inner_[k] : last_.end;
        Point delta;
        for (int i = 0; i < axis_count; ++i) delta[i] = at[i] - last_.start[i];
        const double part = dot_from(delta, change, first) / square;
        if (!(part > done && part < 1)) return false;
        done = part;
        for (int i = 0; i < axis_count; ++i) delta[i] -= part * change[i];
        if (dot_from(delta, delta, first) > near * near) return false;
        for (int i = 3; i < axis_count; ++i)
            if (std::fabs(delta[i]) > tolerance.rotary) return false;
    }
    return true;
}

/// Before a stop: adds the skipped moves to the last line, or as a line of their own.
void SegmentMerger::add_left_out() {
    any_left_out_ = stop_left_out_ = false;
    Move move = skipped_move_;
    if (move.kind == MoveKind::arc) move.kind = MoveKind::feed;
    const Geometry path = geometry_of(move, position_);
    if (path.shape == PathShape::nothing) return;
    const bool rotary = path.shape == PathShape::rotary;
    if (open_ && last_.kind == MergedSegmentKind::line && last_.length > 1000 * path.length &&
        (rotary || !last_.rotary)) {
        last_.end = position_ = move.end;
        make_line(last_);
        return;
    }
    if (open_) rest(0, last_move_.line);
    position_ = move.end;
    last_move_ = move;
    last_ = segment_of(move, path);
    if (!rotary && move.kind != MoveKind::rapid && move.feed_mode == FeedMode::units_per_second) {
        // Some of the skipped moves may be rotary, with this feed as their own.
        double turned = 0;
        for (int i = 3; i < axis_count; ++i) turned = std::max(turned, std::fabs(path.end[i] - path.start[i]));
        if (turned > path.length) last_.feed *= path.length / turned;
        last_.velocity = std::min(last_.velocity, last_.feed);
    }
    open_ = true;
    inner_count_ = 0;
}

/// Completes the last segment: it waits until it is known whether the path stops at its end.
void SegmentMerger::close() {
    if (!open_) return;
    open_ = false;
    if (waiting_ == waiting_past_) {
        choice_.begin();
    } else {
        PendingSegment& before = waiting(waiting_past_ - 1);
        choice_.add(leg_of(before.segment), junction_joining(before, last_));
    }
    waiting(waiting_past_++) = {last_, last_move_.line, 0, {}};
    make_decided();
}

void SegmentMerger::make_decided() {
    while (choice_.decided() > 0) {
        PendingSegment& ended = waiting(waiting_++);
        const bool stops = choice_.take() && waiting_ < waiting_past_;
        if (stops) {
            ended.segment.ease_out = ended.stop.before;
            waiting(waiting_).segment.ease_in = ended.stop.after;
        }
        make(ended.segment);
        if (stops) make_rest(0, ended.last_line, ended.corner_tolerance_mm, ended.segment.end);
    }
}

void SegmentMerger::make_rest(double seconds, std::int32_t line, double corner_tolerance_mm, const Point& at) {
    MergedSegment segment;
    segment.seconds = seconds;
    segment.line = line;
    segment.corner_tolerance_mm = corner_tolerance_mm;
    segment.start = segment.end = at;
    make(segment);
}

void SegmentMerger::rest(double seconds, std::int32_t line) {
    if (any_left_out_) add_left_out();
    close();
    if (waiting_ < waiting_past_) {
        choice_.add(leg_of(waiting(waiting_past_ - 1).segment), Junction{});
        make_decided();
    }
    make_rest(seconds, line, 0, position_);
}

void SegmentMerger::flush() {
    if (any_left_out_) add_left_out();
    if (open_) rest(0, last_move_.line);
}

}  // namespace motionrack::control
