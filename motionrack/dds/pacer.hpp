// When a frame is due in real time. Every due time comes from the first frame's, so that nothing adds up; the pacer
// knows no clock.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>

namespace motionrack::dds {

class FramePacer {
  public:
    static constexpr Duration max_behind = whole_seconds(1);

    /// `speed`: bus time that passes in a unit of real time, above 0; `pace`: real time between two frames.
    FramePacer(double speed, Duration pace) : speed_(speed), pace_(pace) {}

    /// When the frame of bus time `frame` is due, asked at `now`. The first frame is due at once. What is due in the
    /// past is published at once and counted as late if it is by more than a pace; who is behind by more than
    /// `max_behind` does not catch up: the schedule begins anew, which is a slip.
    Instant due(Instant frame, Instant now);

    std::uint64_t late() const { return late_; }
    std::uint64_t slips() const { return slips_; }
    Duration worst() const { return worst_; }  ///< how late the latest frame was

  private:
    double speed_;
    Duration pace_, worst_{};
    bool begun_ = false;
    Instant first_frame_{}, first_due_{};
    std::uint64_t late_ = 0, slips_ = 0;
};

}  // namespace motionrack::dds
