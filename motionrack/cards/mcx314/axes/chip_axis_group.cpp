// Execution of segments: starts chains, queues behind the running segment, rewrites the speed at junctions, and stops
// exactly.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <motionrack/cards/mcx314/axes/chip_axis_group.hpp>
#include <motionrack/cards/mcx314/axes/initialise.hpp>

namespace motionrack::mcx314 {

namespace {

// R of the second axis for R of the first: both axes step together, the path is sqrt(2) pulses long.
constexpr double both_axes_factor = 1 + both_axes_extra;
constexpr Duration junction_timeout = whole_seconds(3600);
constexpr Duration brake_look = microseconds(5);   // less than the duration of any segment
constexpr std::int64_t pulses_past_junction = 16;  // more than are driven until the next poll

/// Returns true if the line is active. During a requested stop each wait returns at once, so decelerating axes are
/// polled.
bool wait_for_interrupt(Interrupt& host, bool brakes) {
    if (!brakes) return host.wait(junction_timeout);
    host.pass(brake_look);
    return false;
}

/// Detects whether the chip is at the junction. The queue also becomes free if a limit switch makes the chip decelerate
/// within its segment, as this drops the queued one. The speed of that segment must not be written then.
bool are_at(Driver& driver, const Pulses4& junction, int auxiliary) {
    for (int c = 0; c < channel_count; ++c) {
        if (c == auxiliary) continue;
        if (std::llabs(junction[static_cast<std::size_t>(c)] - driver.ReadLPS(c)) > pulses_past_junction) return false;
    }
    return true;
}

unsigned axes_of(const Segment& segment) {
    unsigned out = segment.auxiliary_pulses != 0 ? 1u << segment.auxiliary_channel : 0;
    for (std::size_t i = 0; i < segment.axis_count; ++i) out |= 1u << segment.axes[i];
    return out;
}

/// Returns true if a switch or an alarm ended the last drive of one of these axes.
bool was_stopped(Driver& driver, unsigned axes) {
    for (int c = 0; c < channel_count; ++c)
        if ((axes >> c & 1) != 0 && !driver.axis_status(c).why_stopped().empty()) return true;
    return false;
}

/// Returns true if the chip has all pulses before this segment, and none beyond it.
bool is_within(Driver& driver, const Pulses4& start, const Segment& segment, int auxiliary) {
    Pulses4 end = start;
    for (std::size_t i = 0; i < segment.axis_count; ++i) end[segment.axes[i]] += segment.moves[i];
    for (int c = 0; c < channel_count; ++c) {
        if (c == auxiliary) continue;
        const auto [low, high] = std::minmax(start[static_cast<std::size_t>(c)], end[static_cast<std::size_t>(c)]);
        if (const std::int64_t here = driver.ReadLPS(c); here < low || here > high) return false;
    }
    return true;
}

/// The chip takes a segment whose last word comes after its standstill as a chain of its own, which the segment's first
/// axis drives: slowly, until that is noticed.
Result<void> prepare_to_drive(Driver& driver, unsigned axis) {
    driver.SetSCurve(axis, false);
    MOTIONRACK_CHECK(driver.SetSV(axis, 1));
    return driver.SetV(axis, 1);
}

}  // namespace

ChipAxisGroup::ChipAxisGroup(Driver& driver, const AxisMap& map, const HostTimes& host)
    : driver_(driver), map_(map), host_(host), rule_(map, host), range_(Segmenter::best_range(map)) {}

Result<void> ChipAxisGroup::set_up(const control::Point& position) {
    MOTIONRACK_CHECK(prepare_chip(driver_));
    const Pulses4 at = map_.pulses(position);
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        const int channel = map_.channel[i];
        if (channel < 0) continue;
        MOTIONRACK_CHECK(driver_.LPS(1u << channel, at[static_cast<std::size_t>(channel)]));
        MOTIONRACK_CHECK(write_travel(driver_, channel, map_.limits[i]));
        driver_.WriteMode2(1u << channel, static_cast<std::uint16_t>(driver_.mode2(channel) | software_limits));
    }
    clear_interrupts();
    return {};
}

Result<void> ChipAxisGroup::begin() {
    for (int c = 0; c < channel_count; ++c) expected_[static_cast<std::size_t>(c)] = driver_.ReadLPS(c);
    notes_ = take_path_warnings();
    segmenter_.emplace(map_, range_, expected_, host_);
    starts_.clear();
    last_block_ = -2;
    chain_running_ = false;
    auxiliary_ = -1;
    driver_.WriteMode1(xyzu, field("WR1", "DEND").mask);
    clear_interrupts();
    return {};
}

Result<void> ChipAxisGroup::follow(const control::PlannedMove& move) {
    segmenter_->add(move);
    return play_ready(1);
}

Result<void> ChipAxisGroup::finish() {
    segmenter_->finish();
    MOTIONRACK_CHECK(play_ready(0));
    MOTIONRACK_CHECK(wait_for_standstill());
    starts_.push_back({-1, current_line_, driver_.interrupt().now()});
    return {};
}

Result<void> ChipAxisGroup::play_ready(std::size_t keep) {
    while (segmenter_->ready() > keep) {
        const Segment segment = (*segmenter_)[0];
        segmenter_->pop();
        MOTIONRACK_CHECK(play(segment));
    }
    return {};
}

Result<void> ChipAxisGroup::play(const Segment& segment) {
    if (segment.kind == SegmentKind::pause) return play_pause(segment);
    if (segment.starts_chain || !chain_running_) {
        MOTIONRACK_CHECK(wait_for_standstill());
        if (driver_.interrupt().stop_requested()) return stopped_by_user();
        MOTIONRACK_CHECK(start_chain(segment));
    } else {
        MOTIONRACK_CHECK(queue(segment));
        MOTIONRACK_CHECK(wait_for_junction(segment));
        MOTIONRACK_CHECK(accelerate_late(segment));
        MOTIONRACK_CHECK(write_speed(segment));
    }
    ++segments_;
    MOTIONRACK_CHECK(begin_segment(segment));
    chain_running_ = !segment.ends_chain;
    return {};
}

Result<void> ChipAxisGroup::play_pause(const Segment& segment) {
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

// ---- chains

Result<void> ChipAxisGroup::start_chain(const Segment& segment) {
    generator_ = segment.axes[0];
    prepared_ = 1u << generator_;
    chain_axes_ = 0;
    catches_up_ = false;
    s_curve_ = segment.s_curve;
    even_ = segment.even;
    braking_ = false;
    const unsigned own = 1u << generator_;
    MOTIONRACK_CHECK(driver_.WriteRange(own, range_));
    MOTIONRACK_CHECK(driver_.WriteRange(xyzu & ~own, std::llround(range_ * both_axes_factor)));
    MOTIONRACK_CHECK(driver_.SetSV(own, segment.initial_speed));
    driver_.SetSCurve(own, segment.s_curve);
    if (segment.s_curve) {
        MOTIONRACK_CHECK(driver_.AutoDec(own));
        MOTIONRACK_CHECK(driver_.SetAA(own, segment.jerk));
        MOTIONRACK_CHECK(driver_.SetAO(own, segment.offset));
    }
    driver_.EnableDeceleration(segment.s_curve);
    written_speed_ = written_acceleration_ = 0;
    running_speed_ = segment.initial_speed;
    MOTIONRACK_CHECK(write_speed(segment));
    return command(segment);
}

/// Queues the segment behind the running one. If the host is late, the chip is stationary at the junction, and the
/// segment starts from there.
Result<void> ChipAxisGroup::queue(const Segment& segment) {
    if (const unsigned first = 1u << segment.axes[0]; (prepared_ & first) == 0) {
        MOTIONRACK_CHECK(prepare_to_drive(driver_, first));
        prepared_ |= first;
    }
    const MainStatus status = driver_.status();
    if (status.interpolating()) return command(segment);
    if (was_stopped(driver_, chain_axes_) || (probing_ && probe_hit())) return stopped_by_machine();
    if (braking_) return stopped_by_user();  // already stationary
    MOTIONRACK_CHECK(restart_late(segment));
    return command(segment);
}

Result<void> ChipAxisGroup::command(const Segment& segment) {
    driver_.SetInterpolationAxes(segment.axes[0], segment.axes[1], segment.axis_count > 2 ? segment.axes[2] : -1,
                                 segment.constant_vector, true);
    if (segment.kind == SegmentKind::line) {
        std::array<Finish, 3> ends{};
        for (std::size_t i = 0; i < segment.axis_count; ++i) ends[i] = {segment.axes[i], segment.finish[i], 0};
        return driver_.Line(ends.data(), segment.axis_count);
    }
    return driver_.Arc({{segment.axes[0], segment.finish[0], segment.centre[0]},
                        {segment.axes[1], segment.finish[1], segment.centre[1]}},
                       segment.kind == SegmentKind::arc_cw);
}

/// Waits until the queued segment is running.
Result<void> ChipAxisGroup::wait_for_junction(const Segment& queued) {
    bool woken = false;
    for (bool first = true;; first = false) {
        const MainStatus status = driver_.status();
        if (status.can_queue()) {
            if (status.error(xyzu) && !are_at(driver_, expected_, auxiliary_)) return stopped_by_machine();
            // A segment that runs at once may have started from standstill: the chip may have stopped before the last
            // word arrived.
            if (!first || (driver_.read_interrupts(generator_) & field("RR3", "DEND").mask) == 0) return {};
            if (was_stopped(driver_, chain_axes_ & ~axes_of(queued)) ||
                !is_within(driver_, expected_, queued, auxiliary_))
                return stopped_by_machine();
            return restart_late(queued);
        }
        if (!status.interpolating()) {
            if (was_stopped(driver_, chain_axes_ | axes_of(queued))) return stopped_by_machine();
            ran_alone_ = true;  // it has already run and ended
            return {};
        }
        if (std::exchange(woken, false)) {
            // Another interrupt caused the wake-up: the end of the auxiliary. The interrupt of a free queue may have
            // been cleared with it.
            clear_interrupts();
            continue;
        }
        const bool brakes = driver_.interrupt().stop_requested();
        if (brakes) MOTIONRACK_CHECK(decelerate());
        // The next segment is queued as soon as the queue is free, also while the axes decelerate.
        woken = wait_for_interrupt(driver_.interrupt(), brakes);
    }
}

Result<void> ChipAxisGroup::write_speed(const Segment& segment) {
    const unsigned own = 1u << generator_;
    rest_speed_ = segment.rest_speed;
    const std::int32_t speed = braking_ ? std::min(segment.speed, rest_speed_) : segment.speed;
    if (speed != written_speed_) MOTIONRACK_CHECK(driver_.SetV(own, speed));
    written_speed_ = speed;
    braking_acceleration_ = segment.braking;
    catches_up_ = catches_up_ && driver_.ReadCV(generator_) < running_speed_;
    return write_acceleration(braking_ || catches_up_ ? segment.braking : segment.acceleration);
}

Result<void> ChipAxisGroup::write_acceleration(std::int32_t acceleration) {
    if (acceleration != written_acceleration_) MOTIONRACK_CHECK(driver_.SetA(1u << generator_, acceleration));
    written_acceleration_ = acceleration;
    return {};
}

/// Decelerates for a requested stop; one poll. A stop command would end the drive at the end of the queued segment, at
/// any speed. Therefore the speed is reduced first while segments are still queued, and the command follows at the low
/// speed. An S-curve stops within its line, and constant-acceleration segments continue until the trajectory has
/// decelerated.
Result<void> ChipAxisGroup::decelerate() {
    if (even_) return {};
    if (!driver_.status().interpolating() || s_curve_) return stopped_by_user();
    if (!braking_ && written_speed_ > rest_speed_) {
        MOTIONRACK_CHECK(write_acceleration(braking_acceleration_));
        MOTIONRACK_CHECK(driver_.SetV(1u << generator_, rest_speed_));
        written_speed_ = rest_speed_;
    }
    braking_ = true;
    if (driver_.ReadCV(generator_) <= rest_speed_) return stopped_by_user();
    return {};
}

Result<void> ChipAxisGroup::begin_segment(const Segment& segment) {
    if (segment.block != last_block_) starts_.push_back({segment.block, segment.line, driver_.interrupt().now()});
    last_block_ = segment.block;
    current_line_ = segment.line;
    const Instant now = driver_.interrupt().now(),
                  begun = std::exchange(ran_alone_, false) ? std::min(now, runs_until_) : now;
    runs_until_ = begun + from_seconds(segment_seconds(segment, running_speed_, range_));
    running_speed_ = segment.speed;
    chain_axes_ |= axes_of(segment);
    for (std::size_t i = 0; i < segment.axis_count; ++i) expected_[segment.axes[i]] += segment.moves[i];
    if (segment.auxiliary_channel >= 0) MOTIONRACK_CHECK(update_auxiliary_velocity(segment));
    return {};
}

Result<void> ChipAxisGroup::wait_until_all_stand() {
    while (true) {
        const MainStatus status = driver_.status();
        if (!status.driving(xyzu) && !status.interpolating()) break;
        // A switch or an alarm has ended the path; the auxiliary does not stop by itself.
        if (!status.interpolating() && status.error(xyzu)) driver_.SlowStop(xyzu);
        const bool brakes = driver_.interrupt().stop_requested();
        if (brakes) MOTIONRACK_CHECK(decelerate());
        if (wait_for_interrupt(driver_.interrupt(), brakes)) clear_interrupts();
    }
    clear_interrupts();
    return {};
}

Result<void> ChipAxisGroup::wait_for_standstill() {
    chain_running_ = false;
    MOTIONRACK_CHECK(wait_until_all_stand());
    if (auxiliary_ >= 0) {
        MOTIONRACK_CHECK(finish_auxiliary());
        MOTIONRACK_CHECK(wait_until_all_stand());
    }
    auxiliary_ = -1;
    for (int c = 0; c < channel_count; ++c)
        if (driver_.ReadLPS(c) != expected_[static_cast<std::size_t>(c)]) return stopped_by_machine();
    return {};
}

// ---- stops

void ChipAxisGroup::stop(bool immediate) {
    if (immediate)
        driver_.QuickStop(xyzu);
    else
        driver_.SlowStop(xyzu);
    chain_running_ = false;
    if (segmenter_) segmenter_.emplace(map_, range_, expected_, host_);
}

void ChipAxisGroup::clear_interrupts() {
    for (int c = 0; c < channel_count; ++c) driver_.read_interrupts(c);
    driver_.ClearInterpolationInterrupt();
}

tl::unexpected<Error> ChipAxisGroup::stopped_by_machine() {
    driver_.SlowStop(xyzu);
    while (driver_.status().driving(xyzu)) driver_.interrupt().pass(microseconds(100));
    std::string why;
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        if (map_.channel[i] < 0) continue;
        const std::string cause = driver_.axis_status(map_.channel[i]).why_stopped();
        if (!cause.empty())
            why += fmt::format("{}axis {}: {}", why.empty() ? "" : "; ", control::axis_letters[i], cause);
    }
    if (why.empty()) why = "the chip's counters differ from the end of the path";
    chain_running_ = false;
    return fail(
        ErrorKind::machine,
        fmt::format("The motion was stopped in line {}: {}. The axes stand at {}. Nothing after it was executed; "
                    "clear the cause, move back and start again.",
                    current_line_, why, control::position_text(commanded_position(), map_.limits)),
        {current_line_, 1});
}

tl::unexpected<Error> ChipAxisGroup::stopped_by_user() {
    braking_ = false;
    driver_.SlowStop(xyzu);
    while (driver_.status().driving(xyzu)) driver_.interrupt().pass(microseconds(100));
    chain_running_ = false;
    return control::stopped_on_request(current_line_, commanded_position(), map_.limits);
}

// ---- polling

control::Point ChipAxisGroup::commanded_position() {
    control::Point out = {};
    for (std::size_t i = 0; i < map_.channel.size(); ++i)
        if (map_.channel[i] >= 0) out[i] = driver_.ReadLPS(map_.channel[i]) / map_.limits[i].pulses_per_unit;
    return out;
}

std::vector<control::PathWarning> ChipAxisGroup::take_path_warnings() {
    std::vector<control::PathWarning> out = std::exchange(notes_, {});
    if (segmenter_)
        for (control::PathWarning& note : segmenter_->take_path_warnings()) out.push_back(std::move(note));
    return out;
}

}  // namespace motionrack::mcx314
