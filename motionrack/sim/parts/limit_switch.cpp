// Thresholds and bounce of a switch.
#include <motionrack/base/hash_bits.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/limit_switch.hpp>

namespace motionrack::parts {

namespace {

/// Mixes the bits of a counter into a pseudo-random number.
std::uint64_t mixed(std::uint64_t x) {
    return mixed_bits(x + golden_step);
}

}  // namespace

LimitSwitch::LimitSwitch(const LimitSwitchSettings& settings, const Transmission& axle, LimitSwitchState& state)
    : settings_(settings), state_(state) {
    MOTIONRACK_ASSERT(settings.hysteresis >= 0 && settings.bounce >= Duration{0} &&
                      settings.bounce <= whole_seconds(1));
    if (!present()) return;
    const double place = *settings.position;
    if (settings.side == SwitchSide::at_and_above) {
        on_ = axle.first_at_or_above(place);
        off_ = std::min(on_ - 1, axle.last_at_or_below(place - settings.hysteresis));
    } else {
        on_ = axle.last_at_or_below(place);
        off_ = std::max(on_ + 1, axle.first_at_or_above(place + settings.hysteresis));
    }
    state_.active = acts(axle.table(0));
}

bool LimitSwitch::acts(std::int64_t table) const {
    const std::int64_t threshold = state_.active ? off_ : on_;
    if (settings_.side == SwitchSide::at_and_above) return state_.active ? table > threshold : table >= threshold;
    return state_.active ? table < threshold : table <= threshold;
}

Range LimitSwitch::range() const {
    Range out;
    if (!present()) return out;
    // Active above: left downwards at `off`; inactive: left upwards at `on`. The other orientation is the mirror image.
    const bool leaves_below = (settings_.side == SwitchSide::at_and_above) == active();
    (leaves_below ? out.below : out.above) = active() ? off_ : on_;
    return out;
}

void LimitSwitch::move(std::int64_t table, Instant now) {
    if (!present() || acts(table) == active()) return;
    state_.active = !state_.active;
    ++state_.changes;
    state_.bounce_from = now;
    state_.bounced = 0;
    state_.bounces = 0;
    state_.next = never;
    if (settings_.bounce == Duration{0}) return;
    state_.bounces = 2 + 2 * static_cast<std::int32_t>(mixed(static_cast<std::uint64_t>(state_.changes) << 8) % 3);
    state_.next = bounce_edge(0);
}

// Edge i lies in the i-th of `bounces` equal parts of the bounce time, after a quarter of the part.
Instant LimitSwitch::bounce_edge(int i) const {
    const std::uint64_t bits =
        mixed((static_cast<std::uint64_t>(state_.changes) << 8) + 1 + static_cast<std::uint64_t>(i));
    const std::int64_t fraction = 16'384 + static_cast<std::int64_t>(bits % 49'152);
    const std::int64_t parts = std::int64_t{65'536} * state_.bounces;
    return state_.bounce_from + Duration{settings_.bounce.count() * (std::int64_t{65'536} * i + fraction) / parts};
}

void LimitSwitch::act(Instant now) {
    while (state_.next <= now) {
        ++state_.bounced;
        state_.next = state_.bounced < state_.bounces ? bounce_edge(state_.bounced) : never;
    }
}

int LimitSwitch::level() const {
    // The first edge goes to the new level, each later one toggles; an even number of them ends at the new level.
    bool contact = active() != ((state_.bounced & 1) != 0);
    if (state_.fault != SwitchFault::none) contact = state_.fault == SwitchFault::stuck_closed;
    return contact ? settings_.active_level : 1 - settings_.active_level;
}

}  // namespace motionrack::parts
