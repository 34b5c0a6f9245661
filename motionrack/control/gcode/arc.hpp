// Geometry of an arc in its plane: centre from the radius, and how far the arc bulges. No angles, no trigonometry.
#pragma once

#include <array>

namespace motionrack::control::gcode {

struct PlanePoint {
    double first = 0;
    double second = 0;
};

/// Distance from the origin.
double length(PlanePoint v);

/// An R arc may miss its end by this much (half the chord longer than R) and is then a half circle; mm.
inline constexpr double radius_slack_mm = 0.005;

/// Centre of the arc from `start` to `end` with |radius|; the arc of at most half a turn for radius > 0, the other for
/// radius < 0. False: the ends are further apart than twice the radius. The ends must differ.
bool centre_from_radius(PlanePoint start, PlanePoint end, double radius, bool counter_clockwise, PlanePoint& centre);

/// Which of the four extreme points (+first, +second, -first, -second) an arc of less than a full turn passes; `from`
/// and `to` are relative to the centre and in different directions. Decided by cross products, exact for points on the
/// axes.
std::array<bool, 4> extremes_passed(PlanePoint from, PlanePoint to, bool counter_clockwise);

}  // namespace motionrack::control::gcode
