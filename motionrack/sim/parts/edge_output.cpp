// Listeners of edges, and the edges that a rotor out of step still makes.
#include <algorithm>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/edge_output.hpp>

namespace motionrack::parts {

void EdgeOutput::set_listener(MechanicsFaces::MechanicsAdapter face, sim::EdgeListener* listener, Instant now) {
    MOTIONRACK_ASSERT(input_.connected());
    const bool before = wanted();
    listeners_[face] = face == MechanicsFaces::encoder_face && !encoder_.present() ? nullptr : listener;
    if (wanted() && !before) until_ = input_.rotor_at(now);
    listen();
}

void EdgeOutput::set_pulse_listener(sim::EdgeListener* listener) {
    pulse_listener_ = listener;
    listen();
}

void EdgeOutput::jump(std::int64_t from, std::int64_t to, Instant now) {
    if (from == to || !wanted()) return;
    generator_->jump(encoder_, listeners_, now, until_, to);
    until_ = to;
}

void EdgeOutput::count_jump(std::int64_t from, std::int64_t to, Instant now) {
    sim::EdgeListener* listener = listeners_[MechanicsFaces::encoder_face];
    if (listener) generator_->count_jump(*listener, now, from, to);
}

void EdgeOutput::edges(const sim::EdgeBatch& batch) {
    if (pulse_listener_) pulse_listener_->edges(batch);
    if (!wanted()) return;
    const bool in_step = motor_.hold == RotorHold::in_step;
    std::int64_t size = batch.size;
    // A rotor that has just reached its end of travel still delivers the edges up to there; a stationary one delivers
    // none.
    if (!in_step) size = std::clamp<std::int64_t>((motor_.rotor_position - until_) * batch.step, 0, size);
    if (size == 0) return;
    const std::int64_t first = in_step ? batch.first_count - motor_.lost : until_ + batch.step;
    until_ = first + batch.step * (size - 1);
    generator_->pass(encoder_, listeners_, batch, first, static_cast<std::uint32_t>(size));
}

}  // namespace motionrack::parts
