// Geometry of an arc in its plane: the centre from the radius, and its extreme points. No angles, no trigonometry.
#pragma once

#include <array>

namespace motionrack::control::gcode {

struct PlanePoint {
    double first = 0;
    double second = 0;
};

/// Returns the distance from the origin.
double length(PlanePoint v);

/// If half the chord of an R arc exceeds R by at most this much, it is a half circle; mm.
inline constexpr double radius_slack_mm = 0.005;

/// Computes the centre of the arc from `start` to `end` with |radius|. The arc has at most half a turn for radius > 0;
/// it is the larger one for radius < 0. Returns false if the ends are further apart than twice the radius. The ends
/// must differ.
bool centre_from_radius(PlanePoint start, PlanePoint end, double radius, bool counter_clockwise, PlanePoint& centre);

/// Returns which of the four extreme points (+first, +second, -first, -second) lie on an arc of less than a full turn.
/// `from` and `to` are relative to the centre and in different directions. Uses cross products, which are exact for
/// points on the axes.
std::array<bool, 4> extremes_passed(PlanePoint from, PlanePoint to, bool counter_clockwise);

}  // namespace motionrack::control::gcode
