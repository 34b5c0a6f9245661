// Counts, rates and watches of rotor and encoder.
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/mechanics_faces.hpp>

namespace motionrack::parts {

std::int64_t MechanicsFaces::count_at(MechanicsAdapter face, Instant t) const {
    if (face == rotor_face) return input_.rotor_at(t);
    return encoder_.present() ? encoder_.count(input_.rotor_at(t)) : 0;
}

double MechanicsFaces::rate_at(MechanicsAdapter face, Instant t) const {
    const double rotor = input_.rotor_rate_at(t);
    if (face == rotor_face) return rotor;
    return encoder_.present() ? encoder_.rate(rotor) : 0;
}

void MechanicsFaces::watch(MechanicsAdapter face, int slot, Range counts, Instant now) {
    MOTIONRACK_ASSERT(slot >= 0 && slot < listeners_[face].size());
    Watch& w = watches_[face][static_cast<std::size_t>(slot)];
    w.counts = counts;
    if (face == rotor_face)
        w.rotor = counts;
    else
        w.rotor = encoder_.present() ? encoder_.rotor_range(counts, input_.rotor_at(now)) : Range{};
}

void MechanicsFaces::notify_rate(double before, double rate, Instant now) const {
    listeners_[rotor_face].notify_rate(before, rate, now);
    if (listeners_[encoder_face].size() == 0) return;
    const auto counts = [this](double rotor) { return encoder_.present() ? encoder_.rate(rotor) : 0; };
    listeners_[encoder_face].notify_rate(counts(before), counts(rate), now);
}

void MechanicsFaces::check(std::int64_t rotor, Instant now) {
    for (int face = 0; face < face_count; ++face) {
        for (int i = 0; i < listeners_[face].size(); ++i) {
            Watch& w = watches_[face][i];
            if (!w.rotor.left(rotor)) continue;
            const std::int64_t count = face == rotor_face ? rotor : encoder_.count(rotor);
            if (w.counts.left(count)) {
                w = {};
                listeners_[face][i].crossed(now);
            } else {
                w.rotor = encoder_.rotor_range(w.counts, rotor);
            }
        }
    }
}

void MechanicsFaces::renew_encoder_ranges(std::int64_t rotor) {
    for (int i = 0; i < listeners_[encoder_face].size(); ++i) {
        Watch& w = watches_[encoder_face][i];
        w.rotor = encoder_.rotor_range(w.counts, rotor);
    }
}

}  // namespace motionrack::parts
