// Outputs of one axis: rotor and encoder as position functions, the index wire, the edges.
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/parts/edge_generator.hpp>

namespace motionrack::parts {

sim::PositionFunction& AxisMechanics::rotor() {
    return positions_[rotor_face];
}
sim::PositionFunction& AxisMechanics::encoder() {
    return positions_[encoder_face];
}

// ---- The index wire

int AxisMechanics::level_at(int, Instant now) const {
    return encoder_.index(input_.rotor_at(now));
}

void AxisMechanics::wanted_changed(int, bool wanted, Instant now) {
    index_.subscribe(wanted, input_.rotor_at(now));
    aim(now);
}

// ---- Edges

void AxisMechanics::set_edge_listener(MechanicsAdapter face, sim::EdgeListener* listener) {
    MOTIONRACK_ASSERT(input_.connected());
    const bool before = edge_listeners_[rotor_face] || edge_listeners_[encoder_face];
    edge_listeners_[face] = face == encoder_face && !encoder_.present() ? nullptr : listener;
    const bool after = edge_listeners_[rotor_face] || edge_listeners_[encoder_face];
    if (after && !before) state_.edges_until = input_.rotor_at(kernel_.now());
    input_.set_edge_listener(after || pulse_edges_ ? this : nullptr);
}

void AxisMechanics::listen_pulse_edges(sim::EdgeListener* listener) {
    pulse_edges_ = listener;
    input_.set_edge_listener(pulse_edges_ || edge_listeners_[rotor_face] || edge_listeners_[encoder_face] ? this
                                                                                                          : nullptr);
}

void AxisMechanics::edges(const sim::EdgeBatch& batch) {
    if (pulse_edges_) pulse_edges_->edges(batch);
    if (!edge_listeners_[rotor_face] && !edge_listeners_[encoder_face]) return;
    std::int64_t size = batch.size;
    // A rotor that has just reached its end of travel still delivers the edges up to there; a stationary one delivers
    // none.
    if (!motor_.in_step())
        size = std::clamp<std::int64_t>((state_.motor.rotor_position - state_.edges_until) * batch.step, 0, size);
    if (size == 0) return;
    const std::int64_t first =
        motor_.in_step() ? batch.first_count - state_.motor.lost : state_.edges_until + batch.step;
    state_.edges_until = first + batch.step * (size - 1);
    edge_generator_->pass(encoder_, edge_listeners_, batch, first, static_cast<std::uint32_t>(size));
}

}  // namespace motionrack::parts
