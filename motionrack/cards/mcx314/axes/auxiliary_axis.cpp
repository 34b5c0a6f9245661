// The auxiliary (fourth) axis: its own speed generator follows three interpolated axes.
//
//   speed      ___   ____                 one V per segment, which brings it to its position at the segment's
//          ___/   \_/    \__              end; pulses: all known ones; from `brakes at` on the chip
//        |  1  | 2 | 3 |  4 |             decelerates to SV by itself
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <motionrack/cards/mcx314/axes/chip_axis_group.hpp>

namespace motionrack::mcx314 {

/// Sets a stationary channel up as the auxiliary.
Result<void> ChipAxisGroup::take_auxiliary(int channel, std::int64_t at) {
    auxiliary_ = channel;
    auxiliary_target_ = auxiliary_from_ = at;
    double acceleration = max_units, start = 1, top = max_units;
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        if (map_.channel[i] != channel) continue;
        const control::AxisLimits& limits = map_.limits[i];
        const double units = limits.pulses_per_unit * range_ / rules::clock_hz;
        acceleration = limits.max_accel * units / rules::rate_unit;
        start = 0.5 * limits.max_velocity_step * units;
        top = limits.max_velocity * units;
    }
    auto whole = [](double x) { return static_cast<std::int32_t>(std::clamp(std::floor(x), 1.0, max_units)); };
    auxiliary_start_speed_ = whole(start);
    auxiliary_acceleration_ = whole(acceleration);
    auxiliary_top_speed_ = whole(top);
    const unsigned axis = 1u << channel;
    MOTIONRACK_CHECK(driver_.WriteRange(axis, range_));
    MOTIONRACK_CHECK(driver_.SetSV(axis, auxiliary_start_speed_));
    MOTIONRACK_CHECK(driver_.SetA(axis, auxiliary_acceleration_));
    driver_.SetSCurve(axis, false);
    return {};
}

namespace {

/// Register accesses from reading the position to the new speed.
constexpr double accesses_to_speed = 11;
/// The chip's slopes are quantised to whole steps and clocks: a ramp that must end at a position gets this margin.
constexpr double sure = 1.02;

/// The travel of an axis in `seconds` that changes its speed from `from` to `to` with `slope`.
double travel(double from, double to, double slope, double seconds) {
    const double ramp = std::min(seconds, std::fabs(to - from) / slope),
                 reached = from + (to > from ? slope : -slope) * ramp;
    return (from + reached) / 2 * ramp + to * (seconds - ramp);
}

}  // namespace

Result<void> ChipAxisGroup::update_auxiliary_velocity(const Segment& segment) {
    const int c = segment.auxiliary_channel;
    const std::int64_t at = driver_.ReadLPS(c);
    if (auxiliary_ != c) MOTIONRACK_CHECK(take_auxiliary(c, at));
    auxiliary_target_ += segment.auxiliary_pulses;
    expected_[static_cast<std::size_t>(c)] = auxiliary_target_;
    const bool driving = driver_.status().driving(1u << c);
    if (segment.even) return steer_evenly(segment, driving, at);
    const std::int64_t left = auxiliary_target_ - at;
    if (!driving && left != 0) auxiliary_negative_ = left < 0;  // it reverses only at a standstill
    const int direction = auxiliary_negative_ ? -1 : 1;
    const std::int64_t goal = auxiliary_target_ + segmenter_->auxiliary_pulses_ahead(c, direction);
    if (direction * (goal - at) <= 0) return {};
    const double mean = std::max(0.0, static_cast<double>(direction * left)) /
                        segment_seconds(segment, driver_.ReadCV(generator_), range_) * range_ / rules::clock_hz;
    const std::int32_t v = auxiliary_speed(mean);
    if (!driving) return drive_auxiliary(at, goal, v);
    // While it decelerates it keeps its present end; a new drive then covers the remaining pulses.
    if (std::llabs(at - auxiliary_from_) >= auxiliary_brakes_at_) return {};
    const std::int64_t pulses = goal - auxiliary_from_;
    auxiliary_brakes_at_ = auxiliary_fall_from(pulses, v);
    MOTIONRACK_CHECK(driver_.Pulse(1u << c, pulses));
    MOTIONRACK_CHECK(driver_.SetDecPoint(1u << c, auxiliary_brakes_at_));
    return driver_.SetV(1u << c, v);
}

std::int32_t ChipAxisGroup::auxiliary_speed(double v) const {
    return static_cast<std::int32_t>(std::clamp(std::floor(v + 0.5), 1.0, static_cast<double>(auxiliary_top_speed_)));
}

/// Changes the speed as evenly as that of the other axes: to the planned speed at the segment's end, corrected for
/// missing pulses. The trajectory itself decelerates for its stops, so the chip need not. An axis that is too fast for
/// its position stops slightly beyond it, and returns when all axes are stationary.
Result<void> ChipAxisGroup::steer_evenly(const Segment& segment, bool driving, std::int64_t at) {
    const unsigned axis = 1u << auxiliary_;
    if (!driving && segment.auxiliary_pulses != 0) auxiliary_negative_ = segment.auxiliary_pulses < 0;
    const int direction = auxiliary_negative_ ? -1 : 1;
    const std::int64_t ahead = direction * segmenter_->auxiliary_pulses_ahead(auxiliary_, direction);
    const double pulses_per_v = rules::clock_hz / range_, max_slope = rules::rate_unit * auxiliary_acceleration_,
                 start = auxiliary_start_speed_;
    const double from = driving ? driver_.ReadCV(auxiliary_) : start;
    const auto left = static_cast<double>(direction * (auxiliary_target_ - at));
    if (!driving && left + static_cast<double>(ahead) <= 0) return {};  // it has already arrived
    const double seconds = segment_seconds(segment, driver_.ReadCV(generator_), range_),
                 late = accesses_to_speed * to_seconds(host_.access) + to_seconds(host_.latency);
    const double distance = std::max(0.0, left / pulses_per_v - from * late);  // V units * seconds
    const double planned = segment.auxiliary_speed / pulses_per_v;
    double desired = planned + distance / seconds - (from + planned) / 2, end = std::max(planned, start);
    if (ahead <= 0) end = desired = start;
    const std::int32_t v = auxiliary_speed(desired);
    double slope = std::fabs(v - from) / seconds;
    if (v < from && from > end)
        slope = distance > 0 ? std::max(slope, sure * (from * from - end * end) / (2 * distance))
                             : max_slope;  // an axis that is ahead arrives early
    slope = std::clamp(slope, rules::rate_unit, max_slope);
    MOTIONRACK_CHECK(driver_.SetA(axis, static_cast<std::int32_t>(std::ceil(slope / rules::rate_unit))));
    // The drive ends at its goal at any speed: beyond the rest of this segment, it has room to brake.
    const double runs = ahead > 0 ? travel(from, v, slope, seconds) : 0, falls_from = ahead > 0 ? v : from,
                 falls_in = std::max(0.0, falls_from * falls_from - start * start) / (2 * max_slope);
    const std::int64_t goal =
        at + direction * std::max(static_cast<std::int64_t>(left) + ahead,
                                  static_cast<std::int64_t>(std::ceil((runs + falls_in) * pulses_per_v)));
    if (!driving) return drive_auxiliary(at, goal, v, false);
    MOTIONRACK_CHECK(driver_.SetV(axis, v));
    auxiliary_brakes_at_ = std::llabs(goal - auxiliary_from_);
    MOTIONRACK_CHECK(driver_.Pulse(axis, goal - auxiliary_from_));
    return driver_.SetDecPoint(axis, auxiliary_brakes_at_);
}

/// The pulse at which deceleration must begin to reach the start speed at the end.
std::int64_t ChipAxisGroup::auxiliary_fall_from(std::int64_t pulses, std::int32_t v) const {
    const std::int64_t all = std::llabs(pulses);
    if (v <= auxiliary_start_speed_) return all;
    const double top = v, low = auxiliary_start_speed_;
    const double phase = speed_carry / auxiliary_acceleration_ * (top * (top + 1) - low * (low + 1)) / 2;
    return std::max<std::int64_t>(0, all - static_cast<std::int64_t>(phase / range_) - 2);
}

/// Starts a drive from standstill.
Result<void> ChipAxisGroup::drive_auxiliary(std::int64_t from, std::int64_t to, std::int32_t v, bool brakes) {
    const unsigned axis = 1u << auxiliary_;
    const std::int64_t pulses = to - from;
    if (pulses == 0) return {};
    auxiliary_from_ = from;
    auxiliary_negative_ = pulses < 0;
    auxiliary_brakes_at_ = brakes ? auxiliary_fall_from(pulses, v) : std::llabs(pulses);
    MOTIONRACK_CHECK(driver_.SetV(axis, v));
    MOTIONRACK_CHECK(driver_.ManualDec(axis, auxiliary_brakes_at_));
    MOTIONRACK_CHECK(driver_.Pulse(axis, pulses));
    driver_.Drive(axis, auxiliary_negative_);
    return {};
}

/// Drives the remaining pulses once all axes are stationary.
Result<void> ChipAxisGroup::finish_auxiliary() {
    const std::int64_t at = driver_.ReadLPS(auxiliary_);
    if (driver_.status().error(xyzu)) return {};  // an error that ended the path applies to all axes
    const std::int64_t target = expected_[static_cast<std::size_t>(auxiliary_)];
    const double start = auxiliary_start_speed_, slope = rules::rate_unit * auxiliary_acceleration_;
    const double half =
        0.5 * static_cast<double>(std::llabs(target - at)) * range_ / rules::clock_hz;  // V units * seconds
    MOTIONRACK_CHECK(driver_.SetA(1u << auxiliary_, auxiliary_acceleration_));
    return drive_auxiliary(at, target, auxiliary_speed(std::sqrt(start * start + 2 * slope * half)));
}

}  // namespace motionrack::mcx314
