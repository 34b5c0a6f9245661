// Random tasks for axis profiles, the properties of every profile, and the slow reference solver.

#pragma once

#include <cmath>
#include <cstdint>
#include <motionrack/control/axis_profile/axis_profile.hpp>
#include <optional>
#include <random>
#include <string>

namespace motionrack::control::travel_test {

struct Task {
    KinematicState from, to;
    KinematicLimits limits;
};

std::string text_of(const Task& task);

/// Random tasks, the same on every computer.
class Tasks {
  public:
    explicit Tasks(std::uint64_t seed) : random_(seed) {}

    /// Returns a random number from 0 to below 1.
    double part() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    double between(double min, double max) { return min + (max - min) * part(); }
    /// Returns a number of either sign, evenly distributed over the orders of magnitude.
    double of_magnitude(double min, double max);
    bool one_in(int n) { return random_() % static_cast<unsigned>(n) == 0; }

    /// Returns a typical task: limits near 1, everything random, some values at zero or at a limit.
    Task usual();
    /// Returns a task with limits and distances of any magnitude.
    Task any();
    /// Makes the target feasible: its velocity stays within the limit while its acceleration is brought to 0.
    void allow(Task& task);
    /// Returns a task whose start is outside the limits.
    Task outside();
    /// Sets the task to a random motion of a few phases within the limits, which ends at the target; returns its
    /// seconds.
    std::optional<double> motion(Task& task);

  private:
    std::mt19937_64 random_;
};

/// Returns the violated property of a profile for its task, or nothing. Checks order of phases, jerk at its limit or 0,
/// continuity, limits from `within` on, and exact ends.
std::string fault_of(const AxisProfile& travel, const Task& task, double within = 0);

/// Returns the minimum duration by a slow search over all motions of the form jerk +-j, 0, -+j, 0 (cruise), -+j, 0,
/// +-j; it scans and bisects their peak. Start and target must be within the limits. Returns infinity if the search
/// finds none.
double slowly_found_duration(const Task& task, int steps = 100);

/// Returns the instant from which on a profile is within the limits.
double entry_of(const AxisProfile& travel, const KinematicLimits& limits);

/// Returns the minimum time after which a start outside the limits stays within them: first the acceleration returns to
/// its limit, then the velocity. Slowly searches for the best peak deceleration.
double slowly_found_entry(const KinematicState& from, const KinematicLimits& limits);

/// Returns a hash of the bits of all phases for `count` tasks.
std::uint64_t bits_of_travels(std::uint64_t seed, int count);

}  // namespace motionrack::control::travel_test
