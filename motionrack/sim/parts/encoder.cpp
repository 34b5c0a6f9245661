// Closed forms of the encoder.
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/encoder.hpp>
#include <numeric>

namespace motionrack::parts {

namespace {

// Counts modulo 4 by the lines 2*B + A, and back.
constexpr QuadratureLevels lines_of_phase[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
constexpr int phase_of_lines[4] = {0, 1, 3, 2};

int phase_of(std::int64_t disc) {
    return static_cast<int>(disc & 3);
}

/// Phase of the lines with the fault, for the disc in `phase`.
int faulty_phase(LineFault fault, int phase) {
    QuadratureLevels l = lines_of_phase[phase];
    if (fault == LineFault::broken_a) l.a = 0;
    if (fault == LineFault::broken_b) l.b = 0;
    if (fault == LineFault::swapped) l = {l.b, l.a};
    return phase_of_lines[2 * l.b + l.a];
}

}  // namespace

Encoder::Encoder(const EncoderSettings& settings, std::int64_t pulses_per_rev, EncoderState& state)
    : settings_(settings), state_(state) {
    MOTIONRACK_ASSERT(settings.counts_per_rev >= 0 && pulses_per_rev > 0);
    if (!present()) return;
    const std::int64_t common = std::gcd(settings.counts_per_rev, pulses_per_rev);
    num_ = settings.counts_per_rev / common;
    den_ = pulses_per_rev / common;
}

std::int64_t Encoder::seen(std::int64_t disc) const {
    switch (state_.fault) {
        case LineFault::none:
            return disc + state_.shift;
        case LineFault::swapped:
            return state_.shift - disc;
        case LineFault::broken_a:
            return state_.shift - (phase_of(disc) >= 2);  // 00 and 01 only
        case LineFault::broken_b:
            return state_.shift + (phase_of(disc) == 1 || phase_of(disc) == 2);  // 00 and 10 only
    }
    return 0;
}

double Encoder::rate(double rotor_rate) const {
    if (state_.fault == LineFault::broken_a || state_.fault == LineFault::broken_b) return 0;
    const double counts = rotor_rate * static_cast<double>(num_) / static_cast<double>(den_);
    return state_.fault == LineFault::swapped ? -counts : counts;
}

QuadratureLevels Encoder::lines(std::int64_t rotor) const {
    return lines_of_phase[faulty_phase(state_.fault, phase_of(disc(rotor)))];
}

void Encoder::set_fault(LineFault fault, std::int64_t rotor) {
    if (fault == state_.fault) return;
    const std::int64_t at = disc(rotor);
    const std::int64_t count = seen(at);
    // The decoder receives a change of the lines from one phase to another: at most one count, or two (taken as up) if
    // both lines change.
    const int change = (faulty_phase(fault, phase_of(at)) - faulty_phase(state_.fault, phase_of(at))) & 3;
    const std::int64_t after = count + (change == 3 ? -1 : change);
    state_.fault = fault;
    state_.shift = 0;
    state_.shift = after - seen(at);
}

Range Encoder::disc_to_rotor(const Range& disc) const {
    Range out;
    // disc <= b  <=>  rotor * num < (b + 1) * den;   disc >= a  <=>  rotor * num >= a * den
    if (disc.below != sim::unwatched_below) out.below = ceil_div((Wide{disc.below} + 1) * den_, num_) - 1;
    if (disc.above != sim::unwatched_above) out.above = ceil_div(Wide{disc.above} * den_, num_);
    return out;
}

Range Encoder::rotor_range(const Range& counts, std::int64_t rotor) const {
    const std::int64_t at = disc(rotor);
    if (state_.fault == LineFault::none) return disc_to_rotor(counts.moved(-state_.shift));
    Range out;
    if (state_.fault == LineFault::swapped) {
        if (counts.above != sim::unwatched_above) out.below = state_.shift - counts.above;
        if (counts.below != sim::unwatched_below) out.above = state_.shift - counts.below;
        return disc_to_rotor(out);
    }
    if (counts.left(seen(at))) return {rotor, rotor};
    for (int i = 3; i >= 1; --i) {  // the count repeats every four
        if (counts.left(seen(at - i))) out.below = at - i;
        if (counts.left(seen(at + i))) out.above = at + i;
    }
    return disc_to_rotor(out);
}

Range Encoder::index_range(std::int64_t rotor) const {
    const std::int64_t at = disc(rotor);
    const std::int64_t beyond = floor_mod(at, settings_.counts_per_rev);
    if (beyond == 0) return disc_to_rotor({at - 1, at + 1});
    return disc_to_rotor({at - beyond, at - beyond + settings_.counts_per_rev});
}

}  // namespace motionrack::parts
