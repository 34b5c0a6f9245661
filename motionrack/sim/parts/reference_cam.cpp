// The cam's switch changes where the watched place is crossed.
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/reference_cam.hpp>

namespace motionrack::parts {

ReferenceCam::ReferenceCam(sim::Kernel& kernel, const std::string& name, sim::Motion& place, std::int64_t from, std::int64_t to,
                           int active_level)
    : kernel_(kernel),
      place_(place),
      from_(from),
      to_(to),
      active_level_(active_level),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      wire_(kernel.add_wire(name, 1 - active_level)),
      slot_(place.listen(*this)) {
    MOTIONRACK_ASSERT(from <= to);
    kernel.schedule(id_, Instant{0});
}

bool ReferenceCam::active(Instant t) const {
    const std::int64_t here = place_.count(t);
    return here >= from_ && here <= to_;
}

void ReferenceCam::act(Instant now) {
    look(now);
}

void ReferenceCam::look(Instant now) {
    const std::int64_t here = place_.count(now);
    kernel_.set_wire(wire_, active(now) ? active_level_ : 1 - active_level_);
    if (here < from_)
        place_.watch(slot_, sim::unwatched_below, from_);
    else if (here > to_)
        place_.watch(slot_, to_, sim::unwatched_above);
    else
        place_.watch(slot_, from_ - 1, to_ + 1);
}

}  // namespace motionrack::parts
