// Overlap of two path sections at a corner: within a tolerance the next section may start before the previous one ends.
//
//   velocity  ╲               ╱         velocity, acceleration and jerk of each axis are the sums of both sections
//      in      ╲▁           ▁╱  out     ──►  ╲▁╱▔   the corner is cut by at most the tolerance
//                ▔▔─────────▔▔
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

/// Straight end or beginning of a section with monotonic velocity, as one segment: final deceleration or initial
/// acceleration. `feed` is empty if the curve is not straight there.
struct SectionRamp {
    CubicSegment curve;
    std::span<const ProfileSegment> feed;
    double seconds() const;
};
/// Returns true if the velocity decreases along the whole segment.
bool slows(const ProfileSegment& piece);
SectionRamp final_deceleration(std::span<const CubicSegment> curve, std::span<const ProfileSegment> feed);
SectionRamp initial_acceleration(std::span<const CubicSegment> curve, std::span<const ProfileSegment> feed);

/// Copy of a ramp that outlives its section.
class StoredRamp {
  public:
    void keep(const SectionRamp& end);
    SectionRamp end() const { return {curve_, feed_}; }

  private:
    CubicSegment curve_;
    std::vector<ProfileSegment> feed_;
};

/// Returns the time by which the next section may start earlier, 0 .. `max_seconds`. Returns 0 if no overlap is
/// possible: on curved ends, or where the sum would exceed an axis limit. `corner_tolerance_mm`: largest distance of
/// the path from the sides of the corner.
double max_overlap_s(const SectionRamp& in, const SectionRamp& out, double max_seconds, double corner_tolerance_mm,
                     const MachineLimits& limits);

}  // namespace motionrack::control
