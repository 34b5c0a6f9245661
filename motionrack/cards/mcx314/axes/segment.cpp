// Length and duration of a segment.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/axes/geometry.hpp>
#include <motionrack/cards/mcx314/axes/segment.hpp>

namespace motionrack::mcx314 {

namespace {

/// Basic pulses of the longest axis; with constant vector speed, pulses in which both axes step take longer.
double basic_pulses(const Segment& segment) {
    std::int64_t max_size = 0, min_size = std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < segment.axis_count; ++i) {
        const std::int64_t pulses = std::llabs(segment.finish[i]);
        max_size = std::max(max_size, pulses);
        min_size = std::min(min_size, pulses);
    }
    const bool longer = segment.constant_vector && segment.kind == SegmentKind::line;
    return static_cast<double>(max_size) + (longer ? both_axes_extra * static_cast<double>(min_size) : 0.0);
}

}  // namespace

double segment_length(const Segment& segment, std::int32_t range) {
    return basic_pulses(segment) * range / rules::clock_hz;
}

double segment_seconds(const Segment& segment, double from, std::int32_t range) {
    const double length = segment_length(segment, range);
    const double v0 = std::max(1.0, from), v1 = segment.speed, slope = rules::rate_unit * segment.acceleration;
    const double ramp = std::fabs(v1 - v0) / slope, ramp_length = ramp * (v0 + v1) / 2;
    if (ramp_length <= length) return ramp + (length - ramp_length) / v1;
    const double end = std::sqrt(std::max(1.0, v0 * v0 + (v1 > v0 ? 2 : -2) * slope * length));
    return 2 * length / (v0 + end);
}

}  // namespace motionrack::mcx314
