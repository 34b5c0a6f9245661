// Generates the path of the present activity, a position every 10 us: lines, arcs, delays, waits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/block_buffers.hpp>
#include <motionrack/cards/rtc5/model/input_wait.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <motionrack/cards/rtc5/model/wobbel_motion.hpp>

namespace motionrack::rtc5 {

class PathGenerator {
  public:
    /// `settings`, `activity` and `p` (the present position): parts of the card's state, which must outlive this.
    PathGenerator(PathSettings& settings, Activity& activity, Point& p, InputWait& wait, WobbelMotion& wobbel,
                  BlockBuffers& buffers)
        : settings_(settings), activity_(activity), p_(p), wait_(wait), wobbel_(wobbel), buffers_(buffers) {}

    // ---- commands
    Result<void> set_delays(const Delays& delays);
    void set_jump_speed(double bits_ms);
    void set_mark_speed(double bits_ms);
    /// Executes a list command that sets speeds or delays: set_jump_speed, set_mark_speed, set_scanner_delays,
    /// set_laser_delays.
    void take(const Command& c);
    const Delays& delays() const { return settings_.delays; }

    // ---- begin of an activity
    /// Starts a straight line to `target`. `steps`: its duration in ticks; 0: derived from `speed` (bits/ms).
    void begin_line(Point target, double speed, Ending ending, std::int64_t steps = 0);
    void begin_jump(Point target) { begin_line(target, settings_.jump_speed, Ending::jump); }
    void begin_mark(Point target) { begin_line(target, settings_.mark_speed, Ending::mark); }
    void begin_arc(const Command& c);
    void begin_hold(std::int64_t ticks, Ending ending = Ending::none);
    /// Starts the wait of wait_for_encoder, wait_for_encoder_mode, wait_for_encoder_in_range or wait_for_mcbsp.
    void begin_wait(const Command& c);
    void stop() { activity_ = {}; }
    /// Returns the end point of a jump, mark or micro-vector; the centre of an arc.
    Point target_of(const Command& c) const;
    /// Returns the delay after a finished jump, in ticks.
    std::int64_t jump_delay(const Activity& jump) const;
    /// Returns the delay at the corner before the next mark, in ticks; sets `cut` if the laser is off during it.
    std::int64_t corner_delay(const Command& next, bool& cut) const;

    /// Writes the positions of the activity from tick n of the block on, up to `capacity`. Returns the next tick.
    std::size_t fill(std::size_t n, std::size_t capacity);
    /// Writes the present position from tick n of the block on, up to `capacity`.
    void stay(std::size_t n, std::size_t capacity);

  private:
    Point direction_of(const Command& mark) const;

    PathSettings& settings_;
    Activity& activity_;
    Point& p_;
    InputWait& wait_;
    WobbelMotion& wobbel_;
    BlockBuffers& buffers_;
};

}  // namespace motionrack::rtc5
