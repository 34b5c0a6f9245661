// A late host: the chip stops in the middle of a path, and motion continues from there.
//
//   planned  ----\        The segment brakes from a speed that the chip has not reached. At its V from the start on it
//                 \       would creep to its end: it accelerates first, as far as braking leaves room.
//   late      /\   \      _
//         ___/  \___\___
#include <algorithm>
#include <cmath>
#include <motionrack/cards/mcx314/axes/chip_axis_group.hpp>

namespace motionrack::mcx314 {

namespace {

/// Register accesses from reading the speed to the lower V, and as many from a junction to reading it.
constexpr double accesses_to_brake = 12;
/// Share of the room that is used: the chip's slopes are quantised to whole steps and clocks.
constexpr double room_used = 0.95;
/// A smaller gain of speed is not worth two writes.
constexpr double min_gain = 1.05;
constexpr Duration stop_look = microseconds(50);

}  // namespace

/// Records that the chip was stationary before it received this segment, whose first axis drives the chain from here
/// on. R of that axis stays the one of a second axis: its path is slower, never faster.
Result<void> ChipAxisGroup::restart_late(const Segment& segment) {
    const Instant now = driver_.interrupt().now();
    notes_.push_back({segment.line, "", 0, to_seconds(std::max<Duration>(host_.access, now - runs_until_)),
                      std::min(now, runs_until_)});
    clear_interrupts();
    chain_axes_ = 0;
    catches_up_ = true;
    if (std::exchange(generator_, segment.axes[0]) != segment.axes[0]) written_speed_ = written_acceleration_ = 0;
    MOTIONRACK_CHECK(driver_.SetSV(1u << generator_, segment.rest_speed));
    return write_speed(segment);
}

/// Before the V of a segment that brakes: while the chain is behind its plan, up to the speed from which the chip
/// still brakes within the segment. The speed stays below the planned one. An auxiliary axis could not follow.
Result<void> ChipAxisGroup::accelerate_late(const Segment& segment) {
    if (!catches_up_ || braking_ || segment.auxiliary_channel >= 0 || segment.speed >= running_speed_) return {};
    const double slope = rules::rate_unit * segment.braking, now = driver_.ReadCV(generator_), end = segment.speed,
                 reaction = to_seconds(host_.latency) + accesses_to_brake * to_seconds(host_.access),
                 room = room_used * segment_length(segment, range_) - reaction * running_speed_;
    if (room <= 0) return {};
    const double top = std::min(std::sqrt(slope * room + (now * now + end * end) / 2), running_speed_ - 1);
    if (top < min_gain * std::max(now, end)) return {};
    MOTIONRACK_CHECK(write_acceleration(segment.braking));
    written_speed_ = static_cast<std::int32_t>(top);
    MOTIONRACK_CHECK(driver_.SetV(1u << generator_, written_speed_));
    const Instant begin = driver_.interrupt().now(), brakes = begin + from_seconds((top - now) / slope);
    if (std::exchange(last_block_, segment.block) != segment.block)
        starts_.push_back({segment.block, segment.line, begin});
    while (driver_.interrupt().now() < brakes && !driver_.interrupt().stop_requested())
        driver_.interrupt().pass(std::min<Duration>(stop_look, brakes - driver_.interrupt().now()));
    return {};
}

}  // namespace motionrack::mcx314
