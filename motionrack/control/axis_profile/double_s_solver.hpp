// Solves for the double-S profile that is time-optimal between two states, in units where the maximum jerk and the
// maximum acceleration are 1.
//
// The fastest velocity change raises the acceleration and lowers it again (or the reverse); its end position is free.
// Mirrored if necessary, it rises first:
//
//   acceleration    direct            double S (s > 0)            double S with s < 0
//        ___                          ___                          ___
//       /   \                        /   \                        /   \      _ end
//      /     \ end                  /     \          _ end       /     \____/
//   __/_______\___________       __/_______\________/_____     _/___________|___ -s
//   start                                   \______/ -s        start
//
// A distance beyond that of the direct change needs a double S: jerk +1, -1, +1, with holds at the accelerations 1 and
// -1. A shorter distance needs a double S in reversed time. Extend the first and the last phase to zero acceleration.
// The velocities there are the feet (zero_accel_velocity); the distance between these two points is the reach. With the
// peak P and the valley -s every double S has
//     P^2 - s^2 = end_foot - start_foot = rise
// (with a hold of h seconds 1 + h instead of P^2, or of s^2), so that s alone distinguishes them; s starts at minus the
// final acceleration. Where the acceleration passes through 0, at s > 0, the velocity has its peak end_foot + s^2. A
// double S that would exceed the maximum velocity cruises there instead.
#pragma once

#include <algorithm>
#include <cmath>

namespace motionrack::control {

/// Velocity and acceleration at both ends, and the distance.
struct BoundaryConditions {
    double start_velocity, start_accel;
    double end_velocity, end_accel;
    double distance;
    double change;  ///< velocity difference: more exact than the difference of nearly equal velocities

    BoundaryConditions mirrored() const {
        return {-start_velocity, -start_accel, -end_velocity, -end_accel, -distance, -change};
    }
    BoundaryConditions backwards() const {
        return {-end_velocity, end_accel, -start_velocity, start_accel, -distance, change};
    }
};

/// Durations of the phases with jerk +1, 0, -1, 0, -1, 0, +1. Without cruise the first -1 covers both.
struct DoubleSPhases {
    double rise, hold, fall, cruise, sink, low, back;
};

/// The fastest velocity change: jerk +1, 0, -1, or mirrored -1, 0, +1.
struct DirectVelocityChange {
    bool mirrored;
    double rise, hold, fall;
};
/// Returns the fastest velocity change between the ends of `course`; its distance is ignored.
DirectVelocityChange direct_velocity_change(const BoundaryConditions& course);

/// A solution as phases of boundary conditions that are mirrored if so flagged, then reversed in time.
struct TimeOptimalSolution {
    bool mirrored;
    bool backwards;
    DoubleSPhases phases;
};

/// Solves for the fastest profile. Requires |accelerations| <= 1 and velocities that stay within the maximum `top`.
/// `slack`: share of the distance that is due to rounding.
TimeOptimalSolution solve_time_optimal(const BoundaryConditions& course, double top, double slack);

/// Solver for conditions whose direct change rises first and does not reach the distance.
class DoubleSSolver {
  public:
    DoubleSSolver(const BoundaryConditions& course, double top);

    /// Finds the fastest solution of the branch that starts at the direct change. Returns false if the distance is
    /// shorter than that branch; then solve the time-reversed conditions beyond the gap. `slack`, and the rounding
    /// error of `sensitive`, are tolerated at the gap.
    bool find(double slack, double sensitive);
    /// Finds the fastest solution beyond the gap.
    void find_beyond_gap();
    DoubleSPhases phases() const;

  private:
    /// Returns P^2 for this s, or 1 plus the hold at the peak.
    double high_at(double s) const { return std::max(floor_, rise_ + s * s); }
    double reach_at(double s) const;
    double flow_at(double s) const;
    double first_crest() const;
    void find_above(double min_s);
    void find_between(double min_s, double max_s);
    double with_hold(double min_s, double max_s) const;
    double with_both_holds() const;
    double without_hold(double min_s, double max_s) const;

    double start_accel_, end_accel_;
    double start_foot_, end_foot_;
    double rise_;   ///< end_foot_ - start_foot_, >= 0
    double both_;   ///< start_foot_ + end_foot_
    double reach_;  ///< required distance between the feet
    double top_;
    double min_s_;          ///< lower bound of s: that of the direct change
    bool swapped_ = false;  ///< peak and valley, and the feet, are swapped so that the feet rise
    double floor_ = 0;      ///< minimum of P^2, because the acceleration starts there
    double gap_ = 0;        ///< no solution has |s| below it: its first phase would have a negative duration
    double s_ = 0;          ///< s of the solution
    double cruise_ = 0;
};

}  // namespace motionrack::control
