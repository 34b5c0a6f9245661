// Step loss of the rotor, and the position at which it locks again.
#include <algorithm>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/range.hpp>
#include <motionrack/sim/parts/stepper.hpp>

namespace motionrack::parts {

Stepper::Stepper(const StepperSettings& settings, StepperState& state) : settings_(settings), state_(state) {
    MOTIONRACK_ASSERT(settings.full_steps_per_rev > 0 && settings.microsteps > 0);
    MOTIONRACK_ASSERT(settings.start_stop_hz > 0 && settings.pull_out_hz > 0);
}

bool Stepper::may_lock() const {
    if (state_.jammed || std::fabs(state_.rate_hz) > std::min(settings_.start_stop_hz, settings_.pull_out_hz))
        return false;
    if (state_.hold == RotorHold::blocked_plus) return state_.rate_hz <= 0;
    if (state_.hold == RotorHold::blocked_minus) return state_.rate_hz >= 0;
    return true;
}

void Stepper::lock(std::int64_t pulses) {
    const std::int64_t cycle = settings_.electrical_cycle();
    const std::int64_t behind = pulses - state_.rotor_position;
    std::int64_t cycles = floor_div(behind + cycle / 2, cycle);
    if (state_.hold == RotorHold::blocked_plus) cycles = ceil_div(behind, cycle);  // never beyond the end
    if (state_.hold == RotorHold::blocked_minus) cycles = floor_div(behind, cycle);
    state_.lost = cycles * cycle;
    state_.hold = RotorHold::in_step;
}

void Stepper::change_rate(double rate_hz, std::int64_t pulses) {
    const double jump = rate_hz - state_.rate_hz;
    state_.rate_hz = rate_hz;
    if (state_.hold != RotorHold::in_step) {
        if (may_lock()) lock(pulses);
        return;
    }
    state_.rotor_position = pulses - state_.lost;
    state_.hold = RotorHold::stalled;
    if (!may_lock()) return;
    // An abrupt stop: the rotor's momentum carries it on, against the jump.
    constexpr double max_cycles = 1e6;
    const double cycles = std::min(std::floor(std::fabs(jump) / settings_.start_stop_hz), max_cycles);
    const std::int64_t run_on = static_cast<std::int64_t>(cycles) * settings_.electrical_cycle();
    state_.lost += jump < 0 ? -run_on : run_on;
    state_.hold = RotorHold::in_step;
}

void Stepper::block(int direction, std::int64_t end, std::int64_t pulses) {
    state_.rotor_position = end;
    state_.hold = direction > 0 ? RotorHold::blocked_plus : RotorHold::blocked_minus;
    if (may_lock()) lock(pulses);
}

void Stepper::jam(bool held, std::int64_t pulses) {
    if (held && in_step()) {
        state_.rotor_position = pulses - state_.lost;
        state_.hold = RotorHold::stalled;
    }
    state_.jammed = held;
    if (!in_step() && may_lock()) lock(pulses);
}

void Stepper::push(std::int64_t distance, std::int64_t pulses) {
    if (distance == 0) return;
    if (!in_step()) {
        state_.rotor_position += distance;
        state_.hold = RotorHold::stalled;
        if (may_lock()) lock(pulses);
        return;
    }
    const std::int64_t cycle = settings_.electrical_cycle();
    const std::int64_t size = distance < 0 ? -distance : distance;
    const std::int64_t cycles = std::max<std::int64_t>(1, (size + cycle / 2) / cycle);
    state_.lost += distance > 0 ? -cycles * cycle : cycles * cycle;
}

}  // namespace motionrack::parts
