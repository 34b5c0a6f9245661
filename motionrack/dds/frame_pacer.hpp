// Due times of frames in real time. Every due time is relative to the first frame, so errors do not accumulate; the
// pacer uses no clock.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>

namespace motionrack::dds {

class FramePacer {
  public:
    static constexpr Duration max_behind = whole_seconds(1);

    /// `time_scale`: bus time per unit of real time, > 0; `pace`: real time between two frames.
    FramePacer(double time_scale, Duration pace) : time_scale_(time_scale), pace_(pace) {}

    /// Due time of the frame of bus time `frame`, queried at `now`. The first frame is due at once. A past due time
    /// means publication at once, counted as late beyond one pace. Beyond `max_behind` the schedule restarts instead of
    /// catching up, which is a slip.
    Instant due(Instant frame, Instant now);

    std::uint64_t late() const { return late_; }
    std::uint64_t slips() const { return slips_; }
    Duration max_lateness() const { return max_lateness_; }  ///< lateness of the latest frame

  private:
    double time_scale_;
    Duration pace_, max_lateness_{};
    bool begun_ = false;
    Instant first_frame_{}, first_due_{};
    std::uint64_t late_ = 0, slips_ = 0;
};

}  // namespace motionrack::dds
