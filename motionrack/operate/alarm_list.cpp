// Changes of the alarms.
#include <algorithm>
#include <motionrack/operate/alarm_list.hpp>
#include <utility>

namespace motionrack::operate {

Alarm& AlarmList::raise(std::string source, std::string text, char axis) {
    const auto same = std::find_if(alarms_.begin(), alarms_.end(), [&](const Alarm& alarm) {
        return alarm.active && alarm.source == source && alarm.text == text && alarm.axis == axis;
    });
    if (same != alarms_.end()) {
        same->acknowledged = false;
        return *same;
    }
    if (axis != '\0') supersede({&axis, 1});
    alarms_.erase(std::remove_if(alarms_.begin(), alarms_.end(),
                                 [](const Alarm& alarm) { return !alarm.active && alarm.acknowledged; }),
                  alarms_.end());
    if (alarms_.size() >= max_) alarms_.erase(alarms_.begin());
    alarms_.push_back({next_++, rack_.kernel().now(), std::move(source), std::move(text)});
    alarms_.back().axis = axis;
    return alarms_.back();
}

void AlarmList::raise(std::vector<Alarm> alarms) {
    for (Alarm& one : alarms) raise(std::move(one.source), std::move(one.text), one.axis);
}

void AlarmList::supersede(std::string_view axes) {
    for (Alarm& alarm : alarms_)
        if (alarm.axis != '\0' && axes.find(alarm.axis) != std::string_view::npos)
            alarm.active = false, alarm.acknowledged = true;
}

bool AlarmList::acknowledge(std::int64_t number) {
    for (Alarm& one : alarms_)
        if (one.number == number) return one.acknowledged = true;
    return false;
}

void AlarmList::reset() {
    for (Alarm& alarm : alarms_) alarm.active = alarm.stays;
}

void AlarmList::end_staying(std::string_view source) {
    for (Alarm& alarm : alarms_)
        if (alarm.stays && alarm.source == source) alarm.stays = alarm.active = false;
}

}  // namespace motionrack::operate
