// Geometry of the disc.
#include <motionrack/base/result.hpp>
#include <motionrack/base/trig.hpp>
#include <motionrack/sim/parts/line_encoder.hpp>

namespace motionrack::parts {

namespace {

constexpr double million = 1e6;  // the eccentricity is stored in millionths of a count

LineOutputSettings lines_of_disc(const LineEncoderSettings& s) {
    LineOutputSettings out;
    out.index_every = s.index ? s.counts_per_turn : 0;
    out.dirt_at = s.dirt_at;
    out.min_edge_interval = s.min_edge_interval;
    out.too_quick = s.too_quick;
    out.seed = s.seed;
    return out;
}

}  // namespace

LineEncoder::LineEncoder(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position,
                         const LineEncoderSettings& settings)
    : EncoderPart(kernel, name, position, settings.counts_per_turn, settings.position_per_turn,
                  lines_of_disc(settings)) {
    MOTIONRACK_ASSERT(settings.eccentricity >= 0 &&
                      settings.eccentricity <= static_cast<double>(settings.counts_per_turn) / 7);
    state_.own[0] = static_cast<std::int64_t>(settings.eccentricity * million);
}

double LineEncoder::displacement(std::int64_t n) const {
    if (state_.own[0] == 0) return 0;
    return static_cast<double>(state_.own[0]) / million *
           sin_cos(2 * pi * static_cast<double>(n) / static_cast<double>(turn())).sin;
}

bool LineEncoder::fault(std::string_view name, double value, Instant now) {
    if (bare(name) != "eccentricity") return EncoderPart::fault(name, value, now);
    if (!(value >= 0 && value <= static_cast<double>(turn()) / 7)) return false;
    state_.own[0] = static_cast<std::int64_t>(value * million);
    look_again(now);
    return true;
}

}  // namespace motionrack::parts
