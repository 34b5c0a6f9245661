// Tests of homing on a complete simulated machine: every method from every position, with bounce, missing switches,
// stops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/test/home_rig.hpp>

namespace motionrack::mcx314 {
namespace {

using testing::HasSubstr;

/// Returns the states passed, without START states.
std::string states_of(const HomeReport& report) {
    std::string out;
    for (const ChipHomingStateVisit& stay : report.stays) {
        if (stay.state.find("_START") != std::string_view::npos) continue;
        if (!out.empty()) out += ' ';
        out += stay.state;
    }
    return out;
}

/// Returns the first position at or below 1 mm, in pulses from `start_mm`.
std::int64_t switch_pulses(double start_mm) {
    return static_cast<std::int64_t>(640 * (1 - start_mm));
}

TEST(Homing, Type1DeceleratesAtTheSwitchAndHomeIsTheStopPosition) {
    HomeRig rig;
    rig.start();
    const Result<HomeReport> done = home(rig.driver, 0, rig_settings(1));
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(states_of(*done), "SEARCH_WAIT HOMED");
    EXPECT_EQ(rig.driver.ReadLPS(0), 0);
    EXPECT_EQ(rig.driver.ReadEPS(0), 0);
    // Decelerating from 10,000 to 500 pulses/s with 125,000 pulses/s2 takes 399 pulses beyond the edge.
    const std::int64_t beyond = switch_pulses(20) - rig.rotor();
    EXPECT_NEAR(static_cast<double>(beyond), (1e8 - 25e4) / 2 / 125'000, 12);
    EXPECT_EQ(done->zero_lp, rig.rotor());
    ASSERT_TRUE(done->switch_lp.has_value());
    EXPECT_GE(switch_pulses(20), *done->switch_lp);
    EXPECT_LE(switch_pulses(20), *done->switch_lp + done->switch_within);
    EXPECT_EQ(done->switch_speed_hz, 10'000);
    EXPECT_TRUE(done->homed);
}

TEST(Homing, Type2StopsExactlyAtTheEdgeOfTheSwitch) {
    HomeRig rig;
    rig.start();
    const Result<HomeReport> done = home(rig.driver, 0, rig_settings(2));
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(states_of(*done), "SEARCH_WAIT REST_WAIT BACK_WAIT CLEAR_WAIT SETTLE_WAIT SLOW_WAIT HOMED");
    EXPECT_EQ(rig.rotor(), switch_pulses(20));
    EXPECT_EQ(*done->switch_lp, switch_pulses(20));
    EXPECT_EQ(done->switch_within, 0);
    EXPECT_EQ(done->relative(*done->switch_lp), 0);
    ASSERT_EQ(done->edges.size(), 3u);
    EXPECT_TRUE(done->edges[0].active);
    EXPECT_FALSE(done->edges[1].active);
    EXPECT_EQ(done->relative(done->edges[1].lp), 32) << "0.05 mm of hysteresis";
    EXPECT_EQ(done->edges[1].within, 0);
}

TEST(Homing, Type3EndsAtTheFirstIndexAfterTheSwitch) {
    HomeRig rig;
    rig.start();
    const Result<HomeReport> done = home(rig.driver, 0, rig_settings(3));
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(states_of(*done), "SEARCH_WAIT INDEX_WAIT HOMED");
    EXPECT_EQ(rig.rotor() % pulses_per_turn, 0);
    EXPECT_EQ(rig.rotor(), -4 * pulses_per_turn) << "switch at -12,160, slowed down at about -12,560";
    EXPECT_NEAR(static_cast<double>(*done->switch_to_index()), 12'800 - 12'160,
                static_cast<double>(done->switch_within));
}

TEST(Homing, Type4EndsAtTheFirstIndexAfterTheSlowApproach) {
    HomeRig rig;
    rig.start();
    const Result<HomeReport> done = home(rig.driver, 0, rig_settings(4));
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(states_of(*done), "SEARCH_WAIT REST_WAIT BACK_WAIT CLEAR_WAIT SETTLE_WAIT SLOW_WAIT INDEX_WAIT HOMED");
    EXPECT_EQ(rig.rotor(), -4 * pulses_per_turn);
    EXPECT_EQ(*done->switch_to_index(), 640);
}

TEST(Homing, SetsBothCountersToTheHomePosition) {
    HomeRig rig;
    rig.start();
    HomeSettings s = rig_settings(2);
    s.home_position = 640;
    s.home_counts = 800;
    ASSERT_TRUE(home(rig.driver, 0, s));
    EXPECT_EQ(rig.driver.ReadLPS(0), 640);
    EXPECT_EQ(rig.driver.ReadEPS(0), 800);
    EXPECT_DOUBLE_EQ(rig.position(), 1.0);
}

TEST(Homing, RestoresModesAndEnablesSoftwareLimitsOnAValidPosition) {
    HomeRig rig;
    rig.start();
    rig.driver.WriteMode1(1, 0x8000);
    rig.driver.WriteMode2(1, 0x0047);
    rig.driver.WriteMode3(1, 0x0007);
    ASSERT_TRUE(rig.driver.SetCompP(1, 10));
    ASSERT_TRUE(rig.driver.SetCompM(1, -10));
    ASSERT_TRUE(home(rig.driver, 0, rig_settings(2)));
    EXPECT_EQ(rig.driver.mode1(0), 0x8000);
    EXPECT_EQ(rig.driver.mode2(0), 0x0047);
    EXPECT_EQ(rig.driver.mode3(0), 0x0007);
}

class EachType : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, EachType, testing::Values(1, 2, 3, 4, 5));

TEST_P(EachType, EndsAtTheSamePulseFromOffTheSwitchOnItAndAtTheLimit) {
    std::vector<double> ends;
    for (const double start : {20.0, 200.0, 1.5, 1.025, 1.0, 0.0, -1.0, -8.0, -8.5, 302.5}) {
        if (GetParam() == 4 && start == 1.0) continue;  // from there, an index is at the switch's edge
        HomeRig rig({RigAxis{.start_mm = start}});
        rig.start();
        const Result<HomeReport> done = home(rig.driver, 0, rig_settings(GetParam()));
        ASSERT_TRUE(done) << start << ": " << done.error().message;
        ends.push_back(rig.position());
        // The index is at whole revolutions of the rotor, counted from the start.
        if (GetParam() == 3 || GetParam() == 4) {
            EXPECT_EQ(rig.rotor() % pulses_per_turn, 0) << start;
        } else {
            EXPECT_NEAR(rig.position(), GetParam() == 1 ? ends.front() : 1.0, 1e-9) << start;
        }
    }
}

TEST_P(EachType, IsRepeatableToThePulse) {
    for (const Duration bounce : {Duration{0}, milliseconds(1), milliseconds(4)}) {
        RigAxis axis;
        axis.bounce = bounce;
        HomeRig rig({axis});
        rig.start();
        const std::int64_t away[] = {64, 640, 5000, 23'456, 1};
        const Result<HomeSpread> done = repeat_home(rig.driver, 0, rig_settings(GetParam()), 5, away);
        ASSERT_TRUE(done) << done.error().message;
        EXPECT_EQ(done->spread, 0) << to_seconds(bounce);
        EXPECT_EQ(done->counts_spread, 0);
        EXPECT_EQ(done->pulses.size(), 6u);
    }
}

TEST(Homing, WithoutSettlingBounceCostsNoMoreThanTheHysteresis) {
    RigAxis axis;
    axis.bounce = milliseconds(20);
    HomeRig rig({axis});
    rig.start();
    HomeSettings s = rig_settings(2);
    s.settle = Duration{0};
    s.backoff = 0;
    const std::int64_t away[] = {500, 7000, 333};
    const Result<HomeSpread> done = repeat_home(rig.driver, 0, s, 12, away);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_LE(done->spread, 33);
    EXPECT_GT(done->spread, 0) << "bounce of 20 ms is seen by an approach that does not wait for it";
}

TEST_P(EachType, ReportsASwitchThatIsMissing) {
    RigAxis axis;
    axis.wired_home = false;
    HomeRig rig({axis});
    rig.start();
    HomeSettings s = rig_settings(GetParam());
    s.turn_at_limit = false;
    const Result<HomeReport> done = home(rig.driver, 0, s);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, ErrorKind::machine);
    EXPECT_THAT(done.error().message, HasSubstr("the home switch (IN0, active Low) was not found"));
    EXPECT_THAT(done.error().message, HasSubstr("a limit switch ended the search in - direction"));
    EXPECT_THAT(done.error().message, HasSubstr("not valid"));
    EXPECT_FALSE(rig.driver.moving(1));
}

TEST_P(EachType, ReportsAMissingSwitchAfterSearchingInBothDirections) {
    RigAxis axis;
    axis.wired_home = false;
    axis.limit_plus_mm = 30;
    HomeRig rig({axis});
    rig.start();
    const HomeSettings s = rig_settings(GetParam());
    const Result<HomeReport> done = home(rig.driver, 0, s);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message,
                HasSubstr("a limit switch ended the search in + direction, nor in the other direction"));
    EXPECT_NEAR(rig.position(), 30, 1);
}

TEST_P(EachType, StopsWithinTheTravel) {
    HomeRig rig({RigAxis{.start_mm = 250}});
    rig.start();
    HomeSettings s = rig_settings(GetParam());
    s.travel = 6400;
    const Result<HomeReport> done = home(rig.driver, 0, s);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("was not found within 6,400 pulses in - direction"));
    EXPECT_EQ(rig.rotor(), -6400) << "the chip itself ends the drive";
}

TEST_P(EachType, ReportsASwitchThatDoesNotRelease) {
    HomeRig rig;
    rig.fault(0, "home.stuck_closed");
    rig.start();
    rig.hold_wire("c.xin0", 0);
    HomeSettings s = rig_settings(GetParam());
    s.travel = 1000;
    const Result<HomeReport> done = home(rig.driver, 0, s);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("is active and was not released within 1,000 pulses"));
}

TEST(Homing, ReportsAMissingIndex) {
    for (const int type : {3, 4}) {
        HomeRig rig({RigAxis{.wired_index = false}});
        rig.start();
        rig.hold_wire("c.xin2", 0);
        const Result<HomeReport> done = home(rig.driver, 0, rig_settings(type));
        ASSERT_FALSE(done);
        EXPECT_THAT(done.error().message,
                    HasSubstr("the encoder's index (IN2, active High) was not seen within 3,200 pulses"));
        EXPECT_FALSE(rig.driver.moving(1));
    }
}

TEST(Homing, RejectsAnIndexAtAnUnexpectedPosition) {
    for (const int type : {3, 4}) {
        HomeRig found({RigAxis{}});
        found.start();
        HomeSettings settings = rig_settings(type);
        const Result<HomeReport> first = home(found.driver, 0, settings);
        ASSERT_TRUE(first);
        const std::int64_t way = first->switch_to_index().value_or(0);
        for (const std::int64_t off : {0, 700, 900}) {
            HomeRig rig({RigAxis{}});
            rig.start();
            settings.turn = 3'200;
            settings.index_after = way + off;
            const Result<HomeReport> done = home(rig.driver, 0, settings);
            EXPECT_EQ(done.has_value(), off < 800) << off;
            if (done) continue;
            EXPECT_THAT(done.error().message, HasSubstr("behind the switch; it must be"));
            EXPECT_THAT(done.error().message, HasSubstr("second index"));
            EXPECT_FALSE(rig.driver.moving(1));
        }
    }
}

TEST(Homing, RefusesAnIndexAtTheSwitchItself) {
    HomeRig rig({RigAxis{.start_mm = 21}});  // the index is at 1 mm, where the switch acts
    rig.start();
    const Result<HomeReport> done = home(rig.driver, 0, rig_settings(4));
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("Shift the switch by half a motor revolution"));
}

// ---- starting conditions

/// A machine with a cam switch; the edges of the cam are in pulses from the start of the axis.
struct CamRig : HomeRig {
    explicit CamRig(std::int64_t low, std::int64_t high)
        : HomeRig({RigAxis{.wired_home = false}}), cam(kernel, "cam", *machines[0], low, high) {
        join(cam.wire(), "c.xin0");
    }
    Cam cam;
};

TEST(Homing, ReversesAtTheLimitBehindAShortSwitchAndFindsTheSameEdge) {
    CamRig before(-8000, -7000), beyond(3000, 4000);  // the axis is 7,000 above it, and 3,000 below it
    before.start(), beyond.start();
    for (CamRig* rig : {&before, &beyond}) {
        const Result<HomeReport> done = home(rig->driver, 0, rig_settings(2));
        ASSERT_TRUE(done) << done.error().message;
    }
    EXPECT_EQ(before.rotor(), -7000);
    EXPECT_EQ(beyond.rotor(), 4000);
}

TEST(Homing, ASwitchShorterThanTheStoppingDistanceIsFoundAfterReversing) {
    CamRig rig(-7060, -7000);  // the cam is 60 pulses wide, and decelerating takes 400
    rig.start();
    const Result<HomeReport> done = home(rig.driver, 0, rig_settings(2));
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(rig.rotor(), -7000);
    EXPECT_THAT(states_of(*done), HasSubstr("RETURN_WAIT BACK_WAIT"));
}

TEST(Homing, ReportsALimitAtWhichItMayNotReverse) {
    CamRig rig(3000, 4000);
    rig.start();
    rig.hold_wire("c.xlmtm", 0);
    HomeSettings s = rig_settings(2);
    s.turn_at_limit = false;
    const Result<HomeReport> done = home(rig.driver, 0, s);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message,
                HasSubstr("was not found within 0 pulses, where a limit switch ended the search"));
    EXPECT_EQ(rig.rotor(), 0);
}

TEST(Homing, InTheOtherDirectionTheSameSwitchIsFoundByItsOtherLevel) {
    HomeRig rig({RigAxis{.start_mm = -1.5}});
    rig.start();
    HomeSettings s = rig_settings(2);
    s.negative = false;
    s.active_high = true;
    const Result<HomeReport> done = home(rig.driver, 0, s);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_NEAR(rig.position(), 1.05, 1.01 / pulses_per_mm) << "where it is released";
}

TEST(Homing, RejectsImpossibleSettingsAndMovesNothing) {
    HomeRig rig;
    rig.start();
    Home one(rig.driver, 0);
    const auto refusal = [&](auto change) {
        HomeSettings s = rig_settings(2);
        change(s);
        const Result<void> started = one.start(s, rig.port.now());
        EXPECT_FALSE(started);
        EXPECT_EQ(started.error().kind, ErrorKind::refused);
        return started ? std::string() : started.error().message;
    };
    EXPECT_THAT(refusal([](HomeSettings& s) { s.type = 6; }), HasSubstr("the type is 6; it must be 1 to 5"));
    EXPECT_THAT(refusal([](HomeSettings& s) { s.slow_v = 51; }),
                HasSubstr("the slow speed (at most SV) is 51; it must be 1 to 50"));
    EXPECT_THAT(refusal([](HomeSettings& s) { s.type = 4, s.index_input = 0; }), HasSubstr("both IN0"));
    EXPECT_THAT(refusal([](HomeSettings& s) { s.travel = 0; }), HasSubstr("the travel is 0"));
    rig.hold_wire("c.emgn", 0);
    EXPECT_THAT(refusal([](HomeSettings&) {}), HasSubstr("emergency stop is active; release it"));
    rig.kernel.release(rig.kernel.find_wire("c.emgn"));
    rig.hold_wire("c.xlmtp", 0);
    rig.hold_wire("c.xlmtm", 0);
    EXPECT_THAT(refusal([](HomeSettings&) {}), HasSubstr("both limit switches are active"));
    rig.kernel.release(rig.kernel.find_wire("c.xlmtp"));
    rig.kernel.release(rig.kernel.find_wire("c.xlmtm"));
    ASSERT_TRUE(rig.driver.TCurve_C(1, 50, 100, 100));
    EXPECT_THAT(refusal([](HomeSettings&) {}), HasSubstr("it moves; stop it"));
    EXPECT_EQ(one.report().stays.size(), 0u);
    EXPECT_FALSE(one.homed());
}

TEST(Homing, AReleasedEmergencyStopDoesNotPreventHoming) {
    HomeRig rig;
    rig.start();
    ASSERT_TRUE(rig.driver.TCurve_C(1, 50, 100, 100));
    rig.port.pass(milliseconds(5));
    rig.hold_wire("c.emgn", 0);
    rig.port.pass(milliseconds(5));
    rig.kernel.release(rig.kernel.find_wire("c.emgn"));
    rig.kernel.settle();
    EXPECT_TRUE(home(rig.driver, 0, rig_settings(2)));
}

}  // namespace
}  // namespace motionrack::mcx314
