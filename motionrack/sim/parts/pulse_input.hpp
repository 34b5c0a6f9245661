// The pulses that drive the motor of one axis, and their watched range.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/range.hpp>
#include <motionrack/sim/parts/stepper.hpp>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::parts {

class PulseInput {
  public:
    /// `watched`: watched range of the pulses; it and `state` are parts of the axis' state, which must outlive this.
    PulseInput(const Stepper& motor, const StepperState& state, Range& watched)
        : motor_(motor), state_(state), watched_(watched) {}

    void connect(sim::PositionFunction& pulses, sim::PositionListener& axis) {
        MOTIONRACK_ASSERT(pulses_ == nullptr);
        pulses_ = &pulses;
        slot_ = pulses.add_listener(axis);
    }
    bool connected() const { return pulses_ != nullptr; }
    std::int64_t pulses_at(Instant t) const { return pulses_ ? pulses_->count(t) : 0; }
    std::int64_t rotor_at(Instant t) const { return motor_.rotor(pulses_at(t)); }
    /// Rate of the rotor by the last noted rate of the pulses, microsteps/s.
    double rotor_rate() const { return motor_.rotor_rate(state_.rate_hz); }
    /// Rate of the rotor by the present one.
    double rotor_rate_at(Instant t) const { return pulses_ ? motor_.rotor_rate(pulses_->rate(t)) : 0; }

    /// Watches the pulses for a rotor that leaves `rotor`.
    void watch(const Range& rotor) {
        const Range pulses = motor_.in_step() ? rotor.moved(state_.lost) : Range{};
        if (!pulses_ || pulses == watched_) return;
        watched_ = pulses;
        pulses_->watch(slot_, pulses.below, pulses.above);
    }
    /// Notes that the watch was notified, which clears it.
    void note_crossed() { watched_ = {1, -1}; }

    void set_edge_listener(sim::EdgeListener* listener) {
        MOTIONRACK_ASSERT(pulses_ != nullptr);
        pulses_->set_edge_listener(listener);
    }
    void deliver_edges() { pulses_->deliver_edges(); }

  private:
    const Stepper& motor_;
    const StepperState& state_;
    Range& watched_;
    sim::PositionFunction* pulses_ = nullptr;
    int slot_ = 0;
};

}  // namespace motionrack::parts
