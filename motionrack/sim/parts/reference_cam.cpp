// The cam's switch changes where the watched place is crossed.
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/reference_cam.hpp>

namespace motionrack::parts {

ReferenceCam::ReferenceCam(sim::Kernel& kernel, const std::string& name, sim::Motion& place, std::int64_t from, std::int64_t to)
    : kernel_(kernel),
      place_(place),
      from_(from),
      to_(to),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      wire_(kernel.add_wire(name, 0)),
      slot_(place.listen(*this)) {
    MOTIONRACK_ASSERT(from <= to);
    kernel.schedule(id_, Instant{0});
}

void ReferenceCam::act(Instant now) {
    look(now);
}

void ReferenceCam::look(Instant now) {
    const std::int64_t here = place_.count(now);
    kernel_.set_wire(wire_, here >= from_ && here <= to_);
    if (here < from_)
        place_.watch(slot_, sim::unwatched_below, from_);
    else if (here > to_)
        place_.watch(slot_, to_, sim::unwatched_above);
    else
        place_.watch(slot_, from_ - 1, to_ + 1);
}

}  // namespace motionrack::parts
