// Tests of the source's four homing functions: their inputs, paths and speeds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/cards/mcx314/test/home_rig.hpp>

namespace motionrack::mcx314 {
namespace {

using testing::HasSubstr;

/// WR1Reg: IN0 active Low is the origin, IN2 active High the index.
constexpr unsigned origin_in0 = 0x0012;
/// Position of the rig's switch, pulses from its start at 20 mm.
constexpr std::int64_t origin = -19 * 640;

const ChipHomingStateVisit& stay_in(const HomeReport& report, std::string_view state) {
    for (const ChipHomingStateVisit& stay : report.stays)
        if (stay.state == state) return stay;
    ADD_FAILURE() << state << " was not entered";
    return report.stays.front();
}

/// Returns the speed in a state of constant speed, pulses/s.
double speed_in(const HomeReport& report, std::string_view state) {
    const ChipHomingStateVisit& stay = stay_in(report, state);
    return std::fabs(static_cast<double>(pulse_delta(stay.from_lp, stay.to_lp))) / to_seconds(stay.took);
}

HomeReport homed_by(HomeRig& rig, decltype(&HomeType1) function, unsigned wr1 = origin_in0) {
    const auto done = function(rig.driver, axis_x, wr1, 50, 1000, 100);
    EXPECT_TRUE(done) << (done ? "" : done.error().message);
    return done ? done->front() : HomeReport{};
}

TEST(HomingBySource, Type2ReversesAtTheInitialSpeedAndApproachesAtHalfOfIt) {
    HomeRig rig;
    rig.start();
    const HomeReport report = homed_by(rig, HomeType2);
    EXPECT_EQ(rig.rotor(), origin);
    EXPECT_NEAR(speed_in(report, "BACK_WAIT"), 500, 5);
    EXPECT_NEAR(speed_in(report, "SLOW_WAIT"), 250, 2.5);
}

TEST(HomingBySource, Type3ApproachesTheIndexAtTheInitialSpeed) {
    HomeRig rig;
    rig.start();
    const HomeReport report = homed_by(rig, HomeType3);
    EXPECT_EQ(rig.rotor(), -4 * pulses_per_turn);
    EXPECT_NEAR(speed_in(report, "INDEX_WAIT"), 500, 5);
}

TEST(HomingBySource, Type4StopsAtTheIndexBeforeItReversesAndEndsAtTheOrigin) {
    HomeRig rig;
    rig.start();
    const HomeReport report = homed_by(rig, HomeType4);
    EXPECT_EQ(stay_in(report, "INDEX_WAIT").to_lp, -4 * pulses_per_turn);
    EXPECT_EQ(stay_in(report, "BACK_WAIT").from_lp, -4 * pulses_per_turn);
    EXPECT_LT(stay_in(report, "INDEX_WAIT").from, stay_in(report, "BACK_WAIT").from);
    EXPECT_NEAR(speed_in(report, "BACK_WAIT"), 500, 5);
    EXPECT_NEAR(speed_in(report, "SLOW_WAIT"), 250, 2.5);
    EXPECT_EQ(rig.rotor(), origin);
    EXPECT_EQ(rig.driver.ReadLPS(0), 0);
}

TEST(HomingBySource, Type4StopsAtTheIndexFromAnyStartPosition) {
    for (const double start : {20.0, 0.5, -7.5, -8.5}) {  // before the switch, on it, beyond the limit switch
        SCOPED_TRACE(start);
        HomeRig rig({RigAxis{.start_mm = start}});
        rig.start();
        const HomeReport report = homed_by(rig, HomeType4);
        EXPECT_LT(stay_in(report, "INDEX_WAIT").from, stay_in(report, "SLOW_WAIT").from);
        EXPECT_TRUE(report.index_lp.has_value());
        EXPECT_NEAR(rig.position(), 1, 1e-9);
    }
}

TEST(HomingBySource, Type4AcceptsAnIndexThatIsAlreadyActive) {
    HomeRig rig({RigAxis{.wired_index = false}});
    rig.start();
    rig.hold_wire("c.xin2", 1);
    homed_by(rig, HomeType4);
    EXPECT_EQ(rig.rotor(), origin);
}

TEST(HomingBySource, AnyInputMayBeTheOriginAtEitherLevel) {
    for (const int input : {0, 1, 2, 3}) {
        for (const bool high : {false, true}) {
            for (const auto function : {&HomeType2, &HomeType3, &HomeType4}) {
                SCOPED_TRACE("IN" + std::to_string(input) + (high ? " High" : " Low"));
                const int index = input == 2 ? 3 : 2;
                const RigAxis axis{.wired_home = false, .wired_index = false, .home_level = high ? 1 : 0};
                HomeRig rig({axis});
                rig.join(rig.machines[0]->home_wire(), "c.xin" + std::to_string(input));
                rig.join(rig.machines[0]->index_wire(), "c.xin" + std::to_string(index));
                rig.start();
                homed_by(rig, function, (high ? 3u : 2u) << 2 * input | 1u << 2 * index);
                EXPECT_EQ(rig.rotor(), function == &HomeType3 ? -4 * pulses_per_turn : origin);
            }
        }
    }
}

TEST(HomingBySource, AnOriginAtTheLimitIsHomeIfApproachedAtTheLatchSpeed) {
    for (const double above : {0.0, 0.2}) {  // decelerating takes 400 pulses, 0.6 mm
        for (const double start : {20.0, -8.0, -8.5}) {
            const RigAxis axis{.start_mm = start, .home_mm = -8 + above};
            HomeRig rig({axis});
            rig.start();
            homed_by(rig, HomeType2);
            EXPECT_NEAR(rig.position(), axis.home_mm, 1e-9) << start;
        }
    }
}

TEST(HomingBySource, ReportsAnOriginTooCloseToTheLimitForDeceleration) {
    for (const auto function : {&HomeType1, &HomeType3}) {
        HomeRig rig({RigAxis{.home_mm = -7.8}});
        rig.start();
        const auto done = function(rig.driver, axis_x, origin_in0, 50, 1000, 100);
        ASSERT_FALSE(done);
        EXPECT_THAT(
            done.error().message,
            HasSubstr(
                "(IN0, active Low) is so near to the limit switch that the axis reached the limit while decelerating"));
        EXPECT_FALSE(rig.driver.moving(axis_x));
    }
}

TEST(HomingBySource, Type4ReportsAMissingIndexAtTheLimit) {
    HomeRig rig({RigAxis{.home_mm = -7.8}});  // the next index is at -10 mm, beyond the limit
    rig.start();
    const auto done = HomeType4(rig.driver, axis_x, origin_in0, 50, 1000, 100);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("the encoder's index (IN2, active High) was not seen within"));
    EXPECT_FALSE(rig.driver.moving(axis_x));
}

TEST(HomingBySource, TypesWithAnIndexKeepItAtIn2WhereAnotherInputIsEnabled) {
    const HomeSettings both = *home_settings(3, 0x0032, 50, 1000, 100);
    EXPECT_EQ(both.input, 0);
    EXPECT_EQ(both.index_input, 2);
    EXPECT_TRUE(both.index_high);
    const HomeSettings in2_alone = *home_settings(4, 0x0060, 50, 1000, 100);
    EXPECT_EQ(in2_alone.input, 2);
    EXPECT_FALSE(in2_alone.active_high);
    EXPECT_EQ(in2_alone.index_input, 3);
    EXPECT_TRUE(in2_alone.index_high);
}

TEST(HomingBySource, EachTypeRejectsAWordThatEnablesNoOrigin) {
    HomeRig rig;
    rig.start();
    for (const auto function : {&HomeType1, &HomeType2, &HomeType3, &HomeType4}) {
        const auto none = function(rig.driver, axis_x, 0x0055, 50, 1000, 100);
        ASSERT_FALSE(none);
        EXPECT_THAT(none.error().message, HasSubstr("WR1Reg is 0055h, which enables none of IN0 to IN3"));
    }
    EXPECT_EQ(rig.rotor(), 0);
}

}  // namespace
}  // namespace motionrack::mcx314
