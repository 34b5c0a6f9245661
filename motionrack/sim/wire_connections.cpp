// Copies levels and subscriptions from wire to wire.
#include <motionrack/sim/wire_connections.hpp>
#include <utility>

namespace motionrack::sim {

WireConnections::WireConnections(Kernel& kernel, std::string name)
    : kernel_(kernel), id_(kernel.add(*this, Phase::wires, std::move(name))) {}

void WireConnections::join(WireId from, WireId to, bool inverted) {
    MOTIONRACK_ASSERT(from != to);
    const int pin = static_cast<int>(joints_.size());
    joints_.push_back({from, to, inverted, kernel_.lazy(from)});
    kernel_.listen(from, id_, pin);
    if (joints_.back().lazy)
        kernel_.drive_lazily(to, id_, pin);
    else
        kernel_.schedule(id_, Instant{0});
}

void WireConnections::on_scheduled(Instant) {
    for (const Connection& joint : joints_)
        if (!joint.lazy) kernel_.set_wire(joint.to, joint.level(kernel_.level(joint.from)));
}

void WireConnections::on_wire(int pin, int level, Instant) {
    const Connection& joint = joints_[static_cast<std::size_t>(pin)];
    if (!joint.lazy || kernel_.wanted(joint.to)) kernel_.set_wire(joint.to, joint.level(level));
}

int WireConnections::level_at(int pin, Instant) const {
    const Connection& joint = joints_[static_cast<std::size_t>(pin)];
    return joint.level(kernel_.level(joint.from));
}

void WireConnections::wanted_changed(int pin, bool, Instant) {
    const WireId from = joints_[static_cast<std::size_t>(pin)].from;
    bool any = false;
    for (const Connection& joint : joints_) any = any || (joint.from == from && kernel_.wanted(joint.to));
    kernel_.subscribe(from, id_, any);
}

}  // namespace motionrack::sim
