// Each rule accepts a history without violations.
#include <gtest/gtest.h>

#include "history.hpp"

namespace motionrack::test {
namespace {

TEST(GoodHistory, OfMotionAndStopsHasNoFinding) {
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

TEST(GoodHistory, MayStartToMoveInTheSnapshotInWhichAPositionIsDeclared) {
    History h;
    h.order(Invariants::Order::position);
    h.counter_off = 500;
    h.begin();
    h.end();
    h.pass(0.2);
    for (const Finding& one : h.findings()) ADD_FAILURE() << name_of(one.rule) << ": " << one.text;
}

TEST(GoodHistory, MayFindHomeByTheEdgeOfARepairedSwitch) {
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

}  // namespace
}  // namespace motionrack::test
