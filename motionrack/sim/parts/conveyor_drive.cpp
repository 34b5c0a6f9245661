// Velocity changes of a conveyor.
#include <cmath>
#include <motionrack/sim/parts/conveyor_drive.hpp>

namespace motionrack::parts {

ConveyorDrive::ConveyorDrive(sim::Kernel& kernel, const std::string& name, const Conveyor& track, double max_velocity)
    : track_(track), max_velocity_(max_velocity), id_(kernel.add(*this, sim::Phase::parts, name)) {}

bool ConveyorDrive::fault(std::string_view name, double value, Instant now) {
    const bool by_hand = name == "drive.speed";
    if (!by_hand && name != "drive.profile") return false;
    if (!(std::fabs(value) <= max_velocity_)) return false;
    if (!by_hand) return go_on(now), true;
    change(now, [value](Conveyor& track, double at_s) { track.drive(at_s, value); });
    return true;
}

void ConveyorDrive::stop(Instant now) {
    change(now, [](Conveyor& track, double at_s) { track.stop(at_s); });
}

void ConveyorDrive::go_on(Instant now) {
    change(now, [](Conveyor& track, double at_s) { track.follow_profile(at_s); });
}

template <class Change>
void ConveyorDrive::change(Instant now, Change&& how) {
    for (ConveyorPosition* motion : motions_) motion->deliver_edges();
    const double velocity_before = track_.velocity(to_seconds(now));
    how(track_, to_seconds(now));
    for (ConveyorPosition* motion : motions_) motion->changed(velocity_before);
}

}  // namespace motionrack::parts
