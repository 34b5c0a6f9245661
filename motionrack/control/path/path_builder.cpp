// Segments end at the knots of all blends. Each starts at the position on the programmed polygon plus the contribution
// of the blends there, so that rounding errors do not accumulate.

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/base/result.hpp>
#include <motionrack/control/path/path_builder.hpp>

namespace motionrack::control {
namespace {

/// Segments shorter than this share of u are rounding errors of the same knot, and skipped.
constexpr double curve_rounding = 4e-16;

Point cubic(const Point& a, const Point& b, const Point& c, const Point& d, double x) {
    Point out;
    for (int i = 0; i < axis_count; ++i) out[i] = a[i] + x * (b[i] + x * (0.5 * c[i] + x * (1.0 / 6) * d[i]));
    return out;
}

double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns an upper bound on the XYZ velocity on the segment for du/dt = 1, or on that of the fastest rotary axis if
/// only ABC move.
double max_velocity_on(const CubicSegment& piece, bool rotary) {
    const double x = piece.length;
    if (rotary) {
        double max_velocity = 0;
        const Point out = tangent_on(piece, x);
        for (int i = 3; i < axis_count; ++i) {
            const double middle = piece.tangent[i] + 0.5 * x * piece.curvature[i];
            const double beyond = std::max(std::fabs(piece.tangent[i]), std::fabs(out[i]));
            max_velocity = std::max({max_velocity, beyond, 0.5 * (std::fabs(middle) + beyond)});
        }
        return max_velocity;
    }
    const Point out = tangent_on(piece, x);
    // half the second derivative of the square is a + b x + c x^2
    const double a = dot(piece.curvature, piece.curvature) + dot(piece.tangent, piece.curvature_rate);
    const double b = 3 * dot(piece.curvature, piece.curvature_rate);
    const double c = 1.5 * dot(piece.curvature_rate, piece.curvature_rate);
    double min_derivative = std::min(a, a + x * (b + x * c));
    if (b < 0 && -b < 2 * c * x) min_derivative = std::min(min_derivative, a - b * b / (4 * c));
    const double ends = std::max(dot(piece.tangent, piece.tangent), dot(out, out));
    return std::sqrt(ends + std::max(0.0, -min_derivative) * x * x * 0.25);
}

/// Returns the remaining tolerance for blends on a segment.
Tolerance tolerance_on(const MergedSegment& segment, double arcs) {
    const double part = 1 - arcs - 2 * left_out_share;
    return {part * segment.tolerance.linear - segment.merged.linear,
            part * segment.tolerance.rotary - segment.merged.rotary};
}

/// Returns the remaining tolerance at a junction; both segments may be arcs.
Tolerance tolerance_between(const MergedSegment& before, const MergedSegment& after) {
    const bool lines = before.kind == MergedSegmentKind::line && after.kind == MergedSegmentKind::line;
    const double arcs = lines ? 0 : 2 * (after.tangent ? arc_tangent_share : arc_corner_share);
    const Tolerance a = tolerance_on(before, arcs), b = tolerance_on(after, arcs);
    return {std::min(a.linear, b.linear), std::min(a.rotary, b.rotary)};
}

}  // namespace

Point position_on(const CubicSegment& piece, double x) {
    return cubic(piece.start, piece.tangent, piece.curvature, piece.curvature_rate, x);
}

Point tangent_on(const CubicSegment& piece, double x) {
    Point out;
    for (int i = 0; i < axis_count; ++i)
        out[i] = piece.tangent[i] + x * (piece.curvature[i] + 0.5 * x * piece.curvature_rate[i]);
    return out;
}

Point curvature_on(const CubicSegment& piece, double x) {
    Point out;
    for (int i = 0; i < axis_count; ++i) out[i] = piece.curvature[i] + x * piece.curvature_rate[i];
    return out;
}

bool is_straight(const CubicSegment& piece) {
    return piece.curvature == Point{} && piece.curvature_rate == Point{};
}

PathBuilder::PathBuilder(const MachineLimits& limits, const Point& start) : segments_(limits, start), turns_(limits) {}

void PathBuilder::push(const Move& move) {
    segments_.push(move);
}

void PathBuilder::flush() {
    segments_.flush();
}

bool PathBuilder::pull(PathElement& item) {
    for (;;) {
        if (begun_) {
            item.rest = false;
            if (next_piece(item.piece)) return true;
        }
        const bool all_pieces = !begun_ || (turns_.is_complete() && cursor_ >= turns_.end());
        if (all_pieces && segments_.size() > 0 && segments_.at(0).kind == MergedSegmentKind::rest) {
            end_curve(item);
            return true;
        }
        if (!next_turn()) return false;
    }
}

void PathBuilder::end_curve(PathElement& item) {
    const MergedSegment& rest = segments_.at(0);
    item.rest = true;
    item.seconds = rest.seconds;
    item.corner_tolerance_mm = rest.corner_tolerance_mm;
    item.line = rest.line;
    item.at = rest.end;
    segments_.pop();
    begun_ = false;
}

// ---- corners

/// Adds the next corner, or completes the curve; returns false if neither is possible yet.
bool PathBuilder::next_turn() {
    if (begun_ && (turns_.is_complete() || !turns_.has_room())) return false;
    if (in_arc_) {
        add_arc_corner();
        return true;
    }
    if (segments_.size() == 0) return false;
    const MergedSegment& segment = segments_.at(0);
    if (segment.kind == MergedSegmentKind::rest) {
        turns_.complete(u_end_);
        return true;
    }
    const bool arc = segment.kind == MergedSegmentKind::arc;
    if (arc && segments_.size() < 2) return false;
    if (begun_)
        add_corner(segment);
    else
        begin_curve(segment);
    if (arc)
        begin_arc(segment, segments_.at(1));
    else
        add_line(segment);
    last_ = segment;
    segments_.pop();
    return true;
}

CornerBlend& PathBuilder::add_turn(double u, const Point& at, const Point& tangent) {
    CornerBlend& turn = turns_.add();
    turn.u = turn.begin = turn.peak = turn.end = u;
    turn.at = at;
    turn.tangent = tangent;
    return turn;
}

void PathBuilder::begin_curve(const MergedSegment& segment) {
    begun_ = true;
    turns_.clear();
    u_end_ = cursor_ = 0;
    ease_in_ = {};
    eased_from_ = std::numeric_limits<double>::infinity();
    first_event_ = past_event_ = 0;
    placed_ = alive_ = edge_ = 0;
    CornerBlend& turn = add_turn(0, segment.start, segment.tangent_in);
    turn.fixed = true;
    turn.feed = segment.feed;
    turn.line = segment.line;
    turns_.added();
}

void PathBuilder::add_line(const MergedSegment& line) {
    if (line.ease_in.length > 0) {
        ease_in_ = line.ease_in;
        add_event(u_end_ + ease_in_.length);
    }
    u_end_ += line.length;
    if (line.ease_out.length > 0) {
        ease_out_ = line.ease_out;
        add_event(eased_from_ = u_end_ - ease_out_.length);
    }
}

void PathBuilder::add_corner(const MergedSegment& segment) {
    CornerBlend& turn = add_turn(u_end_, segment.start, segment.tangent_in);
    for (int i = 0; i < axis_count; ++i) turn.change[i] = segment.tangent_in[i] - last_.tangent_out[i];
    const Tolerance tolerance = tolerance_between(last_, segment);
    turn.tolerance = segment.rotary ? tolerance.rotary : tolerance.linear;
    turn.tolerance_per_rotary = turn.tolerance / tolerance.rotary;
    turn.velocity = std::max(last_.velocity, segment.velocity);
    turn.feed = segment.feed;
    turn.line = segment.line;
    turns_.added();
}

/// Returns the first knot interval of an arc at a junction: as long as its share of the tolerance allows, so that the
/// curvature rises slowly.
double PathBuilder::junction_step(const MergedSegment& arc, const MergedSegment& neighbour, bool tangent) const {
    if (neighbour.kind == MergedSegmentKind::rest) return 0;
    const double share = tangent ? arc_tangent_share : arc_corner_share;
    const double tolerance = share * std::min(arc.tolerance.linear, neighbour.tolerance.linear);
    const auto by_tolerance = [tolerance](const ArcCurve& curve) {
        return std::sqrt(tolerance / (junction_error * curve.max_curvature()));
    };
    // The first hat reaches over the junction, but not over the other end of the neighbour or many of its corners.
    double step = std::min(by_tolerance(arc.arc), neighbour.length / step_before_junction);
    if (neighbour.kind == MergedSegmentKind::arc) {
        const double other =
            std::min(by_tolerance(neighbour.arc), inner_step(neighbour.arc, inner_share * neighbour.tolerance.linear));
        step = std::min(step, 2 * other);
    }
    // The distance over the first corner exceeds the arc by this; the rotary axes move with it.
    const double rotary_room = share * std::min(arc.tolerance.rotary, neighbour.tolerance.rotary);
    const double square = arc.arc.max_curvature() * arc.arc.max_curvature();
    while (step_after_junction / 9 * step * step * step * square * arc.arc.rotary_rate() > rotary_room) step *= 0.5;
    return step;
}

void PathBuilder::begin_arc(const MergedSegment& arc, const MergedSegment& next) {
    const bool at_rest = turns_.size() == 1;
    const double in = at_rest ? 0 : junction_step(arc, last_, arc.tangent);
    const double out = junction_step(arc, next, next.tangent);
    arc_ = ArcControlPolygon(arc.arc, in, out, inner_step(arc.arc, inner_share * arc.tolerance.linear));
    arc_begin_ = u_end_;
    u_end_ += arc_.length();
    corner_ = arc_.next();
    in_arc_ = true;
}

void PathBuilder::add_arc_corner() {
    const ArcControlPoint corner = corner_;
    Point tangent = last_.tangent_out;
    if (!corner.last) {
        corner_ = arc_.next();
        const double per_length = 1 / (corner_.u - corner.u);
        for (int i = 0; i < axis_count; ++i) tangent[i] = (corner_.at[i] - corner.at[i]) * per_length;
    }
    in_arc_ = !corner.last;
    const Point before = turns_[turns_.size() - 1].tangent;
    CornerBlend& turn = add_turn(arc_begin_ + corner.u, corner.at, tangent);
    turn.fixed = true;
    turn.begin = arc_begin_ + corner.begin;
    turn.peak = arc_begin_ + corner.peak;
    turn.end = arc_begin_ + corner.end;
    for (int i = 0; i < axis_count; ++i) turn.change[i] = tangent[i] - before[i];
    const Tolerance tolerance = tolerance_on(last_, 2 * arc_tangent_share);
    turn.tolerance = tolerance.linear;
    turn.tolerance_per_rotary = tolerance.linear / tolerance.rotary;
    turn.feed = last_.feed;
    turn.line = last_.line;
    turns_.added();
}

// ---- output of segments

bool PathBuilder::next_piece(CubicSegment& piece) {
    place_turns();
    const std::int64_t settled = turns_.settled();
    const bool all = turns_.is_complete();
    // Blends that are not settled begin after this.
    const double known = all ? turns_.end() : turns_[std::max<std::int64_t>(0, settled - CornerBlends::reach)].u;
    const double min_length = curve_rounding * (1 + cursor_);
    while (first_event_ < past_event_ && events_[first_event_] <= cursor_ + min_length) ++first_event_;
    double end = known;
    if (first_event_ < past_event_ && events_[first_event_] < known - (all ? min_length : 0))
        end = events_[first_event_];
    else if (!all)
        return false;
    if (end <= cursor_ + (all ? 0 : min_length)) return false;
    fill(piece, end);
    cursor_ = end;
    while (alive_ < placed_ && turns_[alive_].end <= cursor_) ++alive_;
    turns_.drop_before(std::max<std::int64_t>(0, std::min({alive_, edge_, settled - CornerBlends::reach})));
    return true;
}

void PathBuilder::place_turns() {
    for (; placed_ < turns_.settled(); ++placed_) {
        const CornerBlend& turn = turns_[placed_];
        add_event(turn.begin);
        if (turn.peak > turn.begin) add_event(turn.peak);
        if (turn.end > turn.peak) add_event(turn.end);
    }
}

void PathBuilder::add_event(double u) {
    if (u <= cursor_) return;
    if (past_event_ == max_events) {
        std::copy(events_.begin() + static_cast<std::ptrdiff_t>(first_event_), events_.end(), events_.begin());
        past_event_ -= first_event_;
        first_event_ = 0;
        MOTIONRACK_ASSERT(past_event_ < max_events);
    }
    std::size_t i = past_event_++;
    for (; i > first_event_ && events_[i - 1] > u; --i) events_[i] = events_[i - 1];
    events_[i] = u;
}

/// Computes the segment from the cursor to `end`. F, the integral of a blend's triangle, rises from 0 to 1 over the
/// blend. Before a corner the tangent gains F times the change of direction; after it, it lacks 1 - F times the change.
void PathBuilder::fill(CubicSegment& piece, double end) {
    const double from = cursor_;
    const double middle = 0.5 * (from + end);
    while (edge_ + 1 < turns_.size() && turns_[edge_ + 1].u <= middle) ++edge_;
    const CornerBlend& edge = turns_[edge_];
    piece.begin = from;
    piece.length = end - from;
    piece.line = edge.line;
    piece.jerk_share = middle < ease_in_.length ? ease_in_.share : middle > eased_from_ ? ease_out_.share : 1;
    piece.feed = edge.feed;
    piece.tangent = edge.tangent;
    piece.curvature = piece.curvature_rate = Point{};
    const double after_corner = from - edge.u;
    for (int i = 0; i < axis_count; ++i) piece.start[i] = edge.at[i] + after_corner * edge.tangent[i];
    for (std::int64_t j = alive_; j < placed_; ++j) {
        const CornerBlend& turn = turns_[j];
        if (turn.end <= middle || turn.begin >= middle) continue;
        double position = 0, tangent = 0, curvature = 0, curvature_rate = 0;
        if (middle < turn.peak) {
            const double x = from - turn.begin;
            position = x * x * x * turn.rise * (1.0 / 3) - (j <= edge_ ? from - turn.u : 0);
            tangent = x * x * turn.rise - (j <= edge_ ? 1 : 0);
            curvature = 2 * x * turn.rise;
            curvature_rate = 2 * turn.rise;
        } else {
            const double x = turn.end - from;
            position = x * x * x * turn.fall * (1.0 / 3) + (j > edge_ ? from - turn.u : 0);
            tangent = (j > edge_ ? 1 : 0) - x * x * turn.fall;
            curvature = 2 * x * turn.fall;
            curvature_rate = -2 * turn.fall;
        }
        for (int i = 0; i < axis_count; ++i) {
            piece.start[i] += turn.change[i] * position;
            piece.tangent[i] += turn.change[i] * tangent;
            piece.curvature[i] += turn.change[i] * curvature;
            piece.curvature_rate[i] += turn.change[i] * curvature_rate;
        }
    }
    if (from == 0) piece.start = turns_[0].at;
    const double max_velocity = max_velocity_on(piece, last_.rotary);
    if (max_velocity > 1) piece.feed /= max_velocity;
}

}  // namespace motionrack::control
