// The two velocity estimates and their error bounds.
#include <algorithm>
#include <motionrack/cards/ioflex02/driver/speed.hpp>

namespace motionrack::ioflex02 {

namespace {

const double tick_s = to_seconds(time_tick);
/// Error of an interval's length: one tick and one sample.
const double stretch_error_s = to_seconds(time_tick + sample_time);

/// Mean velocity of `counts` +- `off` between the ticks `from` and `to`; the interval may be shorter by
/// `stretch_error_s`. Unknown if the interval is not longer than that.
SpeedEstimate mean(std::int64_t counts, double off, std::int64_t from, std::int64_t to) {
    SpeedEstimate out;
    const double length = static_cast<double>(to - from) * tick_s;
    const double min_length = length - stretch_error_s;
    if (min_length <= 0) return out;
    const double size = static_cast<double>(counts < 0 ? -counts : counts);
    out.known = true;
    out.counts_s = static_cast<double>(counts) / length;
    out.error = (size + off) / min_length - size / length;
    out.from = from;
    out.to = to;
    return out;
}

/// Position of the edge of the last count: between two counts.
std::int64_t place_of(const AxisReading& axis) {
    return axis.raw + (axis.down ? 1 : 0);
}

}  // namespace

SpeedEstimate SpeedMeter::difference(const AxisReading& axis, std::int64_t ticks) const {
    // Each reading may be anywhere within its count.
    return mean(axis.raw - raw_, 1 + 2 * edge_error_, ticks_, ticks);
}

/// No edge since the last one: less than one count in all that time.
SpeedEstimate SpeedMeter::silence(const AxisReading& axis, std::int64_t ticks) const {
    // "None yet" reports the maximum age; only the observed time is certain.
    const std::int64_t since = edge_known_ ? ticks - edge_ticks_ : std::min(axis.age, ticks - first_ticks_);
    SpeedEstimate out = mean(0, 1 + 2 * edge_error_, ticks - since, ticks);
    if (!out.known) return out;
    const double max_counts_s = out.error;
    out.counts_s = std::clamp(edge_speed_, -max_counts_s, max_counts_s);
    out.error = max_counts_s + (out.counts_s < 0 ? -out.counts_s : out.counts_s);
    return out;
}

Speed SpeedMeter::update(const AxisReading& axis, std::int64_t ticks) {
    Speed out;
    const bool reported = axis.age < oldest_age;
    const std::int64_t edge_ticks = ticks - axis.age, place = place_of(axis);
    if (!reported && edge_known_ && place != edge_place_) edge_known_ = false;  // edges came and are too old
    if (begun_) {
        out.difference = difference(axis, ticks);
        if (reported && edge_known_ && edge_ticks > edge_ticks_) {
            out.edges = mean(place - edge_place_, 2 * edge_error_, edge_ticks_, edge_ticks);
            out.edge_came = out.edges.known;
        } else if (!reported || (edge_known_ && place == edge_place_)) {
            out.edges = silence(axis, ticks);
        }
    }
    if (reported && (!edge_known_ || out.edge_came)) {
        edge_known_ = true;
        edge_ticks_ = edge_ticks;
        edge_place_ = place;
        edge_speed_ = out.edge_came ? out.edges.counts_s : 0;
    }
    if (!begun_) first_ticks_ = ticks;
    begun_ = true;
    ticks_ = ticks;
    raw_ = axis.raw;
    return out;
}

}  // namespace motionrack::ioflex02
