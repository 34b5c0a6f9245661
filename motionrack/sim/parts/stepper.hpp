// A stepping motor: it follows the pulses or loses steps.
//
//   pulses --> in step:  rotor = pulses - lost            (lost: a multiple of 4 full steps, one electrical cycle)
//              stalled:  rotor is stationary until the pulses are slow enough to lock at the same electrical phase
//
//   rate jumps by more than start_stop_hz, or rate > pull_out_hz          in step -> stalled
//   rate <= start_stop_hz                                                 stalled -> in step, steps lost
//   rate jumps to <= start_stop_hz (an abrupt stop)                       in step at once, but with overrun: see below
//   the axle reaches an end of travel                                     blocked until the pulses stop or reverse
//
// After an abrupt stop the rotor overruns by one electrical cycle per start_stop_hz of the jump. The model has one
// number each for start/stop and pull-out rate: no torque curve, no load, no resonance.
#pragma once

#include <cmath>
#include <cstdint>

namespace motionrack::parts {

struct StepperSettings {
    std::int64_t full_steps_per_rev = 200;  ///< 1 .. 100'000
    std::int64_t microsteps = 16;           ///< pulses for one full step, 1 .. 1024
    double start_stop_hz = 2000;            ///< > 0: maximum jump of the pulse rate that the rotor follows, pulses/s
    double pull_out_hz = 200'000;           ///< > 0: above this rate it loses steps, pulses/s

    std::int64_t pulses_per_rev() const { return full_steps_per_rev * microsteps; }
    /// Pulses per cycle of the coil currents.
    std::int64_t electrical_cycle() const { return 4 * microsteps; }
};

/// State of the rotor, and the cause of a stall.
enum class RotorHold : std::int32_t { in_step, stalled, blocked_plus, blocked_minus };

struct StepperState {
    double rate_hz = 0;               ///< rate of the pulses
    std::int64_t lost = 0;            ///< pulses - rotor while in step
    std::int64_t rotor_position = 0;  ///< position of the rotor while not in step
    RotorHold hold = RotorHold::in_step;
    std::int32_t jammed = 0;  ///< fault: the axle is blocked
};

/// The rules of the motor for a state owned by its machine. Positions are microsteps (= pulses), rates pulses/s.
class Stepper {
  public:
    Stepper(const StepperSettings& settings, StepperState& state);

    std::int64_t rotor(std::int64_t pulses) const {
        return state_.hold == RotorHold::in_step ? pulses - state_.lost : state_.rotor_position;
    }
    /// Rate of the rotor at the pulse rate `rate_hz`.
    double rotor_rate(double rate_hz) const { return state_.hold == RotorHold::in_step ? rate_hz : 0; }
    bool in_step() const { return state_.hold == RotorHold::in_step; }

    void note_rate(double rate_hz) { state_.rate_hz = rate_hz; }

    /// The pulse rate changes to `rate_hz` and the rotor cannot follow, or is not in step; `pulses`: the present count.
    void change_rate(double rate_hz, std::int64_t pulses);
    /// The rotor has reached an end of travel at `end` and is blocked in `direction` (+1 or -1).
    void block(int direction, std::int64_t end, std::int64_t pulses);
    /// Fault: blocks or releases the axle.
    void jam(bool held, std::int64_t pulses);
    /// Moves the rotor by about `distance` microsteps: exactly while it is not in step, otherwise to the nearest
    /// position of the same electrical phase, at least one cycle away.
    void push(std::int64_t distance, std::int64_t pulses);

    const StepperSettings& settings() const { return settings_; }

  private:
    bool may_lock() const;
    void lock(std::int64_t pulses);

    StepperSettings settings_;
    StepperState& state_;
};

}  // namespace motionrack::parts
