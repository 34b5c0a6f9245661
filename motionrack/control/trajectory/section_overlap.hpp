// A corner where one stretch ends and the next begins: within a tolerance the next one may begin a little before the
// one before it has ended.
//
//   speed  ╲               ╱            each axis' speed, acceleration and jerk is the sum of both
//     in    ╲▁           ▁╱  out        ──►  ╲▁╱▔   the corner is cut by at most the tolerance
//             ▔▔─────────▔▔
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

/// How a stretch ends or begins: the part of its feed in which it only slows down, or only speeds up, on one line; a
/// piece of this line. Without feed where the curve is bent there.
struct SectionRamp {
    CubicSegment curve;
    std::span<const ProfileSegment> feed;
    double seconds() const;
};
/// All along it.
bool slows(const ProfileSegment& piece);
SectionRamp final_deceleration(std::span<const CubicSegment> curve, std::span<const ProfileSegment> feed);
SectionRamp initial_acceleration(std::span<const CubicSegment> curve, std::span<const ProfileSegment> feed);

/// An end that stays when its stretch is gone.
class StoredRamp {
  public:
    void keep(const SectionRamp& end);
    SectionRamp end() const { return {curve_, feed_}; }

  private:
    CubicSegment curve_;
    std::vector<ProfileSegment> feed_;
};

/// Seconds by which the next one may begin earlier, 0 .. `max_seconds`; 0: none, as on curved ends, or where an axis
/// of both would get too much. `corner_tolerance_mm`: how far the path may be from the corner's sides.
double max_overlap_s(const SectionRamp& in, const SectionRamp& out, double max_seconds, double corner_tolerance_mm,
                     const MachineLimits& limits);

}  // namespace motionrack::control
