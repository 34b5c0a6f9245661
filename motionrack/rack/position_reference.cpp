// Counts pulses from the reference.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/position_reference.hpp>
#include <motionrack/rack/rack.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

/// A servo below this count rate is at standstill: position hold oscillates by a count.
constexpr double standing_servo_hz = 50;

}  // namespace

std::int64_t PositionReference::commanded(std::size_t axis) const {
    return rack_.axes()[axis].turned_by().count(rack_.kernel().now());
}

double PositionReference::reference_position(std::size_t axis) const {
    return axes_[axis].homed ? axes_[axis].position : rack_.axes()[axis].config.initial_position;
}

control::Point PositionReference::position() const {
    control::Point out = rack_.initial_position();
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const RackAxis& config = rack_.axes()[i].config;
        double& at = out[static_cast<std::size_t>(config.index())];
        at = reference_position(i);
        const std::int64_t since = commanded(i) - axes_[i].commanded;
        if (since == 0) continue;
        const double units = config.pulses_per_unit();
        at = (std::floor(at * units + 0.5) + static_cast<double>(since)) / units;
    }
    return out;
}

double PositionReference::commanded_origin(std::size_t axis) const {
    return reference_position(axis) -
           static_cast<double>(axes_[axis].commanded) / rack_.axes()[axis].config.pulses_per_unit();
}

double PositionReference::real_origin(std::size_t axis) const {
    const Reference& one = axes_[axis];
    return reference_position(axis) -
           static_cast<double>(one.commanded - one.lost_pulses) / rack_.axes()[axis].config.pulses_per_unit();
}

void PositionReference::set(std::size_t axis, double position, const ValidityWatch::Mark& from) {
    axes_[axis] = {true, position, commanded(axis), from.lost_pulses, from.at, {}, {}};
}

void PositionReference::lose(std::size_t axis, std::string why) {
    if (!axes_[axis].lost.empty()) return;
    axes_[axis].lost = std::move(why);
    axes_[axis].lost_at = rack_.kernel().now();
}

void PositionReference::begin(ValidityWatch& watch) const {
    for (std::size_t i = 0; i < axes_.size(); ++i)
        if (axes_[i].homed) watch.begin(i, {axes_[i].at, axes_[i].lost_pulses});
}

Result<void> PositionReference::check() const {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const RunningAxis& axis = rack_.axes()[i];
        if (!axes_[i].lost.empty())
            return fail(ErrorKind::refused,
                        fmt::format("The position of axis {} is not valid since {:.6f} s: {}. Nothing was moved; home "
                                    "it, or take another rack.",
                                    axis.config.letter, to_seconds(axes_[i].lost_at), axes_[i].lost));
        const double hz = std::fabs(axis.turned_by().rate(rack_.kernel().now()));
        if (hz > (axis.servo ? standing_servo_hz : 0))
            return fail(
                ErrorKind::refused,
                fmt::format("Axis {} moves at {:.3f} {}/s, and a program begins at standstill. Nothing more was "
                            "moved; stop the axis, or advance time until standstill.",
                            axis.config.letter, hz / axis.config.pulses_per_unit(), axis.config.unit()));
    }
    return {};
}

}  // namespace motionrack::rack
