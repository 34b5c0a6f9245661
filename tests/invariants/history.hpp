// A history of one axis that a test writes, as the invariants see it.
#pragma once

#include <cmath>
#include <tests/invariants/invariants.hpp>
#include <vector>

namespace motionrack::test {

using operate::MachineState;

/// One axis with 100 pulses per mm, 100 mm/s, 1000 mm/s2, checked every 2 ms.
class History {
  public:
    explicit History(bool servo = false) : invariants_({{'X', servo, 100, 100, 1000, 2, 0, 300, 1}}, {}, {}) {
        invariants_.ordered(Invariants::Order::enable);
        now_.axes.resize(1);
        now_.axes[0].position_valid = true;
        now_.alarms = &alarms;
        place_ = 100;
        pass(0.02);
    }

    /// Drives for a time with an acceleration.
    void drive(double seconds, double accel) {
        for (double t = 0; t < seconds - 1e-9; t += 0.002) {
            velocity_ += accel * 0.002;
            place_ += velocity_ * 0.002;
            if (std::fabs(velocity_) < 1e-6) velocity_ = 0;
            see();
        }
    }
    void pass(double seconds) { drive(seconds, 0); }
    void order(Invariants::Order order) { invariants_.ordered(order); }
    void to(MachineState state) { now_.state = state; }
    void mend_switch() { invariants_.switch_disturbed(); }
    void jump(double velocity) { velocity_ = velocity; }
    /// Accelerates after a command.
    void begin() {
        order(Invariants::Order::motion);
        to(MachineState::moving);
        drive(0.1, 500);
    }
    void end() {
        drive(0.1, -500);
        velocity_ = 0;
        to(MachineState::standstill);
        pass(0.1);
    }
    void latch(bool on, bool abrupt = false) { now_.latched = on, now_.abrupt = abrupt, now_.stopped_at = now_.at; }
    Sight& now() { return now_; }
    bool found(Rule rule) const {
        for (const Finding& one : invariants_.findings())
            if (one.rule == rule) return true;
        return false;
    }
    const std::vector<Finding>& findings() const { return invariants_.findings(); }
    void ask_for(Rule rule) { invariants_.found(rule, now_.at, "seen elsewhere"); }

    std::vector<operate::Alarm> alarms;
    std::int64_t counter_off = 0;  ///< error of the card's counter
    double place_off = 0;          ///< error of the table position
    double origin = 0;             ///< position where the counter is 0

  private:
    void see() {
        now_.at = now_.at + milliseconds(2);
        ++now_.sequence;
        AxisSight& axis = now_.axes[0];
        axis.sent = std::llround(place_ * 100);
        axis.counter = axis.sent + counter_off;
        axis.commanded = origin + static_cast<double>(axis.counter) / 100;
        axis.true_position = static_cast<double>(axis.sent) / 100 + place_off;
        invariants_.see(now_);
    }
    Invariants invariants_;
    Sight now_;
    double place_ = 0, velocity_ = 0;
};

inline void stop_on_the_way(History& h) {
    h.begin();
    h.order(Invariants::Order::stop);
    h.latch(true);
    h.to(MachineState::stopping);
    h.drive(0.1, -500);
    h.jump(0);
    h.to(MachineState::error_stop);
    h.pass(0.1);
}

/// Homes with a result that is 0.6 mm off. `switch_mended`: the switch is repaired during the search.
inline void search_beside(History& h, bool switch_mended) {
    h.order(Invariants::Order::motion);
    h.now().axes[0].position_valid = false;
    h.to(MachineState::homing);
    h.pass(0.1);
    if (switch_mended) h.mend_switch();
    h.place_off = 0.6;
    h.now().axes[0].position_valid = true;
    h.to(MachineState::standstill);
    h.pass(0.2);
}

}  // namespace motionrack::test
