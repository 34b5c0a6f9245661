// Random tasks for travels, what must hold of every travel, and the slow referee.

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

/// Tasks at random, the same on every computer.
class Tasks {
  public:
    explicit Tasks(std::uint64_t seed) : random_(seed) {}

    /// 0 .. 1
    double part() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    double between(double least, double most) { return least + (most - least) * part(); }
    /// Evenly by order of magnitude, of either sign.
    double of_magnitude(double least, double most);
    bool one_in(int n) { return random_() % static_cast<unsigned>(n) == 0; }

    /// Numbers as they occur: limits near 1, everything at random, a few at rest or at a limit.
    Task usual();
    /// Limits and distances of any magnitude.
    Task any();
    /// A target within reach: its end speed and acceleration leave room to stop.
    void allow(Task& task);
    /// A start that is outside the limits.
    Task outside();
    /// Whatever motion, a few phases long, within the limits; its seconds. The target is where it ends.
    std::optional<double> motion(Task& task);

  private:
    std::mt19937_64 random_;
};

/// What is wrong with a travel for its task; nothing if all holds: phases in order, the jerk its limit or 0, the state
/// going on without jumps, limits held from `within` on, both ends exact.
std::string fault_of(const AxisProfile& travel, const Task& task, double within = 0);

/// The least duration by a slow search: all motions of the form jerk +-j, 0, -+j, 0 (cruise), -+j, 0, +-j, by their
/// peak, which is scanned and bisected. Starts and targets within the limits. Infinite if the search finds none.
double slowly_found_duration(const Task& task, int steps = 100);

/// The instant from which on a travel is within the limits.
double entry_of(const AxisProfile& travel, const KinematicLimits& limits);

/// How soon a start can be within the limits for good, its acceleration first, by a slow search over how far the
/// acceleration goes.
double slowly_found_entry(const KinematicState& from, const KinematicLimits& limits);

/// A sum of the bits of all phases of the travels of `count` tasks.
std::uint64_t bits_of_travels(std::uint64_t seed, int count);

}  // namespace motionrack::control::travel_test
