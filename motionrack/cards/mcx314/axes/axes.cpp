// Playing segments: starting chains, queueing behind the running segment, rewriting speed at joints, standing still exactly.
#include <motionrack/cards/mcx314/axes/axes.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include <limits>

namespace motionrack::mcx314 {

namespace {

// R of the second axis for R of the first: both axes step together, the path is sqrt(2) pulses long.
constexpr double both_axes_factor = 1.41421356237309503;
constexpr unsigned all_axes = 0xF;
constexpr std::uint16_t wr1_drive_end = 0x8000;
constexpr std::uint16_t wr2_software_limits = 0x0003;
constexpr std::uint16_t wr2_limit_slows = 0x0004;
constexpr std::uint16_t wr2_pulse_and_direction = 0x0040;
constexpr std::int64_t no_deceleration_point = 268'435'455;
constexpr Duration joint_timeout = whole_seconds(3600);

}  // namespace

Axes::Axes(Driver& driver, const AxisMap& map, Duration access)
    : driver_(driver), map_(map), access_(access), range_(Segmenter::best_range(map)) {}

Result<void> Axes::set_up(const control::Point& position) {
    driver_.RESET();
    driver_.WriteMode1(all_axes, 0);
    driver_.WriteMode2(all_axes, wr2_pulse_and_direction | wr2_limit_slows);
    driver_.WriteMode3(all_axes, 0);
    MOTIONRACK_CHECK(driver_.SetAO(all_axes, 0));
    const Pulses4 at = map_.pulses(position);
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        if (map_.channel[i] < 0) continue;
        const unsigned axis = 1u << map_.channel[i];
        const control::AxisLimits& limits = map_.limits[i];
        MOTIONRACK_CHECK(driver_.LPS(axis, at[static_cast<std::size_t>(map_.channel[i])]));
        MOTIONRACK_CHECK(driver_.SetCompP(axis, static_cast<std::int64_t>(std::floor(limits.max_position * limits.pulses_per_unit + 0.5))));
        MOTIONRACK_CHECK(driver_.SetCompM(axis, static_cast<std::int64_t>(std::floor(limits.min_position * limits.pulses_per_unit + 0.5))));
        driver_.WriteMode2(axis, static_cast<std::uint16_t>(driver_.mode2(map_.channel[i]) | wr2_software_limits));
    }
    clear_interrupts();
    return {};
}

/// At a joint the generator's rate goes on, but a basic pulse is another length of path on each side: the speed of every axis jumps by
/// the difference, which its start speed must allow.
double Axes::joint_speed(const control::Geometry& before, const control::Geometry& after) const {
    // An axis that is steered stands before it is interpolated, or the other way round: its registers are those of one drive only.
    const int steered = drawing_of(map_, before).companion;
    if (steered != drawing_of(map_, after).companion) return 0;
    // And before it turns round: its drive ends, and a new one begins.
    for (std::size_t i = 0; steered >= 0 && i < map_.channel.size(); ++i)
        if (map_.channel[i] == steered && before.tangent_out[i] * after.tangent_in[i] <= 0) return 0;
    const double a = basic_pulses_along(map_, drawing_of(map_, before), before.tangent_out);
    const double b = basic_pulses_along(map_, drawing_of(map_, after), after.tangent_in);
    constexpr double reserve = 0.95;  // for whole speed units
    double speed = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        const double jump = std::fabs(before.tangent_out[i] / a - after.tangent_in[i] / b) * std::min(a, b);
        if (map_.channel[i] >= 0 && jump > 1e-9) speed = std::min(speed, reserve * map_.limits[i].start_speed / jump);
    }
    return speed;
}

Result<void> Axes::begin() {
    for (int c = 0; c < channel_count; ++c) expected_[static_cast<std::size_t>(c)] = driver_.ReadLPS(c);
    segmenter_.emplace(map_, range_, expected_, access_);
    starts_.clear();
    notes_.clear();
    last_block_ = -2;
    segments_ = 0;
    chain_running_ = false;
    companion_ = -1;
    driver_.WriteMode1(all_axes, wr1_drive_end);
    clear_interrupts();
    return {};
}

Result<void> Axes::follow(const control::PlannedMove& move) {
    segmenter_->add(move);
    return play_ready(1);
}

Result<void> Axes::finish() {
    segmenter_->finish();
    MOTIONRACK_CHECK(play_ready(0));
    MOTIONRACK_CHECK(wait_for_standstill());
    starts_.push_back({-1, current_line_, driver_.interrupt().now()});
    return {};
}

Result<void> Axes::play_ready(std::size_t keep) {
    while (segmenter_->ready() > keep) {
        const Segment segment = (*segmenter_)[0];
        const Segment next = segmenter_->ready() > 1 ? (*segmenter_)[1] : Segment{};
        const bool has_next = segmenter_->ready() > 1;
        segmenter_->pop();
        MOTIONRACK_CHECK(play(segment, has_next ? &next : nullptr));
    }
    return {};
}

Result<void> Axes::play(const Segment& segment, const Segment* next) {
    if (driver_.interrupt().stop_requested()) return stopped_by_user();
    if (segment.kind == SegmentKind::pause) return play_pause(segment);
    ++segments_;
    if (segment.starts_chain || !chain_running_) {
        MOTIONRACK_CHECK(wait_for_standstill());
        MOTIONRACK_CHECK(start_chain(segment));
    } else {
        MOTIONRACK_CHECK(queue(segment));
        MOTIONRACK_CHECK(wait_for_joint());
        MOTIONRACK_CHECK(write_speed(segment));
    }
    MOTIONRACK_CHECK(begin_segment(segment, next));
    chain_running_ = !segment.ends_chain;
    return {};
}

Result<void> Axes::play_pause(const Segment& segment) {
    MOTIONRACK_CHECK(wait_for_standstill());
    starts_.push_back({segment.block, segment.line, driver_.interrupt().now()});
    last_block_ = segment.block;
    current_line_ = segment.line;
    const Instant end = driver_.interrupt().now() + from_seconds(segment.seconds);
    while (driver_.interrupt().now() < end) {
        if (driver_.interrupt().stop_requested()) return stopped_by_user();
        driver_.interrupt().pass(std::min<Duration>(milliseconds(50), end - driver_.interrupt().now()));
    }
    return {};
}

// ---- chains -------------------------------------------------------------------------------------------------------------------

Result<void> Axes::start_chain(const Segment& segment) {
    generator_ = segment.axes[0];
    const unsigned own = 1u << generator_;
    MOTIONRACK_CHECK(driver_.WriteRange(own, range_));
    MOTIONRACK_CHECK(driver_.WriteRange(all_axes & ~own, std::llround(range_ * both_axes_factor)));
    MOTIONRACK_CHECK(driver_.SetSV(own, segment.initial_speed));
    driver_.SetSCurve(own, segment.s_curve);
    if (segment.s_curve) {
        MOTIONRACK_CHECK(driver_.AutoDec(own));
        MOTIONRACK_CHECK(driver_.SetAA(own, segment.jerk));
        MOTIONRACK_CHECK(driver_.SetAO(own, segment.offset));
    }
    driver_.EnableDeceleration(segment.s_curve);
    written_speed_ = written_acceleration_ = 0;
    MOTIONRACK_CHECK(write_speed(segment));
    return command(segment);
}

/// Puts the segment behind the running one. If the host came too late, the chip stands at the joint and it starts from there.
Result<void> Axes::queue(const Segment& segment) {
    const MainStatus status = driver_.status();
    if (status.interpolating()) return command(segment);
    if (status.error(all_axes)) return stopped_by_machine();
    notes_.push_back({segment.line, fmt::format("line {}: the next piece came too late and the axes stopped at the joint for a moment; "
                                                "lower the feed or bus_access_ns", segment.line), 0});
    return command(segment);
}

Result<void> Axes::command(const Segment& segment) {
    driver_.SetInterpolationAxes(segment.axes[0], segment.axes[1], segment.axis_count > 2 ? segment.axes[2] : -1,
                                 segment.constant_vector, true);
    if (segment.kind == SegmentKind::line) {
        std::array<Finish, 3> ends{};
        for (std::size_t i = 0; i < segment.axis_count; ++i) ends[i] = {segment.axes[i], segment.finish[i], 0};
        return driver_.Line(ends.data(), segment.axis_count);
    }
    return driver_.Arc({{segment.axes[0], segment.finish[0], segment.centre[0]}, {segment.axes[1], segment.finish[1], segment.centre[1]}},
                       segment.kind == SegmentKind::arc_cw);
}

Result<void> Axes::wait_for_joint() {
    bool woken = false;
    while (true) {
        const MainStatus status = driver_.status();
        if (status.can_queue()) return {};
        if (!status.interpolating()) {
            if (status.error(all_axes)) return stopped_by_machine();
            return {};  // too late by a hair: the segment has run and ended on its own
        }
        if (driver_.interrupt().stop_requested()) return stopped_by_user();
        if (woken) clear_interrupts();  // something else woke us (a companion's end)
        woken = driver_.interrupt().wait(joint_timeout);
    }
}

Result<void> Axes::write_speed(const Segment& segment) {
    const unsigned own = 1u << generator_;
    if (segment.speed != written_speed_) MOTIONRACK_CHECK(driver_.SetV(own, segment.speed));
    if (segment.acceleration != written_acceleration_) MOTIONRACK_CHECK(driver_.SetA(own, segment.acceleration));
    written_speed_ = segment.speed;
    written_acceleration_ = segment.acceleration;
    return {};
}

Result<void> Axes::begin_segment(const Segment& segment, const Segment* next) {
    if (segment.block != last_block_) starts_.push_back({segment.block, segment.line, driver_.interrupt().now()});
    last_block_ = segment.block;
    current_line_ = segment.line;
    for (std::size_t i = 0; i < segment.axis_count; ++i) expected_[segment.axes[i]] += segment.moves[i];
    if (segment.companion_channel >= 0) MOTIONRACK_CHECK(steer_companion(segment, next));
    return {};
}

Result<void> Axes::wait_for_standstill() {
    chain_running_ = false;
    while (true) {
        const MainStatus status = driver_.status();
        if (!status.driving(all_axes) && !status.interpolating()) break;
        if (driver_.interrupt().stop_requested()) return stopped_by_user();
        if (driver_.interrupt().wait(joint_timeout)) clear_interrupts();
    }
    clear_interrupts();
    companion_ = -1;
    for (int c = 0; c < channel_count; ++c)
        if (driver_.ReadLPS(c) != expected_[static_cast<std::size_t>(c)]) return stopped_by_machine();
    return {};
}

// ---- the fourth axis ------------------------------------------------------------------------------------------------------------

/// About how long the segment takes: from the present speed to its own, then on.
double Axes::segment_seconds(const Segment& segment) {
    std::int64_t pulses = 0;
    for (std::size_t i = 0; i < segment.axis_count; ++i)
        pulses = std::max<std::int64_t>(pulses, segment.finish[i] < 0 ? -segment.finish[i] : segment.finish[i]);
    const double length = static_cast<double>(pulses) * range_ / 8e6;  // in V units * seconds
    const double v0 = std::max(1, driver_.ReadCV(generator_)), v1 = segment.speed, slope = 125.0 * segment.acceleration;
    const double ramp = std::fabs(v1 - v0) / slope, ramp_length = ramp * (v0 + v1) / 2;
    if (ramp_length <= length) return ramp + (length - ramp_length) / v1;
    const double end = std::sqrt(std::max(1.0, v0 * v0 + (v1 > v0 ? 2 : -2) * slope * length));
    return 2 * length / (v0 + end);
}

Result<void> Axes::steer_companion(const Segment& segment, const Segment* next) {
    const int c = segment.companion_channel;
    const std::int64_t at = driver_.ReadLPS(c);
    if (companion_ != c) {
        companion_ = c;
        companion_target_ = at;
        companion_from_ = at;
    }
    companion_target_ += segment.companion_pulses;
    expected_[static_cast<std::size_t>(c)] = companion_target_;
    const std::int64_t left = companion_target_ - at;
    if (left == 0) return {};
    // The next segment's pulses are promised too, so that it does not stop at the joint.
    std::int64_t beyond = 0;
    if (next && !next->starts_chain && next->companion_channel == c && (next->companion_pulses < 0) == (left < 0))
        beyond = next->companion_pulses;
    // Where these are few it must not come to their end before the joint, which it would not brake for.
    const bool few = beyond != 0 && 3 * std::llabs(beyond) < std::llabs(left);
    const double hertz = std::fabs(static_cast<double>(left)) / segment_seconds(segment) * (few ? 0.85 : 1);
    double top = 8'000;
    for (std::size_t i = 0; i < map_.channel.size(); ++i)
        if (map_.channel[i] == c) top = std::min(top, map_.limits[i].max_speed * map_.limits[i].pulses_per_unit * range_ / 8e6);
    const auto v = static_cast<std::int32_t>(std::clamp(std::floor(hertz * range_ / 8e6 + 0.5), 1.0, std::floor(top)));
    const bool driving = driver_.status().driving(1u << c);
    if (!driving || companion_negative_ != (left < 0)) {
        std::int64_t from = at;
        if (driving) {  // it ends its way in the other direction first
            MOTIONRACK_CHECK(driver_.wait_until_stopped(1u << c, whole_seconds(1)));
            from = driver_.ReadLPS(c);
        }
        companion_from_ = from;
        companion_negative_ = left < 0;
        return start_companion(c, companion_target_ - from + beyond, v, beyond == 0);
    }
    const std::int64_t pulses = companion_target_ + beyond - companion_from_;
    MOTIONRACK_CHECK(driver_.Pulse(1u << c, pulses));
    MOTIONRACK_CHECK(driver_.SetDecPoint(1u << c, companion_fall_from(pulses, v, beyond == 0)));
    return driver_.SetV(1u << c, v);
}

/// The pulse from which the companion's speed falls to its start speed, if its drive ends with this segment.
std::int64_t Axes::companion_fall_from(std::int64_t pulses, std::int32_t v, bool ends) const {
    if (!ends || v <= companion_start_speed_) return no_deceleration_point;
    const double top = v, low = companion_start_speed_;
    const double phase = 64'000.0 / companion_acceleration_ * (top * (top + 1) - low * (low + 1)) / 2;
    return std::max<std::int64_t>(0, (pulses < 0 ? -pulses : pulses) - static_cast<std::int64_t>(phase / range_) - 2);
}

Result<void> Axes::start_companion(int channel, std::int64_t pulses, std::int32_t v, bool ends) {
    const unsigned axis = 1u << channel;
    double acceleration = 8'000, start = 1;
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        if (map_.channel[i] != channel) continue;
        const control::AxisLimits& limits = map_.limits[i];
        acceleration = limits.max_accel * limits.pulses_per_unit * range_ / 8e6 / 125;
        start = 0.5 * limits.start_speed * limits.pulses_per_unit * range_ / 8e6;
    }
    MOTIONRACK_CHECK(driver_.WriteRange(axis, range_));
    companion_start_speed_ = static_cast<std::int32_t>(std::clamp(std::floor(start), 1.0, 8'000.0));
    companion_acceleration_ = static_cast<std::int32_t>(std::clamp(std::floor(acceleration), 1.0, 8'000.0));
    MOTIONRACK_CHECK(driver_.SetSV(axis, companion_start_speed_));
    MOTIONRACK_CHECK(driver_.SetA(axis, companion_acceleration_));
    MOTIONRACK_CHECK(driver_.SetV(axis, v));
    driver_.SetSCurve(axis, false);
    MOTIONRACK_CHECK(driver_.ManualDec(axis, companion_fall_from(pulses, v, ends)));
    MOTIONRACK_CHECK(driver_.Pulse(axis, pulses));
    driver_.Drive(axis, pulses < 0);
    return {};
}

// ---- stops ----------------------------------------------------------------------------------------------------------------------

void Axes::stop(bool immediate) {
    if (immediate)
        driver_.QuickStop(all_axes);
    else
        driver_.SlowStop(all_axes);
    chain_running_ = false;
    if (segmenter_) segmenter_.emplace(map_, range_, expected_, access_);
}

void Axes::clear_interrupts() {
    for (int c = 0; c < channel_count; ++c) driver_.read_interrupts(c);
    driver_.ClearInterpolationInterrupt();
}

std::string Axes::place_text() {
    std::string out;
    const control::Point at = commanded_position();
    for (std::size_t i = 0; i < at.size(); ++i)
        if (map_.channel[i] >= 0) out += fmt::format("{}{} {:.4f}", out.empty() ? "" : ", ", control::axis_letters[i], at[i]);
    return out;
}

tl::unexpected<Error> Axes::stopped_by_machine() {
    driver_.SlowStop(all_axes);
    while (driver_.status().driving(all_axes)) driver_.interrupt().pass(microseconds(100));
    std::string why;
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        if (map_.channel[i] < 0) continue;
        const std::string cause = driver_.axis_status(map_.channel[i]).why_stopped();
        if (!cause.empty()) why += fmt::format("{}axis {}: {}", why.empty() ? "" : "; ", control::axis_letters[i], cause);
    }
    if (why.empty()) why = "the chip's counters are not where the path ends";
    chain_running_ = false;
    return fail(Trouble::machine, fmt::format("The motion was stopped in line {}: {}. The axes stand at {}. Nothing after it was driven; "
                                              "clear the cause, move back and start again.", current_line_, why, place_text()),
                {current_line_, 1});
}

tl::unexpected<Error> Axes::stopped_by_user() {
    driver_.SlowStop(all_axes);
    while (driver_.status().driving(all_axes)) driver_.interrupt().pass(microseconds(100));
    chain_running_ = false;
    return fail(Trouble::stopped, fmt::format("Stopped on request in line {}; the axes came to rest along the path at {}.", current_line_,
                                              place_text()),
                {current_line_, 1});
}

// ---- looking --------------------------------------------------------------------------------------------------------------------

control::Point Axes::commanded_position() {
    control::Point out = {};
    for (std::size_t i = 0; i < map_.channel.size(); ++i)
        if (map_.channel[i] >= 0) out[i] = driver_.ReadLPS(map_.channel[i]) / map_.limits[i].pulses_per_unit;
    return out;
}

std::vector<control::PathNote> Axes::take_notes() {
    std::vector<control::PathNote> out = std::exchange(notes_, {});
    if (segmenter_)
        for (control::PathNote& note : segmenter_->take_notes()) out.push_back(std::move(note));
    return out;
}

}  // namespace motionrack::mcx314
