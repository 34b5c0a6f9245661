// The laws of motion between two events, in closed form: what generators and paths do in the next ticks and pulses.
// Reads the state and changes nothing.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class MotionLaw {
  public:
    explicit MotionLaw(const State& state) : state_(state) {}

    // motion_law.cpp: an axis at an instant
    std::int64_t count_at(int a, Instant t) const;
    /// Returns the rate of axis `a` at `t`, pulses/s, signed; on an arc that along the tangent.
    double rate_of(int a, Instant t) const;
    /// Returns the last pulse of axis `a` as it is at `tick`.
    PulseMark mark_at(int a, std::int64_t tick) const;
    /// Returns the number of basic pulses (>= 1) until the final deceleration of generator `a`, far if it has none.
    std::int64_t pulses_to_final(int a) const;

    // motion_law_path.cpp: the running segment
    bool path_finished() const;
    /// Returns the direction of AX(i+1), -1 or +1; 0: it is stationary.
    int path_direction(int i) const;
    /// Returns true if the pulses of generator `a` are executed one by one.
    bool walks_pulses(int a) const;
    /// Returns the number of basic pulses of the path until AX(i+1) has made `steps` more steps, far if that is beyond
    /// the next event.
    std::int64_t pulses_until_steps(int generator, int i, std::int64_t steps) const;
    /// Returns the sum that acc must reach, by adding the speed, until the next `pulses` basic pulses (>= 1) are
    /// output.
    std::int64_t phase_for(const Generator& gen, std::int64_t pulses) const;
    /// Returns the number of basic pulses in the next plain working ticks, whose speeds add up to `added`.
    std::int64_t pulses_of(const Generator& gen, std::int64_t added) const;
    /// Returns the signed steps of AX1 .. AX3 in the next `pulses` basic pulses.
    std::array<std::int64_t, 3> path_steps(std::int64_t pulses) const;

    // motion_law_walk.cpp: steps of the speed
    /// Adds up the speed steps of generator `a` from its present state, within the given ticks and sum of the speed.
    Walk walk(int a, std::int64_t tick_limit, std::int64_t phase_limit) const;
    /// Returns the sum of the generator's speed in the next `ticks`, none of them after next_tick.
    std::int64_t phase_in(int a, std::int64_t ticks) const;
    /// Returns the tick and the speed of the last of `pulses` basic pulses within the next `ticks`.
    PulseMoment last_pulse(int a, std::int64_t pulses, std::int64_t ticks) const;

  private:
    std::int64_t extra_steps(std::int64_t pulses) const;
    double pattern_share(int i) const;

    const State& state_;
};

}  // namespace motionrack::mcx314
