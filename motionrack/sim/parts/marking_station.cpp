// Marks on a part from the output of a card.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/sim/parts/marking_station.hpp>

namespace motionrack::parts {

namespace {

constexpr double station_tick_s = 1e-5;

}  // namespace

Result<MarkingStation> MarkingStation::make(const StationSettings& settings, const Conveyor* track) {
    MOTIONRACK_CHECK(check(settings.galvo));
    if (settings.lens) MOTIONRACK_CHECK(sim::check(*settings.lens));
    if (!(settings.bits_per_mm >= 1 && settings.bits_per_mm <= 1e6))
        return fail(ErrorKind::refused,
                    fmt::format("the field has {} bits/mm; it must be 1 to 1000000", settings.bits_per_mm));
    if (!(settings.workpiece.tolerance_mm >= 0 && settings.workpiece.tolerance_mm <= 10))
        return fail(ErrorKind::refused,
                    fmt::format("the tolerance is {} mm; it must be 0 to 10", settings.workpiece.tolerance_mm));
    MOTIONRACK_TRY(Conveyor own, Conveyor::make(settings.track));
    MOTIONRACK_TRY(LaserGate gate, LaserGate::make(settings.laser));
    return MarkingStation(settings, std::move(own), track, gate);
}

std::array<MarkingStation::NamedState, MarkingStation::state_count> MarkingStation::states() {
    return {{{"mirrors", galvo_.state()},
             {"laser", gate_.state()},
             {"marks", workpiece_.state()},
             {"spot", std::as_writable_bytes(std::span(&last_, 1))}}};
}

sim::Spot MarkingStation::spot(sim::Spot bits) const {
    if (settings_.lens) return sim::spot_of(*settings_.lens, bits);
    return {bits.x / settings_.bits_per_mm, bits.y / settings_.bits_per_mm};
}

void MarkingStation::block(std::int64_t first_tick, std::span<const std::int32_t> x, std::span<const std::int32_t> y) {
    for (std::size_t at = 0; at < x.size(); at += chunk) {
        const std::size_t n = std::min(chunk, x.size() - at);
        galvo_.run(x.subspan(at, n), y.subspan(at, n), {x_.data(), n}, {y_.data(), n});
        sim::Spot from_mm;
        std::int64_t known = -1;  // the tick whose end is from_mm
        for (std::size_t i = 0; i < n; ++i) {
            const std::int64_t tick = first_tick + static_cast<std::int64_t>(at + i);
            const sim::Spot bits{x_[i], y_[i]};
            if (!gate_.dark(tick)) {
                if (known != tick - 1 || i == 0) from_mm = spot(last_);
                const sim::Spot to_mm = spot(bits);
                mark(tick, from_mm, to_mm);
                from_mm = to_mm;
                known = tick;
            }
            last_ = bits;
        }
    }
}

/// Marks a tick with laser light, for all or part of it; straight in the field, while the part moves.
void MarkingStation::mark(std::int64_t tick, sim::Spot from, sim::Spot to) {
    const double begin_s = static_cast<double>(tick) * station_tick_s;
    gate_.shine(tick, [&](LaserGate::Light light) {
        const auto at = [&](double part) {
            const sim::Spot field{from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
            return track().on_part(field, begin_s + part * station_tick_s);
        };
        // The end of a tick must equal the start of the next one to the bit, or a stroke would break: both are computed
        // from the next tick's start.
        const sim::Spot first = at(light.from);
        const sim::Spot last =
            light.to == 1 ? track().on_part(to, static_cast<double>(tick + 1) * station_tick_s) : at(light.to);
        workpiece_.add(first, last, gate_.power_w() * (light.to - light.from) * station_tick_s,
                       begin_s + light.from * station_tick_s);
    });
}

}  // namespace motionrack::parts
