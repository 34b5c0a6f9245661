// Tests of manual operation on the simulated machine; the tests pass the time as an argument.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <motionrack/cards/mcx314/driver/manual.hpp>
#include <motionrack/cards/mcx314/test/home_rig.hpp>
#include <random>
#include <set>
#include <string>

namespace motionrack::mcx314 {
namespace {

using testing::HasSubstr;

struct ManualRig : HomeRig {
    explicit ManualRig(const RigAxis& axis = {}) : HomeRig({axis}), manual(driver, 0) { start(); }
    Instant now() { return port.now(); }
    /// Advances the time with a poll every millisecond, renewing the jog at `v` unless it is 0.
    void run(Duration time, std::int64_t v = 0) {
        for (const Instant end = now() + time; now() < end;) {
            if (v != 0) last = manual.jog(v, now());
            manual.step(now());
            port.pass(milliseconds(1));
        }
    }
    std::int64_t rate() { return static_cast<std::int64_t>(chip.pulses(0).rate(kernel.now())); }
    Manual manual;
    Result<void> last;
};

TEST(Jog, ContinuesWhileRenewedAndDeceleratesWithoutRenewal) {
    ManualRig rig;
    rig.run(milliseconds(600), 500);
    EXPECT_EQ(rig.manual.state(), ManualState::jogging);
    EXPECT_NEAR(static_cast<double>(rig.rate()), 5000, 1);
    const Instant last_renewed = rig.now();
    while (rig.manual.state() == ManualState::jogging) rig.run(milliseconds(1));
    EXPECT_NEAR(to_seconds(rig.now() - last_renewed), 0.250, 0.003);
    EXPECT_EQ(rig.manual.state(), ManualState::stopping);
    rig.run(milliseconds(100));
    EXPECT_EQ(rig.manual.state(), ManualState::standing);
    EXPECT_FALSE(rig.driver.moving(1));
    EXPECT_EQ(rig.manual.why_ended(), "");
    EXPECT_GT(rig.rotor(), 0);
    EXPECT_EQ(rig.machines[0]->lost_steps(), 0);
}

TEST(Jog, ChangesItsSpeedOnTheFly) {
    ManualRig rig;
    rig.run(milliseconds(300), -200);
    EXPECT_NEAR(static_cast<double>(rig.rate()), -2000, 1);
    rig.run(milliseconds(300), -900);
    EXPECT_NEAR(static_cast<double>(rig.rate()), -9000, 1);
    rig.run(milliseconds(300), -20);
    EXPECT_NEAR(static_cast<double>(rig.rate()), -200, 1);
    EXPECT_EQ(rig.manual.state(), ManualState::jogging);
}

TEST(Jog, StopsBeforeItReverses) {
    ManualRig rig;
    rig.run(milliseconds(300), 900);
    rig.run(milliseconds(2), -400);
    EXPECT_EQ(rig.manual.state(), ManualState::turning);
    EXPECT_GT(rig.rate(), 0);
    rig.run(milliseconds(300), -400);
    EXPECT_EQ(rig.manual.state(), ManualState::jogging);
    EXPECT_NEAR(static_cast<double>(rig.rate()), -4000, 1);
    EXPECT_EQ(rig.machines[0]->lost_steps(), 0);
    rig.run(milliseconds(2), 400);
    rig.run(milliseconds(400));
    EXPECT_EQ(rig.manual.state(), ManualState::standing) << "let go during the turn: it does not start again";
    EXPECT_EQ(rig.rate(), 0);
}

TEST(Jog, DwellsAtStandstillBeforeItReverses) {
    ManualRig rig;
    rig.run(milliseconds(300), 900);
    int rested_ms = 0;
    for (int ms = 0; ms < 200; ++ms) {
        rig.run(milliseconds(1), -900);
        rested_ms += rig.rate() == 0;
    }
    EXPECT_NEAR(rested_ms, 20, 2);
    EXPECT_LT(rig.rate(), 0);
}

TEST(Jog, RestartsFromStandstillIfRenewedWhileDecelerating) {
    ManualRig rig;
    rig.run(milliseconds(300), 900);
    EXPECT_TRUE(rig.manual.jog(0, rig.now()));
    EXPECT_EQ(rig.manual.state(), ManualState::stopping);
    rig.run(milliseconds(200), 300);
    EXPECT_EQ(rig.manual.state(), ManualState::jogging);
    EXPECT_NEAR(static_cast<double>(rig.rate()), 3000, 1);
}

TEST(Jog, EndsAtALimitAndMovesAwayFromItOnly) {
    ManualRig rig({.start_mm = 300});
    rig.run(whole_seconds(3), 500);
    EXPECT_FALSE(rig.last);
    EXPECT_THAT(rig.last.error().message, HasSubstr("it is on the + limit switch; move it in - direction"));
    EXPECT_EQ(rig.manual.state(), ManualState::standing);
    EXPECT_THAT(rig.manual.why_ended(), HasSubstr("+ limit switch"));
    const std::int64_t at = rig.rotor();
    rig.run(milliseconds(300), -500);
    EXPECT_TRUE(rig.last);
    EXPECT_LT(rig.rotor(), at);
}

TEST(Jog, IsRejectedWithTheReason) {
    ManualRig rig;
    ManualSettings s;
    s.max_v = 300;
    ASSERT_TRUE(rig.manual.set(s));
    EXPECT_THAT(rig.manual.jog(301, rig.now()).error().message, HasSubstr("the speed is 301; it must be 1 to 300"));
    rig.hold_wire("c.emgn", 0);
    EXPECT_THAT(rig.manual.jog(100, rig.now()).error().message, HasSubstr("emergency stop"));
    rig.kernel.release(rig.kernel.find_wire("c.emgn"));
    rig.kernel.settle();
    ASSERT_TRUE(rig.driver.TCurve_C(1, 50, 100, 100));
    EXPECT_THAT(rig.manual.jog(100, rig.now()).error().message, HasSubstr("by another command"));
    rig.driver.SlowStop(1);
    rig.port.pass(milliseconds(50));
    ASSERT_TRUE(rig.manual.jog(100, rig.now()));
    EXPECT_THAT(rig.manual.set(s).error().message, HasSubstr("it is jogging"));
    s.hold = Duration{0};
    EXPECT_THAT(rig.manual.set(s).error().message, HasSubstr("in ms, is 0; it must be 1 to 10000"));
}

TEST(StepJog, MovesExactlyItsPulses) {
    ManualRig rig;
    ASSERT_TRUE(rig.manual.step_jog(-123, 400));
    EXPECT_FALSE(rig.manual.step_jog(5, 400));
    EXPECT_FALSE(rig.manual.jog(100, rig.now()));
    rig.run(milliseconds(400));
    EXPECT_EQ(rig.manual.state(), ManualState::standing);
    EXPECT_EQ(rig.rotor(), -123);
    ASSERT_TRUE(rig.manual.step_jog(1, 400));
    rig.run(milliseconds(100));
    EXPECT_EQ(rig.rotor(), -122);
    EXPECT_FALSE(rig.manual.step_jog(0, 400));
    EXPECT_FALSE(rig.manual.step_jog(10, -400));
}

TEST(StepJog, IsStoppedByStop) {
    ManualRig rig;
    ASSERT_TRUE(rig.manual.step_jog(100'000, 900));
    rig.run(milliseconds(300));
    rig.manual.stop();
    EXPECT_EQ(rig.manual.state(), ManualState::stopping);
    rig.run(milliseconds(300));
    EXPECT_EQ(rig.manual.state(), ManualState::standing);
    EXPECT_LT(rig.rotor(), 10'000);
    ASSERT_TRUE(rig.manual.step_jog(100'000, 900));
    rig.run(milliseconds(300));
    const std::int32_t before = rig.driver.ReadLPS(0);
    rig.manual.stop_now();
    rig.run(milliseconds(2));
    EXPECT_LE(rig.driver.ReadLPS(0) - before, 1);
    EXPECT_NE(rig.machines[0]->lost_steps(), 0)
        << "a motor at 9,000 pulses/s does not stop at once: the position is lost";
}

TEST(ManualHome, HomesWhileTheButtonIsHeld) {
    ManualRig rig;
    while (rig.manual.state() == ManualState::standing || rig.manual.state() == ManualState::homing) {
        ASSERT_TRUE(rig.manual.home(rig_settings(2), rig.now()));
        rig.run(milliseconds(10));
        if (rig.manual.homing().homed()) break;
    }
    EXPECT_TRUE(rig.manual.homing().homed());
    EXPECT_DOUBLE_EQ(rig.position(), 1.0);
}

TEST(ManualHome, StopsWithoutAValidPositionWhenTheButtonIsReleased) {
    ManualRig rig;
    ASSERT_TRUE(rig.manual.home(rig_settings(2), rig.now()));
    rig.run(milliseconds(200));
    EXPECT_EQ(rig.manual.state(), ManualState::homing);
    EXPECT_FALSE(rig.manual.jog(100, rig.now()));
    rig.run(milliseconds(500));
    EXPECT_EQ(rig.manual.state(), ManualState::standing);
    EXPECT_FALSE(rig.manual.homing().homed());
    EXPECT_THAT(rig.manual.why_ended(), HasSubstr("stopped on request"));
    EXPECT_FALSE(rig.driver.moving(1));
}

TEST(Manual, HasTheStatesOfTheDeclaredStateTable) {
    EXPECT_EQ(manual_machine().states.size(), static_cast<std::size_t>(ManualState::stopping) + 1);
    ManualRig rig;
    EXPECT_EQ(rig.manual.state_name(), "standing");
    ASSERT_TRUE(rig.manual.jog(10, rig.now()));
    EXPECT_EQ(rig.manual.state_name(), "jogging");
}

/// Compares each change of state with the declared table. A call may pass through standing, because jog() notices first
/// that the previous motion has ended.
struct WatchedManual : ManualRig {
    std::set<std::string> taken;
    std::string problem;

    bool take(ManualState from, ManualState to) {
        const MachineInfo& machine = manual_machine();
        const auto name = [&](ManualState state) { return machine.states[static_cast<std::size_t>(state)].name; };
        for (const TransitionInfo& t : machine.transitions)
            if (t.from == name(from) && t.to == name(to)) {
                taken.insert(std::string(t.from) + " -> " + std::string(t.to));
                return true;
            }
        return false;
    }
    template <class Call>
    void watch(const Call& call) {
        const ManualState from = manual.state();
        call();
        const ManualState to = manual.state();
        if (from == to || take(from, to)) return;
        if (take(from, ManualState::standing) && take(ManualState::standing, to)) return;
        problem += std::to_string(static_cast<int>(from)) + " -> " + std::to_string(static_cast<int>(to)) + "; ";
    }
    /// Polls every millisecond, and calls `call` after each poll.
    template <class Call>
    void poll(int ms, const Call& call) {
        for (int i = 0; i < ms; ++i) {
            watch([&] { manual.step(now()); });
            watch(call);
            port.pass(milliseconds(1));
        }
    }
    void poll(int ms) {
        poll(ms, [] {});
    }
    void jog(int ms, std::int64_t v) {
        poll(ms, [&] { last = manual.jog(v, now()); });
    }
    void release_limit() {
        kernel.release(kernel.find_wire("c.xlmtp"));
        kernel.settle();
    }
};

TEST(Manual, TakesEveryTransitionOfItsStateTableAndNoOther) {
    WatchedManual rig;
    rig.jog(300, 900);
    rig.jog(200, -400);  // reverses
    rig.jog(2, 400);
    rig.watch([&] { rig.last = rig.manual.jog(0, rig.now()); });  // stops during the reversal
    rig.jog(300, 400);                                            // reverses out of the stop
    rig.poll(600);                                                // without renewal
    rig.watch([&] { rig.last = rig.manual.step_jog(100, 400); });
    rig.poll(400);
    rig.watch([&] { rig.last = rig.manual.step_jog(100'000, 400); });
    rig.poll(100);
    rig.watch([&] { rig.manual.stop(); });
    rig.poll(200);
    rig.watch([&] { rig.last = rig.manual.home(rig_settings(2), rig.now()); });
    rig.poll(900);  // without renewal
    rig.jog(200, 500);
    rig.hold_wire("c.xlmtp", 0);
    rig.jog(200, 500);  // the limit ends the jog
    rig.release_limit();
    rig.jog(200, -500);
    rig.jog(2, 400);
    rig.hold_wire("c.xlmtp", 0);
    rig.poll(200);  // stops at the limit of the new direction
    EXPECT_EQ(rig.problem, "");
    for (const TransitionInfo& t : manual_machine().transitions) {
        const std::string way = std::string(t.from) + " -> " + std::string(t.to);
        EXPECT_EQ(rig.taken.count(way), 1u) << way << " was never taken";
    }
}

TEST(Manual, TakesOnlyTransitionsOfItsStateTableInRandomOperation) {
    constexpr unsigned seed = 1;
    std::cout << "seed " << seed << std::endl;
    std::mt19937 random(seed);
    const auto pick = [&](std::uint32_t n) { return static_cast<std::int64_t>(random() % n); };
    WatchedManual rig;
    for (int i = 0; i < 150; ++i) {
        const std::int64_t what = pick(7), v = (pick(2) == 0 ? 1 : -1) * (1 + pick(900));
        rig.watch([&] {
            if (what == 0) rig.last = rig.manual.jog(0, rig.now());
            if (what == 1) rig.last = rig.manual.step_jog(v, 1 + pick(900));
            if (what == 2) rig.last = rig.manual.home(rig_settings(2), rig.now());
            if (what == 3) rig.manual.stop();
        });
        if (what < 4)
            rig.poll(static_cast<int>(1 + pick(300)));
        else
            rig.jog(static_cast<int>(1 + pick(200)), v);
    }
    EXPECT_EQ(rig.problem, "");
    EXPECT_GE(rig.taken.size(), 8u);
}

}  // namespace
}  // namespace motionrack::mcx314
