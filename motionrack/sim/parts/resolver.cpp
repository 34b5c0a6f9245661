// Output of the converter for windings with mismatch.
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/sim/parts/resolver.hpp>

namespace motionrack::parts {

namespace {

constexpr double billionths = 1e9;  // gain and offsets are stored in billionths
constexpr double max_fault_value = 0.3;

LineOutputSettings lines_of_converter(const ResolverSettings& s) {
    LineOutputSettings out;
    out.index_every = s.counts_per_turn;
    out.min_edge_interval = s.min_edge_interval;
    out.too_quick = TooQuick::comes_later;
    out.seed = s.seed;
    return out;
}

}  // namespace

Resolver::Resolver(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position,
                   const ResolverSettings& settings)
    : EncoderPart(kernel, name, position, settings.counts_per_turn, settings.position_per_turn,
                  lines_of_converter(settings)),
      los_(kernel.add_wire(name + ".los", 0)) {}

/// The converter shows the angle f for the rotor at t:  (1 + g) sin t + a  :  cos t + b  =  sin f : cos f. That is
/// A sin t - B cos t = C  with  A = (1 + g) cos f,  B = sin f,  C = b sin f - a cos f.
double Resolver::displacement(std::int64_t n) const {
    if (state_.own[gain] == 0 && state_.own[offset_sin] == 0 && state_.own[offset_cos] == 0) return 0;
    const double g = static_cast<double>(state_.own[gain]) / billionths;
    const double a = static_cast<double>(state_.own[offset_sin]) / billionths,
                 b = static_cast<double>(state_.own[offset_cos]) / billionths;
    const double counts = static_cast<double>(turn());
    const double f = 2 * pi * static_cast<double>(n) / counts;
    const SinCos shown = sin_cos(f);
    const double big_a = (1 + g) * shown.cos, big_b = shown.sin, c = b * shown.sin - a * shown.cos;
    const double t = atan2(big_b, big_a) + pi / 2 - acos(c / std::sqrt(big_a * big_a + big_b * big_b));
    double early = f - t;
    if (early > pi) early -= 2 * pi;
    if (early < -pi) early += 2 * pi;
    return early * counts / (2 * pi);
}

bool Resolver::fault(std::string_view fault_name, double value, Instant now) {
    const std::string_view name = bare(fault_name);
    if (name == "broken_sin" || name == "broken_cos") {
        const std::int64_t bit = name == "broken_sin" ? 1 : 2;
        state_.own[broken] = value != 0 ? state_.own[broken] | bit : state_.own[broken] & ~bit;
        kernel_.set_wire(los_, blind());
        look_again(now);
        return true;
    }
    const int which = name == "gain"         ? gain
                      : name == "offset_sin" ? offset_sin
                      : name == "offset_cos" ? offset_cos
                                             : -1;
    if (which < 0) return EncoderPart::fault(name, value, now);
    if (!(value >= -max_fault_value && value <= max_fault_value)) return false;
    state_.own[which] = static_cast<std::int64_t>(value * billionths);
    look_again(now);
    return true;
}

}  // namespace motionrack::parts
