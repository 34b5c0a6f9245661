// Edges of the light.
#include <fmt/format.h>

#include <motionrack/sim/parts/laser_gate.hpp>

namespace motionrack::parts {

Result<LaserGate> LaserGate::make(const LaserSettings& s) {
    const auto within = [](double v, double greatest) { return v >= 0 && v <= greatest; };
    if (!within(s.power_w, 1e5) || !within(s.on_delay_us, 1e5) || !within(s.off_delay_us, 1e5))
        return fail(Trouble::refused,
                    fmt::format("a laser of {} W with delays of {} and {} us: 0 to 100000 each are possible", s.power_w,
                                s.on_delay_us, s.off_delay_us));
    LaserGate out;
    out.settings_ = s;
    return out;
}

void LaserGate::change(std::int64_t half_us, bool on) {
    const double at = static_cast<double>(half_us) / 20 + (on ? settings_.on_delay_us : settings_.off_delay_us) / 10;
    // A pulse shorter than the difference of the delays never shines, a gap shorter than it is none.
    while (edges_.size() > next_ && edges_.back().at >= at) edges_.pop_back();
    edges_.push_back({at, on});
}

void LaserGate::forget() {
    edges_.erase(edges_.begin(), edges_.begin() + static_cast<std::ptrdiff_t>(next_));
    next_ = 0;
}

}  // namespace motionrack::parts
