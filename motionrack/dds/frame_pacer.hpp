// Computes the due times of frames in real time. Every due time is relative to the first frame, so errors do not
// accumulate. The pacer reads no clock.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>

namespace motionrack::dds {

class FramePacer {
  public:
    static constexpr Duration max_behind = whole_seconds(1);

    /// `time_scale`: bus time per unit of real time, > 0; `pace`: real time between two frames.
    FramePacer(double time_scale, Duration pace) : time_scale_(time_scale), pace_(pace) {}

    /// Returns the due time of the frame with the bus time `frame`; `now`: the present time. The first frame is due at
    /// once. A due time in the past means publication at once; the frame counts as late if it is more than one pace
    /// behind. A frame more than `max_behind` behind, or earlier than the first one, restarts the schedule at `now`;
    /// the former counts as a slip.
    Instant due(Instant frame, Instant now);

    std::uint64_t late() const { return late_; }
    std::uint64_t slips() const { return slips_; }
    Duration max_lateness() const { return max_lateness_; }  ///< time behind schedule of the frame that was latest

  private:
    double time_scale_;
    Duration pace_, max_lateness_{};
    bool begun_ = false;
    Instant first_frame_{}, first_due_{};
    std::uint64_t late_ = 0, slips_ = 0;
};

}  // namespace motionrack::dds
