// Detects and reports breaches.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/move.hpp>
#include <motionrack/rack/breaches.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

// A window is long enough for some pulses at the velocity step limit, and for the whole pulses to hide as little of a
// step as the acceleration does.
constexpr double min_window = 1e-3, pulses_of_start = 2;
constexpr Duration max_period = milliseconds(2);
// Common error of the counts at three instants, in pulses: counts and segment ends are whole.
constexpr double count_rounding = 3;
// Factor on the velocity step limit for whole velocity units and whole pulses, and for arcs drawn as chords.
constexpr double start_reserve = 1.6;
// Along a curve of chords, the trapezoidal profile uses the acceleration limit of an axis twice: along and across.
constexpr double accel_of_curves = 2;

std::string position_text(const Breach& breach) {
    return fmt::format("{}at {:.6f} s and X {:.3f}, Y {:.3f}, Z {:.3f}",
                       breach.line > 0 ? fmt::format("in line {}, ", breach.line) : "", to_seconds(breach.at),
                       breach.position[0], breach.position[1], breach.position[2]);
}

std::string often(const Breach& breach) {
    return breach.times > 1 ? fmt::format("; the worst of {}", breach.times) : "";
}

}  // namespace

void Breaches::add(const Breach& breach) {
    const auto same = std::find_if(all_.begin(), all_.end(), [&](const Breach& one) {
        return one.kind == breach.kind && one.axis == breach.axis;
    });
    if (same == all_.end()) {
        all_.push_back(breach);
        return;
    }
    const std::int64_t times = same->times + breach.times;
    if (breach.value > same->value) *same = breach;
    same->times = times;
}

std::string_view name_of(BreachKind kind) {
    static constexpr std::array<std::string_view, 4> names = {"jump", "accel", "deviation", "late"};
    return names[static_cast<std::size_t>(kind)];
}

std::string sentence_of(const Breach& breach) {
    const char axis = breach.axis >= 0 ? control::axis_letters[static_cast<std::size_t>(breach.axis)] : '-';
    const char* unit = breach.axis < 3 ? "mm" : "deg";
    switch (breach.kind) {
        case BreachKind::jump:
            return fmt::format(
                "{} the velocity step of {} was {:.1f} {}/s, above its maximum of {:g} {}/s (max_velocity_step){}",
                position_text(breach), axis, breach.value, unit, breach.limit, unit, often(breach));
        case BreachKind::accel:
            return fmt::format("{} the acceleration of {} was {:.1f} {}/s2, above its limit of {:g} {}/s2{}",
                               position_text(breach), axis, breach.value, unit, breach.limit, unit, often(breach));
        case BreachKind::deviation:
            return fmt::format(
                "{} the machine was {:.4f} mm from the programmed path, above the tolerance of {:.4f} "
                "mm{}",
                position_text(breach), breach.value, breach.limit, often(breach));
        case BreachKind::late:
            break;
    }
    return fmt::format(
        "{} a segment of the path came {:.0f} us too late, and the axes stopped at its start{}; lower the "
        "feed, program longer moves or a wider tolerance (G64 P), or make the host faster (host_latency_us, "
        "bus_access_ns)",
        position_text(breach), breach.value * 1e6, often(breach));
}

JumpLaw::JumpLaw(double start_hz, double accel_hz, Duration period) {
    if (period <= Duration{} || period > max_period || start_hz <= 0) return;
    end_hz = start_reserve * start_hz + accel_hz * to_seconds(period);
    const double balanced = accel_hz > 0 ? std::sqrt(1.5 * count_rounding / accel_hz) : 0;
    const double window =
        std::clamp(std::max(pulses_of_start / start_hz, balanced), min_window, to_seconds(max_window));
    samples = static_cast<std::size_t>(std::max(1.0, std::ceil(window / to_seconds(period))));
    seconds = static_cast<double>(samples) * to_seconds(period);
    period_ = to_seconds(period);
    accel_hz_ = accel_hz;
    explained_ = accel_hz * seconds * seconds;
    allowed_ = start_reserve * start_hz * seconds + explained_ + count_rounding;
}

double JumpLaw::jump_hz(std::int64_t first, std::int64_t middle, std::int64_t last) const {
    const auto change = std::fabs(static_cast<double>(last - 2 * middle + first));
    return change > allowed_ ? (change - count_rounding - explained_) / seconds : 0;
}

double JumpLaw::max_hz(std::span<const std::int64_t> counts) const {
    double out = std::numeric_limits<double>::infinity();
    const std::size_t last = counts.size() - 1;
    for (std::size_t k = 1; k <= samples; ++k) {
        const double time = static_cast<double>(k) * period_;
        const double pulses = std::fabs(static_cast<double>(counts[last] - counts[last - k])) + 1;
        out = std::min(out, pulses / time + accel_of_curves * accel_hz_ * time / 2);
    }
    return out;
}

JumpWatch::JumpWatch(double start_hz, double accel_hz, Duration period)
    : law_(start_hz, accel_hz, period), period_(period), counts_(law_.samples > 0 ? 2 * law_.samples + 1 : 0) {}

JumpWatch::Jump JumpWatch::sample(std::int64_t count) {
    if (counts_.empty()) return {};
    const std::size_t size = counts_.size();
    counts_[seen_ % size] = count;
    ++seen_;
    if (seen_ < size) return {};
    const double hz = law_.jump_hz(counts_[seen_ % size], counts_[(seen_ - 1 - law_.samples) % size], count);
    const bool jumped = std::exchange(jumps_, hz > 0);
    return {hz, jumps_ && !jumped};
}

}  // namespace motionrack::rack
