// The strain between pulses and rotor: a jump of the pulse rate that the motor does not follow at once.
//
//   rate  ____________|~~~~~~~~~    pulses
//                     |             step loss when they are one full step away from the rotor at its steady rate,
//         ------------------------  not sooner: a pulse that is early or late has no effect
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/sim/parts/pulse_input.hpp>
#include <motionrack/sim/parts/stepper.hpp>

namespace motionrack::parts {

struct RotorStrainState {
    double steady_hz =
        0;  ///< the rate that the rotor's inertia follows: the pulse rate with jumps smoothed over a millisecond
    Instant steady_at{};
    double rate_hz = 0;  ///< the steady rate when the strain began
    Instant since{};
    Instant deadline = never;  ///< never: no strain
    std::int64_t pulses = 0;   ///< at `since`
};

class RotorStrain {
  public:
    /// The states are parts of the axis' state, which must outlive this.
    RotorStrain(RotorStrainState& state, Stepper& motor, const StepperState& motor_state)
        : state_(state), motor_(motor), motor_state_(motor_state) {}

    /// Instant of the step loss; never without a strain.
    Instant deadline() const { return state_.deadline; }

    /// The pulse rate changes from `before` to `rate`. Returns true if the motor cannot follow; else ends a strain.
    bool change_rate(double before, double rate, Instant now);
    /// Begins or continues a strain at `rate`; computes the time until step loss. `pulses`: the present count.
    void strain(double rate, std::int64_t pulses, Instant now);
    /// Ends the strain at its deadline, after a deviation of one full step: `lose_steps` with the pulse rate makes the
    /// motor stall or, at a low rate, lock at another position. No step loss if the mean pulse rate since the begin was
    /// low enough.
    template <class LoseSteps>
    void expire(PulseInput& input, Instant now, LoseSteps lose_steps) {
        if (survive(input.pulses_at(now), now)) return;
        input.deliver_edges();  // the pulses before the step loss still move the rotor
        const double rate = motor_state_.rate_hz;
        motor_.note_rate(state_.rate_hz);
        lose_steps(rate);
        settle(rate, now);
    }

  private:
    bool survive(std::int64_t pulses, Instant now);
    /// The rotor's inertia follows `rate` from now on.
    void settle(double rate, Instant now);
    void follow(double to);
    /// Updates the smoothed rate for the elapsed time.
    void smooth(Instant now);

    RotorStrainState& state_;
    Stepper& motor_;
    const StepperState& motor_state_;
};

}  // namespace motionrack::parts
