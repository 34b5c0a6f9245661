// Switching of the cam at crossings of the watched position.
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/reference_cam.hpp>

namespace motionrack::parts {

ReferenceCam::ReferenceCam(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position,
                           std::int64_t from, std::int64_t to, int active_level)
    : kernel_(kernel),
      position_(position),
      interval_{from, to},
      active_level_(active_level),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      wire_(kernel.add_wire(name, 1 - active_level)),
      slot_(position.add_listener(*this)) {
    MOTIONRACK_ASSERT(from <= to);
    kernel.schedule(id_, Instant{0});
}

bool ReferenceCam::active(Instant t) const {
    return interval_.has(position_.count(t));
}

void ReferenceCam::on_scheduled(Instant now) {
    update(now);
}

void ReferenceCam::update(Instant now) {
    kernel_.set_wire(wire_, active(now) ? active_level_ : 1 - active_level_);
    const sim::Range side = interval_.side_of(position_.count(now));
    position_.watch(slot_, side.below, side.above);
}

}  // namespace motionrack::parts
