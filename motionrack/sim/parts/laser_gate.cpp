// Edges of the light.
#include <fmt/format.h>

#include <motionrack/sim/parts/laser_gate.hpp>

namespace motionrack::parts {

Result<LaserGate> LaserGate::make(const LaserSettings& s) {
    const auto within = [](double v, double max) { return v >= 0 && v <= max; };
    if (!within(s.power_w, 1e5) || !within(s.on_delay_us, 1e5) || !within(s.off_delay_us, 1e5))
        return fail(ErrorKind::refused,
                    fmt::format("the laser has {} W and delays of {} and {} us; each must be 0 to 100000", s.power_w,
                                s.on_delay_us, s.off_delay_us));
    LaserGate out;
    out.settings_ = s;
    return out;
}

void LaserGate::change(std::int64_t half_us, bool on) {
    const double at = static_cast<double>(half_us) / 20 + (on ? settings_.on_delay_us : settings_.off_delay_us) / 10;
    State& s = state_;
    const auto last = [&]() -> LightEdge& {
        return s.edges[static_cast<std::size_t>((s.head + s.count - 1) % max_waiting)];
    };
    // A pulse shorter than the difference of the delays gives no light; a shorter gap disappears.
    while (s.count > 0 && last().at >= at) --s.count;
    if (s.count == max_waiting) take_first();
    ++s.count;
    last() = {at, on};
}

}  // namespace motionrack::parts
