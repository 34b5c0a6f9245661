#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/control/path/junction.hpp>
#include <motionrack/control/trajectory/section_overlap.hpp>

namespace motionrack::control {

namespace {

/// Excess over an axis limit that counts as rounding, relative to the limit.
constexpr double overlap_rounding = 1e-7;
/// Remaining time that counts as rounding, relative to the duration of a segment.
constexpr double time_rounding = 1e-12;
/// Number of bisections for a time on a segment.
constexpr int overlap_halvings = 14;
/// Factor on the overlap, and number of attempts, if the sum exceeds an axis limit.
constexpr double shorter_overlap = 0.96;
constexpr int overlap_tries = 12;
/// Number of samples of the path acceleration while both motions run.
constexpr int overlap_samples = 4;
/// Relative excess over a limit for which a card that draws the path as lines compensates.
constexpr double along_reserve = 0.02;

bool is_constant_jerk(const ProfileSegment& piece) {
    return piece.kind != ProfileSegmentKind::parabolic;
}

bool accelerates(const ProfileSegment& piece) {
    const double begin = piece.at(0).accel, end = piece.last().accel;
    return begin >= 0 && end >= 0 && begin + end > 0;
}

bool are_one_line(const CubicSegment& a, const CubicSegment& b) {
    return is_straight(a) && a.tangent == b.tangent && a.feed == b.feed;
}

struct Times {
    double before = 0, after = 0;
};
/// Returns the times on a segment just before and just after the position `position`.
Times times_about(const ProfileSegment& piece, double position) {
    Times out{0, piece.seconds};
    for (int i = 0; i < overlap_halvings; ++i) {
        const double middle = 0.5 * (out.before + out.after);
        (piece.at(middle).u < position ? out.before : out.after) = middle;
    }
    return out;
}

/// Returns the time before the end from which at most `length` remains, s.
double seconds_to_go(std::span<const ProfileSegment> feed, double length) {
    const double position = feed.back().begin + feed.back().length - length;
    double seconds = 0;
    for (std::size_t i = feed.size(); i-- > 0; seconds += feed[i].seconds)
        if (feed[i].begin < position) return seconds + feed[i].seconds - times_about(feed[i], position).after;
    return seconds;
}

/// Returns the time from the start until which at most `length` is covered, s.
double seconds_gone(std::span<const ProfileSegment> feed, double length) {
    const double position = feed.front().begin + length;
    double seconds = 0;
    for (const ProfileSegment& piece : feed) {
        if (piece.begin + piece.length > position) return seconds + times_about(piece, position).before;
        seconds += piece.seconds;
    }
    return seconds;
}

// Returns the longest overlap that the tolerance allows, s. At any instant of it, either the previous motion has at
// most the tolerance left, or the next one has covered at most the tolerance. The distance from one side is at most the
// distance covered along the other.
double max_length_within(std::span<const ProfileSegment> in, std::span<const ProfileSegment> out,
                         double corner_tolerance_mm) {
    return seconds_to_go(in, corner_tolerance_mm) + seconds_gone(out, corner_tolerance_mm);
}

/// Current position on a ramp of several segments.
class RampCursor {
  public:
    RampCursor(std::span<const ProfileSegment> feed, double seconds) : feed_(feed), time_(seconds) {
        while (piece_ + 1 < feed_.size() && time_ >= feed_[piece_].seconds) time_ -= feed_[piece_++].seconds;
    }
    const ProfileSegment& piece() const { return feed_[piece_]; }
    double left() const { return std::max(0.0, piece().seconds - time_); }
    PathMotion at(double seconds) const { return piece().at(std::min(time_ + seconds, piece().seconds)); }
    void pass(double seconds) {
        time_ += seconds;
        if (left() <= time_rounding * piece().seconds && piece_ + 1 < feed_.size()) time_ = 0, ++piece_;
    }

  private:
    std::span<const ProfileSegment> feed_;
    std::size_t piece_ = 0;
    double time_ = 0;
};

/// An interval in which one section ends and the other starts: both motions at its start and at its end.
struct Moment {
    std::array<PathMotion, 2> in, out;
    bool is_linear = false;  ///< accelerations change linearly
};

/// Returns the maximum of |a x + b y|, with x and y each between its two values.
double max_sum(double a, double x0, double x1, double b, double y0, double y1) {
    const double ax0 = std::min(a * x0, a * x1), ax1 = std::max(a * x0, a * x1), by0 = std::min(b * y0, b * y1),
                 by1 = std::max(b * y0, b * y1);
    return std::max(std::fabs(ax0 + by0), std::fabs(ax1 + by1));
}

/// Returns true if the sum is within the limits. Velocities, accelerations and jerks are monotonic in the interval.
bool keeps(const Moment& moment, double in, double out, const AxisLimits& limits) {
    if (in == 0 || out == 0) return true;
    const auto [in0, in1] = moment.in;
    const auto [out0, out1] = moment.out;
    if (max_sum(in, in0.velocity, in1.velocity, out, out0.velocity, out1.velocity) >
        limits.max_velocity * (1 + overlap_rounding))
        return false;
    const double accel = moment.is_linear ? std::max(std::fabs(in * in0.accel + out * out0.accel),
                                                     std::fabs(in * in1.accel + out * out1.accel))
                                          : max_sum(in, in0.accel, in1.accel, out, out0.accel, out1.accel);
    if (accel > limits.max_accel * (1 + overlap_rounding)) return false;
    return max_sum(in, in0.jerk, in1.jerk, out, out0.jerk, out1.jerk) <=
           effective_jerk(limits) * (1 + overlap_rounding);
}

bool keeps_feed(const Moment& moment, double feed, double cosine) {
    const double in = moment.in[0].velocity, out = moment.out[1].velocity;
    const double both = cosine > 0 ? in * out : moment.in[1].velocity * moment.out[0].velocity;
    return in * in + out * out + 2 * cosine * both <= feed * feed * (1 + 2 * overlap_rounding);
}

/// Checks the tangential shares alone. A card draws the path as straight lines, on which each axis has its share of the
/// path acceleration. The corner reduces that sum only at the junctions.
bool keeps_along(const PathMotion& in, const Point& a, const PathMotion& out, const Point& b,
                 const MachineLimits& limits) {
    Point velocity;
    double square = 0, product = 0;
    for (std::size_t i = 0; i < velocity.size(); ++i) {
        velocity[i] = a[i] * in.velocity + b[i] * out.velocity;
        square += velocity[i] * velocity[i];
        product += velocity[i] * (a[i] * in.accel + b[i] * out.accel);
    }
    for (std::size_t i = 0; i < velocity.size(); ++i)
        if (std::fabs(product * velocity[i]) > square * limits[i].max_accel * (1 + along_reserve)) return false;
    return true;
}

bool is_within(const SectionRamp& in, const SectionRamp& out, double seconds, const MachineLimits& limits) {
    const Point &a = in.curve.tangent, &b = out.curve.tangent;
    const double feed = std::max(in.curve.feed, out.curve.feed), cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    RampCursor ending(in.feed, in.seconds() - seconds), beginning(out.feed, 0);
    for (double left = seconds; left > 0;) {
        const double step = std::min({ending.left(), beginning.left(), left});
        if (!(step > 0)) break;
        const Moment moment{{ending.at(0), ending.at(step)},
                            {beginning.at(0), beginning.at(step)},
                            is_constant_jerk(ending.piece()) && is_constant_jerk(beginning.piece())};
        if (!keeps_feed(moment, feed, cosine)) return false;
        for (std::size_t i = 0; i < limits.size(); ++i)
            if (!keeps(moment, a[i], b[i], limits[i])) return false;
        if (!keeps_along(moment.in[0], a, moment.out[0], b, limits) ||
            !keeps_along(moment.in[1], a, moment.out[1], b, limits))
            return false;
        for (int i = 1; i < overlap_samples; ++i) {
            const double time = step * i / overlap_samples;
            if (!keeps_along(ending.at(time), a, beginning.at(time), b, limits)) return false;
        }
        left -= step;
        ending.pass(step);
        beginning.pass(step);
    }
    return true;
}

}  // namespace

bool slows(const ProfileSegment& piece) {
    const double begin = piece.at(0).accel, end = piece.last().accel;
    return begin <= 0 && end <= 0 && begin + end < 0;
}

double SectionRamp::seconds() const {
    double out = 0;
    for (const ProfileSegment& piece : feed) out += piece.seconds;
    return out;
}

SectionRamp final_deceleration(std::span<const CubicSegment> curve, std::span<const ProfileSegment> feed) {
    if (curve.empty() || !is_straight(curve.back())) return {};
    std::size_t piece = curve.size() - 1, first = feed.size();
    while (piece > 0 && are_one_line(curve[piece - 1], curve.back())) --piece;
    while (first > 0 && feed[first - 1].begin >= curve[piece].begin && slows(feed[first - 1])) --first;
    return {curve.back(), feed.subspan(first)};
}

SectionRamp initial_acceleration(std::span<const CubicSegment> curve, std::span<const ProfileSegment> feed) {
    if (curve.empty() || !is_straight(curve.front())) return {};
    std::size_t piece = 0, past = 0;
    while (piece + 1 < curve.size() && are_one_line(curve[piece + 1], curve.front())) ++piece;
    const double end = curve[piece].begin + curve[piece].length;
    while (past < feed.size() && feed[past].begin + feed[past].length <= end && accelerates(feed[past])) ++past;
    return {curve.front(), feed.first(past)};
}

void StoredRamp::keep(const SectionRamp& end) {
    curve_ = end.curve;
    feed_.assign(end.feed.begin(), end.feed.end());
}

double max_overlap_s(const SectionRamp& in, const SectionRamp& out, double max_seconds, double corner_tolerance_mm,
                     const MachineLimits& limits) {
    if (!(corner_tolerance_mm > 0 && max_seconds > 0) || in.feed.empty() || out.feed.empty()) return 0;
    double seconds =
        std::min({max_seconds, in.seconds(), out.seconds(), max_length_within(in.feed, out.feed, corner_tolerance_mm)});
    for (int i = 0; i < overlap_tries; ++i, seconds *= shorter_overlap)
        if (is_within(in, out, seconds, limits)) return seconds;
    // With constant jerk in both, an axis that reverses never has a higher sum than from one motion alone.
    const auto landing = in.feed.last(1), launch = out.feed.first(1);
    seconds = std::min(
        {max_seconds, landing[0].seconds, launch[0].seconds, max_length_within(landing, launch, corner_tolerance_mm)});
    return is_within(in, out, seconds, limits) ? seconds : 0;
}

}  // namespace motionrack::control
