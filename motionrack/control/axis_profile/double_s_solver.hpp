// The family of motions among which the quickest one between two states is found, in units where the greatest jerk
// and the greatest acceleration are 1.
//
// The quickest change of speed, wherever it ends, raises the acceleration and lets it fall again (or the other way
// round). Mirrored if need be, it rises first:
//
//   acceleration    direct            a swing (s > 0)             a swing with s < 0
//        ___                          ___                          ___
//       /   \                        /   \                        /   \      _ end
//      /     \ end                  /     \          _ end       /     \____/
//   __/_______\___________       __/_______\________/_____     _/___________|___ -s
//   start                                   \______/ -s        start
//
// What gets farther than the direct change is a swing: jerk +1, -1, +1, the acceleration held where it is 1 or -1. What
// gets less far is, told backwards in time, a swing, too.
// Draw the first and the last phase on to where the acceleration is 0. The speeds there are the feet, and the way
// between these two places is the reach. With the peak P and the valley -s all swings have
//     P^2 - s^2 = end_foot - start_foot = rise
// (with a hold of h seconds 1 + h instead of P^2, or of s^2), so that s alone tells them apart; s begins at minus the
// last acceleration. Where the acceleration passes through 0, at s > 0, the speed has its peak end_foot + s^2, and a
// swing that would get faster than the greatest speed cruises there instead.
#pragma once

#include <algorithm>
#include <cmath>

namespace motionrack::control {

/// Speed and acceleration at both ends and the way between them.
struct BoundaryConditions {
    double start_speed, start_accel;
    double end_speed, end_accel;
    double distance;
    double change;  ///< of the speed: where two speeds are nearly equal, more exact than their difference here

    BoundaryConditions mirrored() const {
        return {-start_speed, -start_accel, -end_speed, -end_accel, -distance, -change};
    }
    BoundaryConditions backwards() const {
        return {-end_speed, end_accel, -start_speed, start_accel, -distance, change};
    }
};

/// Durations of the phases with jerk +1, 0, -1, 0, -1, 0, +1. Where there is no cruise, the first -1 lasts as both.
struct DoubleSPhases {
    double rise, hold, fall, cruise, sink, low, back;
};

/// The quickest change of speed: jerk +1, 0, -1, or mirrored -1, 0, +1.
struct DirectVelocityChange {
    bool mirrored;
    double rise, hold, fall;
};
/// The way of the course does not matter.
DirectVelocityChange direct_velocity_change(const BoundaryConditions& course);

/// A motion as a swing of a course that may be mirrored, then told backwards.
struct TimeOptimalSolution {
    bool mirrored;
    bool backwards;
    DoubleSPhases phases;
};

/// |accelerations| <= 1, speeds within `top` for good; `slack` is how much of the way is nothing but roundings.
TimeOptimalSolution solve_time_optimal(const BoundaryConditions& course, double top, double slack);

/// DoubleSSolver of a course whose direct change rises first and falls short of the way.
class DoubleSSolver {
  public:
    DoubleSSolver(const BoundaryConditions& course, double top);

    /// Finds the quickest among those that the direct change leads to. False: the way is less than they come to, and
    /// that of the course told backwards is to be taken beyond its gap. `slack` and what roundings make of `sensitive`
    /// are forgiven at the gap.
    bool find(double slack, double sensitive);
    /// Finds the quickest of those beyond the gap.
    void find_beyond_gap();
    DoubleSPhases phases() const;

  private:
    /// P^2, or 1 and the hold.
    double high_at(double s) const { return std::max(floor_, rise_ + s * s); }
    double reach_at(double s) const;
    double flow_at(double s) const;
    double first_crest() const;
    void find_above(double least);
    void find_between(double least, double most);
    double with_hold(double least, double most) const;
    double with_both_holds() const;
    double without_hold(double least, double most) const;

    double start_accel_, end_accel_;
    double start_foot_, end_foot_;
    double rise_;   ///< from foot to foot, >= 0
    double both_;   ///< sum of the feet
    double reach_;  ///< wanted
    double top_;
    double least_;          ///< s of the direct change
    bool swapped_ = false;  ///< peak and valley, and the feet, have changed places, since the feet would fall
    double floor_ = 0;      ///< what P^2 is at least, since the acceleration starts there
    double gap_ = 0;        ///< no swing has |s| below it: its first phase would last less than nothing
    double s_ = 0;          ///< found
    double cruise_ = 0;
};

}  // namespace motionrack::control
