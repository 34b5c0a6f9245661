// Each rule detects a history that violates it.
#include <gtest/gtest.h>

#include <utility>

#include "history.hpp"

namespace motionrack::test {
namespace {

struct Broken {
    const char* name;
    Rule rule;
    void (*history)(History& h);
};

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

TEST_P(BrokenHistory, IsReported) {
    History h;
    EXPECT_TRUE(h.findings().empty());
    GetParam().history(h);
    EXPECT_TRUE(h.found(GetParam().rule)) << name_of(GetParam().rule);
}

TEST(Finding, IsReportedOnceARuleAndWithItsName) {
    History h;
    for (int i = 0; i < 3; ++i) h.ask_for(Rule::usable_again);
    EXPECT_EQ(h.findings().size(), 1u);
    for (int i = 0; i <= static_cast<int>(Rule::usable_again); ++i) EXPECT_FALSE(name_of(static_cast<Rule>(i)).empty());
}

}  // namespace
}  // namespace motionrack::test
