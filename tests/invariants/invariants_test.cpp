// Each rule detects a history that violates it, and accepts one without violations.
#include <gtest/gtest.h>

#include <cmath>
#include <tests/invariants/invariants.hpp>
#include <utility>

namespace motionrack::test {
namespace {

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

struct Broken {
    const char* name;
    Rule rule;
    void (*history)(History& h);
};

void stop_on_the_way(History& h) {
    h.begin();
    h.order(Invariants::Order::stop);
    h.latch(true);
    h.to(MachineState::stopping);
    h.drive(0.1, -500);
    h.jump(0);
    h.to(MachineState::error_stop);
    h.pass(0.1);
}

/// A search that ends 0.6 mm off.
void search_beside(History& h, bool switch_mended) {
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

const Broken broken[] = {
    {"pulses_at_standstill", Rule::motion_needs_order,
     [](History& h) {
         h.jump(1);
         h.pass(0.02);
     }},
    {"a_ride_without_an_order", Rule::motion_needs_order,
     [](History& h) {
         h.to(MachineState::moving);
         h.drive(0.1, 500);
     }},
    {"a_disabled_axis", Rule::motion_needs_order,
     [](History& h) {
         h.now().axes[0].enabled = false;
         h.pass(0.01);
         h.begin();
     }},
    {"faster_after_a_stop", Rule::stop_slows,
     [](History& h) {
         h.begin();
         h.latch(true);
         h.drive(0.03, -500);
         h.drive(0.06, 300);
     }},
    {"no_end_after_a_stop", Rule::stop_slows,
     [](History& h) {
         h.begin();
         h.latch(true);
         h.pass(2);
     }},
    {"a_laser_after_a_stop", Rule::stop_slows,
     [](History& h) {
         h.now().lasers_on = 1;
         h.latch(true);
         h.pass(0.02);
     }},
    {"a_belt_after_a_stop", Rule::stop_slows,
     [](History& h) {
         h.latch(true);
         h.pass(0.02);
         h.now().belt_velocity = 3;
         h.pass(0.02);
     }},
    {"motion_before_a_reset", Rule::stop_stays,
     [](History& h) {
         stop_on_the_way(h);
         h.to(MachineState::moving);
         h.drive(0.02, 500);
     }},
    {"a_belt_that_goes_on_by_a_reset", Rule::stop_stays,
     [](History& h) {
         stop_on_the_way(h);
         h.order(Invariants::Order::reset);
         h.latch(false);
         h.pass(0.02);
         h.now().belt_velocity = 3;
         h.pass(0.02);
     }},
    {"a_stop_that_is_not_taken", Rule::stop_is_taken,
     [](History& h) {
         h.begin();
         h.order(Invariants::Order::stop);
         h.pass(0.02);
     }},
    {"an_error_stop_that_ends_by_itself", Rule::reset_is_needed,
     [](History& h) {
         stop_on_the_way(h);
         h.to(MachineState::standstill);
         h.latch(false);
         h.pass(0.02);
     }},
    {"a_table_that_stayed_behind", Rule::position_is_true,
     [](History& h) {
         h.begin();
         h.place_off = -0.64;
         h.end();
         h.pass(0.2);
     }},
    {"a_table_far_behind_in_motion", Rule::position_is_true,
     [](History& h) {
         h.begin();
         h.place_off = -2;
         h.pass(0.1);
     }},
    {"a_table_pushed_right_before_a_ride", Rule::position_is_true,
     [](History& h) {
         h.order(Invariants::Order::position);
         h.place_off = -0.64;
         h.begin();
         h.end();
         h.pass(0.2);
     }},
    {"a_home_that_was_pushed_while_others_search", Rule::position_is_true,
     [](History& h) {
         h.order(Invariants::Order::motion);
         h.to(MachineState::homing);
         h.pass(0.1);
         h.counter_off = 500;
         h.place_off = 5;
         h.pass(0.1);
         h.place_off = 5.64;
         h.pass(0.1);
         h.to(MachineState::standstill);
         h.pass(0.2);
     }},
    {"a_home_that_is_beside_its_switch", Rule::position_is_true, [](History& h) { search_beside(h, false); }},
    {"a_counter_that_jumps", Rule::counters_are_pulses,
     [](History& h) {
         h.begin();
         h.counter_off = 64;
         h.pass(0.02);
     }},
    {"too_fast", Rule::limits_kept,
     [](History& h) {
         h.begin();
         h.drive(0.14, 500);
     }},
    {"a_jump_of_velocity", Rule::limits_kept,
     [](History& h) {
         h.begin();
         h.jump(80);
         h.pass(0.03);
     }},
    {"a_stop_without_a_ramp_that_keeps_position_valid", Rule::limits_kept,
     [](History& h) {
         h.begin();
         h.latch(true);
         h.jump(0);
         h.to(MachineState::error_stop);
         h.pass(0.1);
     }},
    {"a_stop_by_a_card_without_a_ramp_that_keeps_position_valid", Rule::limits_kept,
     [](History& h) {
         h.begin();
         h.jump(0);
         h.pass(0.02);
         h.to(MachineState::error_stop);
         h.pass(0.02);
     }},
    {"a_jump_to_a_lower_velocity", Rule::limits_kept,
     [](History& h) {
         h.begin();
         h.jump(20);
         h.pass(0.4);
     }},
    {"beyond_its_travel", Rule::travel_kept,
     [](History& h) {
         h.begin();
         h.pass(5);
     }},
    {"one_alarm_twice", Rule::one_alarm_a_cause,
     [](History& h) {
         h.alarms.push_back({1, {}, "position", "lost"});
         h.pass(0.01);
         h.alarms.push_back({2, {}, "position", "lost"});
         h.pass(0.01);
     }},
    {"time_that_goes_back", Rule::time_is_monotone,
     [](History& h) {
         h.now().at = Instant{};
         h.pass(0.002);
     }},
    {"a_picture_twice", Rule::time_is_monotone,
     [](History& h) {
         --h.now().sequence;
         h.pass(0.002);
     }},
};

class BrokenHistory : public testing::TestWithParam<Broken> {};
INSTANTIATE_TEST_SUITE_P(Each, BrokenHistory, testing::ValuesIn(broken),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(BrokenHistory, IsFound) {
    History h;
    EXPECT_TRUE(h.findings().empty());
    GetParam().history(h);
    EXPECT_TRUE(h.found(GetParam().rule)) << name_of(GetParam().rule);
}

TEST(GoodHistory, OfRidesAndStopsHasNoFinding) {
    History h;
    h.begin();
    h.pass(0.5);
    h.end();
    stop_on_the_way(h);
    h.order(Invariants::Order::reset);
    h.latch(false);
    h.to(MachineState::standstill);
    h.pass(0.1);
    h.begin();
    h.end();
    for (const Finding& one : h.findings()) ADD_FAILURE() << name_of(one.rule) << ": " << one.text;
}

TEST(GoodHistory, MayEndPulsesAtOnceByTheEmergencyStop) {
    History h;
    h.begin();
    h.latch(true, true);
    h.jump(0);
    h.now().axes[0].position_valid = false;
    h.to(MachineState::error_stop);
    h.pass(0.3);
    for (const Finding& one : h.findings()) ADD_FAILURE() << name_of(one.rule) << ": " << one.text;
}

TEST(GoodHistory, MayEndPulsesAtOnceIfThatInvalidatesThePosition) {
    for (const bool by_card_alone : {false, true}) {
        History h;
        h.begin();
        if (!by_card_alone) h.latch(true), h.to(MachineState::stopping);
        h.jump(0);
        h.pass(0.1);
        h.now().axes[0].position_valid = false;
        h.to(MachineState::error_stop);
        h.pass(0.3);
        for (const Finding& one : h.findings()) ADD_FAILURE() << name_of(one.rule) << ": " << one.text;
    }
}

TEST(GoodHistory, MayBeginToMoveInThePictureInWhichAPositionIsDeclared) {
    History h;
    h.order(Invariants::Order::position);
    h.counter_off = 500;
    h.begin();
    h.end();
    h.pass(0.2);
    for (const Finding& one : h.findings()) ADD_FAILURE() << name_of(one.rule) << ": " << one.text;
}

TEST(GoodHistory, MayFindAHomeByTheEdgeOfASwitchThatIsMended) {
    History h;
    search_beside(h, true);
    for (const Finding& one : h.findings()) ADD_FAILURE() << name_of(one.rule) << ": " << one.text;
}

TEST(GoodHistory, MayDeclareAServoWhoseCounterStays) {
    History h(true);
    for (const double origin : {0.59, 0.0}) {
        h.order(Invariants::Order::position);
        h.origin = origin;
        h.pass(0.2);
    }
    for (const Finding& one : h.findings()) ADD_FAILURE() << name_of(one.rule) << ": " << one.text;
}

TEST(GoodHistory, MayEndARampWithPulsesThatComeLessOftenThanASample) {
    History h;
    h.begin();
    h.latch(true);
    h.to(MachineState::stopping);
    h.now().axes[0].driven = true;
    h.drive(0.098, -500);
    h.jump(0.4);  // one pulse every 25 ms
    h.pass(0.1);
    h.now().axes[0].driven = false;
    h.jump(0);
    h.to(MachineState::error_stop);
    h.pass(0.3);
    for (const Finding& one : h.findings()) ADD_FAILURE() << name_of(one.rule) << ": " << one.text;
}

TEST(GoodHistory, MayStartABeltBetweenAResetAndTheNextStopOfOneSlice) {
    for (const bool is_reset : {true, false}) {
        History h;
        stop_on_the_way(h);
        if (is_reset) h.order(Invariants::Order::reset);
        h.pass(0.002);
        h.order(Invariants::Order::part);
        h.now().belt_velocity = 3;
        h.order(Invariants::Order::stop);
        h.latch(true);
        h.pass(0.1);
        EXPECT_EQ(h.found(Rule::stop_slows), !is_reset);
    }
}

TEST(GoodHistory, MayBeResetBeforeTheNextIntervalShowsThatPulsesEndedAtOnce) {
    for (const double within : {0.002, 0.004, 0.006, 0.008, 0.01}) {  // within an interval
        History h;
        h.begin();
        h.latch(true);
        h.to(MachineState::stopping);
        h.order(Invariants::Order::reset);
        h.pass(within);
        h.jump(0);
        h.now().axes[0].position_valid = false;
        h.latch(false);
        h.to(MachineState::standstill);
        h.pass(0.3);
        for (const Finding& one : h.findings()) ADD_FAILURE() << within << ": " << name_of(one.rule) << one.text;
    }
}

TEST(Finding, IsReportedOnceARuleAndWithItsName) {
    History h;
    for (int i = 0; i < 3; ++i) h.ask_for(Rule::usable_again);
    EXPECT_EQ(h.findings().size(), 1u);
    for (int i = 0; i <= static_cast<int>(Rule::usable_again); ++i) EXPECT_FALSE(name_of(static_cast<Rule>(i)).empty());
}

}  // namespace
}  // namespace motionrack::test
