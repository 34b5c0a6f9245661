// The probe's wire changes when an axis crosses a face of the block while the others are within it.
#include <algorithm>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/touch_probe.hpp>

namespace motionrack::parts {

TouchProbe::TouchProbe(sim::Kernel& kernel, const std::string& name)
    : kernel_(kernel), id_(kernel.add(*this, sim::Phase::parts, "touch_" + name)), wire_(kernel.add_wire(name, 0)) {
    kernel.schedule(id_, Instant{0});
}

void TouchProbe::add_range(sim::PositionFunction& position, std::int64_t from, std::int64_t to) {
    MOTIONRACK_ASSERT(from <= to);
    sides_.emplace_back(*this, position, sim::Interval{from, to});
}

bool TouchProbe::touches(Instant t) const {
    const auto within = [t](const Side& side) { return side.interval.has(side.position.count(t)); };
    return !sides_.empty() && std::all_of(sides_.begin(), sides_.end(), within);
}

void TouchProbe::on_scheduled(Instant now) {
    update(now);
}

void TouchProbe::update(Instant now) {
    kernel_.set_wire(wire_, touches(now));
    for (Side& side : sides_) {
        const sim::Range around = side.interval.side_of(side.position.count(now));
        side.position.watch(side.slot, around.below, around.above);
    }
}

}  // namespace motionrack::parts
