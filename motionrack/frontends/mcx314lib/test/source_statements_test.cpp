// Statements of the source about drives, arcs and stops, checked with its functions only.
#include <gtest/gtest.h>

#include <array>
#include <motionrack/frontends/mcx314lib/test/chip.hpp>

namespace motionrack::mcx314lib_test {
namespace {

constexpr std::array masks = {x, y, z, u};

int place_of(int axis) {
    return static_cast<int>(ReadLPS(axis));
}

TEST(Mcx314libDrives, ACurveWithoutEndKeepsVOnAllItsAxesUntilItIsStopped) {
    const Open chip;
    set_up();
    for (const bool s_curve : {false, true}) {
        if (s_curve)
            SCurve_C(x + z + u, 100, 3000, 400, 200);
        else
            TCurve_C(x + z + u, 100, 3000, 400);
        EXPECT_EQ(mcx314_advance_ms(1'500), 0);
        for (const int axis : {x, z, u}) EXPECT_EQ(ReadCV(axis), 3000u) << axis;
        EXPECT_EQ(mcx314_advance_ms(5'000), 0);
        for (const int axis : {x, z, u}) EXPECT_EQ(ReadCV(axis), 3000u) << axis;
        EXPECT_EQ(ReadCV(y), 0u);
        EXPECT_EQ(mcx314_stop(all), 0);
        EXPECT_EQ(mcx314_wait(all, 10'000), 0) << mcx314_last_error();
        EXPECT_EQ(place_of(x), place_of(u));
    }
}

TEST(Mcx314libDrives, AnSCurveDrivesSeveralAxes) {
    const Open chip;
    set_up();
    SCurve_F(y + u, 100, 3000, 400, 200, -7'000);
    EXPECT_EQ(mcx314_wait(all, 10'000), 0);
    EXPECT_EQ(place_of(y), -7'000);
    EXPECT_EQ(place_of(u), -7'000);
    EXPECT_EQ(place_of(x), 0);
}

TEST(Mcx314libDrives, SlowStopDeceleratesAndImmediateStopDoesNot) {
    const Open chip;
    set_up();
    const auto pulses_after = [](int (*stop)(int)) {
        TCurve_C(x, 100, 4000, 400);
        EXPECT_EQ(mcx314_advance_ms(2'000), 0);
        const int from = place_of(x);
        EXPECT_EQ(stop(x), 0);
        EXPECT_EQ(mcx314_wait(x, 10'000), 0);
        return place_of(x) - from;
    };
    // 39,000 pulses/s at 500,000 pulses/s2 take 78 ms and 1,600 pulses.
    EXPECT_NEAR(pulses_after(mcx314_stop), 1'600, 20);
    EXPECT_LE(pulses_after(mcx314_stop_now), 2);
}

TEST(Mcx314libDrives, SetDDecidesTheDecelerationUntilItIsTurnedOff) {
    const Open chip;
    set_up();
    const auto seconds = [] {
        MCX314_PLAN plan = {};
        EXPECT_EQ(mcx314_plan(x, 100, 4000, 400, 0, 20'000, &plan), 0);
        EXPECT_EQ(plan.end_hz, 1'000);
        const std::int64_t from = mcx314_now_us();
        TCurve_F(x, 100, 4000, 400, 20'000);
        EXPECT_EQ(mcx314_wait(x, 10'000), 0);
        const double took = static_cast<double>(mcx314_now_us() - from) * 1e-6;
        EXPECT_NEAR(took, plan.seconds, 2e-3);
        return took;
    };
    const double alike = seconds();
    SetD(x, 100);
    const double slow_end = seconds();
    // The deceleration takes 312 ms instead of 78; half of the extra 234 ms were driven at full speed before.
    EXPECT_NEAR(slow_end - alike, 0.117, 0.01);
    EXPECT_EQ(mcx314_asymmetric(x, 0), 0);
    EXPECT_NEAR(seconds(), alike, 1e-4);
}

// ---- arcs

struct ArcFunction {
    const char* name;
    void (*draw)(CIRCLEDATA*, int);
    bool clockwise, trapezoid;
};

constexpr ArcFunction arcs[] = {{"CircleCW_C", CircleCW_C, true, false},
                                {"CircleCCW_C", CircleCCW_C, false, false},
                                {"CircleCW_T", CircleCW_T, true, true},
                                {"CircleCCW_T", CircleCCW_T, false, true}};

TEST(Mcx314libArcs, OfAnyTwoAxesFollowTheCircle) {
    const Open chip;
    set_up();
    for (const ArcFunction& arc : arcs) {
        for (std::size_t first = 0; first < 4; ++first) {
            for (std::size_t second = first + 1; second < 4; ++second) {
                SCOPED_TRACE(std::string(arc.name) + " " + std::to_string(first) + std::to_string(second));
                const int right = masks[first], up = masks[second];
                LPS(all, 0);
                // A full circle from its leftmost point: clockwise, Y rises first.
                CIRCLEDATA circle = {100, 1000, 400, 0, {}, {}};
                circle.C[first] = 500;
                arc.draw(&circle, right + up);
                EXPECT_EQ(mcx314_moving(all) & (right + up), right + up) << mcx314_last_error();
                while (place_of(right) < 250 && mcx314_moving(all) != 0) continue;
                EXPECT_EQ(place_of(up) > 0, arc.clockwise);
                EXPECT_EQ(mcx314_wait(all, 10'000), 0);
                for (const int axis : masks) EXPECT_EQ(place_of(axis), 0) << axis;
            }
        }
    }
}

TEST(Mcx314libArcs, BeginAtTheAxesPositionsWhateverTheirNumbers) {
    const Open chip;
    set_up();
    LPS(x, 5'000);
    LPS(y, static_cast<unsigned>(-300));
    for (int n = 1; n <= 2; ++n) {
        CIRCLEDATA arc = quarter(true);
        CircleCW_C(&arc, x + y);
        EXPECT_EQ(mcx314_wait(all, 10'000), 0) << mcx314_last_error();
        EXPECT_EQ(place_of(x), 5'000 + 1'000 * n);
        EXPECT_EQ(place_of(y), -300 + 1'000 * n);
    }
}

TEST(Mcx314libArcs, WithATCurveDecelerateAtThePointOfManualDec) {
    const Open chip;
    set_up();
    for (const ArcFunction& arc : arcs) {
        if (!arc.trapezoid) continue;
        for (const bool early : {true, false}) {
            // 8 arcs of 45 degrees, each with the length of its side: 8 * 354 basic pulses.
            ManualDec(x, early ? 1'000 : 2'800);
            CIRCLEDATA circle = {100, 2000, 400, 0, {0, 0, 0, 0}, {500, 0, 0, 0}};
            arc.draw(&circle, x + y);
            unsigned last = 0;
            while (mcx314_moving(x) != 0)
                if (const unsigned speed = ReadCV(x); speed != 0) last = speed;
            EXPECT_EQ(last <= 100, early) << arc.name << " ended at " << last;
        }
    }
}

}  // namespace
}  // namespace motionrack::mcx314lib_test
