// The probe's wire changes where an axis crosses a face of the block while the others are within it.
#include <algorithm>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/touch_probe.hpp>

namespace motionrack::parts {

TouchProbe::TouchProbe(sim::Kernel& kernel, const std::string& name)
    : kernel_(kernel), id_(kernel.add(*this, sim::Phase::parts, "touch_" + name)), wire_(kernel.add_wire(name, 0)) {
    kernel.schedule(id_, Instant{0});
}

void TouchProbe::add_range(sim::Motion& place, std::int64_t from, std::int64_t to) {
    MOTIONRACK_ASSERT(from <= to);
    sides_.emplace_back(*this, place, from, to);
}

bool TouchProbe::touches(Instant t) const {
    const auto within = [&](const Side& side) {
        const std::int64_t here = side.place.count(t);
        return here >= side.from && here <= side.to;
    };
    return !sides_.empty() && std::all_of(sides_.begin(), sides_.end(), within);
}

void TouchProbe::act(Instant now) {
    look(now);
}

void TouchProbe::look(Instant now) {
    kernel_.set_wire(wire_, touches(now));
    for (Side& side : sides_) side.aim(side.place.count(now));
}

void TouchProbe::Side::aim(std::int64_t here) {
    if (here < from)
        place.watch(slot, sim::unwatched_below, from);
    else if (here > to)
        place.watch(slot, to, sim::unwatched_above);
    else
        place.watch(slot, from - 1, to + 1);
}

}  // namespace motionrack::parts
