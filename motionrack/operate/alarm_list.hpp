// Alarms of an operated machine: raised, acknowledged, and removed when they are over.
#pragma once

#include <cstdint>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::operate {

class AlarmList {
  public:
    /// `alarms`: the status' list, at most `max` alarms, dated in the rack's virtual time. `rack` and `alarms` must
    /// outlive this.
    AlarmList(const rack::Rack& rack, std::vector<Alarm>& alarms, std::size_t max)
        : rack_(rack), alarms_(alarms), max_(max) {}

    /// Adds an active alarm; one of an axis replaces the axis' earlier ones. Ended and acknowledged alarms are removed
    /// first, then the oldest. An alarm that is active already is not added again, but has to be acknowledged again.
    /// The result is valid until the next alarm.
    Alarm& raise(std::string source, std::string text, char axis = '\0');
    /// Raises one alarm for each of these, with its source, text and axis; ignores their other fields.
    void raise(std::vector<Alarm> alarms);
    /// Ends and acknowledges the alarms of these axes, because the alarm that is raised next also covers them.
    void supersede(std::string_view axes);
    /// Acknowledges the alarm with this Alarm::number. Returns false if no alarm has it.
    bool acknowledge(std::int64_t number);
    /// Ends the alarms whose cause a reset ends.
    void reset();
    /// Ends the alarms of this source that a reset does not end.
    void end_staying(std::string_view source);

  private:
    const rack::Rack& rack_;
    std::vector<Alarm>& alarms_;
    std::size_t max_;
    std::int64_t next_ = 1;
};

}  // namespace motionrack::operate
