// Commands that set the position of an axis, until the motion thread has carried them out.
#pragma once

#include <motionrack/operate/alarm_list.hpp>
#include <motionrack/operate/axis_handover.hpp>
#include <motionrack/operate/position_validity.hpp>
#include <motionrack/operate/status_publisher.hpp>
#include <vector>

namespace motionrack::operate {

/// Used only by the motion thread.
class PositionSetter {
  public:
    /// All must outlive this.
    PositionSetter(PositionValidity& validity, AxisHandover& handover, StatusPublisher& publisher, AlarmList& alarms)
        : validity_(validity), handover_(handover), publisher_(publisher), alarms_(alarms) {}

    /// Requests that the position of the axis at this instant be `position` (mm or degrees).
    void request(char letter, double position) { pending_.push_back(validity_.declared(letter, position)); }
    bool any() const { return !pending_.empty(); }
    /// Sets the requested positions, and gives the axes back to the executor. A failure becomes the status' reason; if
    /// the position was valid before, it is invalidated with an alarm. Errors: as AxisHandover::take_group.
    Result<void> step();

  private:
    PositionValidity& validity_;
    AxisHandover& handover_;
    StatusPublisher& publisher_;
    AlarmList& alarms_;
    std::vector<Declared> pending_;  ///< until all of them are set
};

}  // namespace motionrack::operate
