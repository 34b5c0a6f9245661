// Values derived from a rack's numbers: pulses and counts per unit, the planner's limits, names of wire ends.
#include <algorithm>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/part_signals.hpp>

namespace motionrack::rack {

int RackAxis::index() const {
    const auto found = std::find(control::axis_letters.begin(), control::axis_letters.end(), letter);
    return static_cast<int>(found - control::axis_letters.begin());
}

namespace {

/// Converts `per_rev` of a motor revolution to a value per mm or degree. The order keeps rounding errors small.
double for_one_unit(std::int64_t per_rev, const RackAxis& axis) {
    const auto exact = static_cast<double>(per_rev);
    return axis.kind == AxisKind::linear ? exact / axis.lead_mm : exact * axis.gear_ratio / 360;
}

}  // namespace

double RackAxis::pulses_per_unit() const {
    return for_one_unit(pulses_per_rev(), *this);
}

double RackAxis::counts_per_unit() const {
    return for_one_unit(encoder_counts_per_rev, *this);
}

double RackAxis::following_alarm() const {
    constexpr double usual = 1, min_counts = 4;  // a coarse encoder deviates by a count in normal operation
    if (following_error_alarm) return *following_error_alarm;
    const double counts = counts_per_unit();
    const double of_servo = servo ? 0.1 * max_velocity : 0;  // a servo lags; its model is as good as the file
    return counts > 0 ? std::max({usual, min_counts / counts, of_servo}) : 0;
}

double RackAxis::following_warning() const {
    return following_error_warning.value_or(following_alarm() / 2);
}

RackAxis default_axis(char letter) {
    RackAxis axis;
    axis.letter = letter;
    axis.kind = axis.index() < 3 ? AxisKind::linear : AxisKind::rotary;
    if (axis.kind == AxisKind::rotary) axis.max_limit = 360;
    return axis;
}

const RackAxis* RackConfig::axis(char letter) const {
    const auto found = std::find_if(axes.begin(), axes.end(), [&](const RackAxis& a) { return a.letter == letter; });
    return found != axes.end() ? &*found : nullptr;
}

const RackCard* RackConfig::card(std::string_view card_name) const {
    const auto found = std::find_if(cards.begin(), cards.end(), [&](const RackCard& c) { return c.name == card_name; });
    return found != cards.end() ? &*found : nullptr;
}

const RackConveyor* RackConfig::track(std::string_view track_name) const {
    const auto found =
        std::find_if(tracks.begin(), tracks.end(), [&](const RackConveyor& t) { return t.name == track_name; });
    return found != tracks.end() ? &*found : nullptr;
}

bool RackConfig::positions_alone(const RackAxis& axis) const {
    const RackCard* its = card(axis.card);
    return its != nullptr && find_card_type(its->type)->position_loop;
}

bool RackConfig::point_to_point() const {
    return !axes.empty() &&
           std::all_of(axes.begin(), axes.end(), [this](const RackAxis& axis) { return positions_alone(axis); });
}

control::MachineLimits RackConfig::limits() const {
    control::MachineLimits out;
    for (const RackAxis& axis : axes) {
        control::AxisLimits& limits = out[static_cast<std::size_t>(axis.index())];
        limits.present = true;
        limits.min_position = axis.min_limit;
        limits.max_position = axis.max_limit;
        limits.max_velocity = axis.max_velocity;
        limits.max_accel = axis.max_accel;
        limits.max_jerk = axis.max_jerk;
        limits.max_velocity_step = axis.max_velocity_step;
        limits.pulses_per_unit = axis.pulses_per_unit();
    }
    return out;
}

std::string RackConfig::end_name(const WireEnd& end) const {
    const auto index = static_cast<std::size_t>(end.index);
    if (end.owner == EndOwner::card) return cards[index].name + '.' + end.pin;
    return signal_name(signals_of(end.owner).part_name(*this, index), end.pin);
}

}  // namespace motionrack::rack
