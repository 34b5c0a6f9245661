// Number of the part at the sensor.
#include <algorithm>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/part_sensor.hpp>
#include <motionrack/sim/parts/range.hpp>

namespace motionrack::parts {

PartSensor::PartSensor(sim::Kernel& kernel, const std::string& name, const std::string& wire,
                       sim::PositionFunction& position, const PartSensorSettings& settings)
    : kernel_(kernel),
      position_(position),
      settings_(settings),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      wire_(kernel.add_wire(wire, 1)),
      slot_(position.add_listener(*this)) {
    MOTIONRACK_ASSERT(settings.every > 0 && settings.length > 0 && settings.length < settings.every);
    kernel.schedule(id_, Instant{0});
}

/// Number of the part whose edge came last; negative: before the first one.
std::int64_t PartSensor::number(std::int64_t position) const {
    return floor_div(Wide{position} - settings_.first, settings_.every);
}

std::int64_t PartSensor::parts(Instant now) const {
    return std::max<std::int64_t>(number(position_.count(now)) + 1, 0);
}

void PartSensor::update(Instant now) {
    const std::int64_t position = position_.count(now), n = number(position);
    const std::int64_t edge = settings_.first + n * settings_.every, end = edge + settings_.length;
    const bool there = n >= 0 && position < end;
    kernel_.set_wire(wire_, there ? 0 : 1);
    // Left at the previous count, and at the count itself: see PositionFunction::watch.
    position_.watch(slot_, (position < end ? edge : end) - 1, position < end ? end : edge + settings_.every);
}

}  // namespace motionrack::parts
