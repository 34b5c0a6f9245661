// Contract between the function library and any card: here run on a virtual chip, elsewhere on a live port. The tests
// use only registers and the library, need no wiring, and assume no exact durations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/cards/mcx314/test/contract_port.hpp>
#include <vector>

namespace motionrack::mcx314 {
namespace {

using testing::HasSubstr;

constexpr Duration contract_max_wait = whole_seconds(20);

class Contract : public testing::Test {
  protected:
    void SetUp() override {
        card_ = make_contract_port();
        if (!card_) GTEST_SKIP() << "no card";
        driver_.emplace(card_->registers(), card_->interrupt());
        driver_->initialise();
        ASSERT_TRUE(driver_->SetMultiple(xyzu, 100));
    }
    void TearDown() override {
        if (driver_) driver_->stop_all(StopKind::quick);
    }
    Driver& card() { return *driver_; }
    void done(const Result<void>& result) { ASSERT_TRUE(result) << result.error().message; }
    void finish(unsigned axes) { done(card().wait_until_done(axes, contract_max_wait)); }

    std::unique_ptr<ContractPort> card_;
    std::optional<Driver> driver_;
};

TEST_F(Contract, AfterAResetAllCountersAreZero) {
    EXPECT_EQ(card().status().word & 0x01FFu, 0u);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(card().ReadLPS(i), 0) << i;
        EXPECT_EQ(card().ReadEPS(i), 0) << i;
        EXPECT_EQ(card().ReadCV(i), 0) << i;
        EXPECT_EQ(card().axis_status(i).why_stopped(), "") << i;
        EXPECT_FALSE(card().axis_status(i).at_limit()) << i;
    }
    EXPECT_EQ(card().error_text(), "");
}

TEST_F(Contract, CountersAcceptEveryValueForEachAxisSeparately) {
    for (const std::int64_t value : {0LL, 1LL, -1LL, 65'535LL, 65'536LL, 2'147'483'647LL, -2'147'483'648LL}) {
        for (int i = 0; i < 4; ++i) {
            done(card().LPS(1u << i, value));
            done(card().EPS(1u << i, value < 0 ? value + 1 : value - 1));
        }
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(card().ReadLPS(i), value);
            EXPECT_EQ(card().ReadEPS(i), value < 0 ? value + 1 : value - 1);
        }
    }
    done(card().LPS(axis_y | axis_u, 5));
    EXPECT_EQ(card().ReadLPS(0), -2'147'483'648LL);
    EXPECT_EQ(card().ReadLPS(1), 5);
    EXPECT_EQ(card().ReadLPS(3), 5);
}

TEST_F(Contract, ATrapezoidMakesExactlyItsPulsesInItsDirection) {
    for (const std::int64_t pulses : {1LL, 2LL, 7LL, 999LL, 4'000LL, -1LL, -3'001LL}) {
        done(card().LPS(xyzu, 0));
        done(card().TCurve_F(axis_x | axis_z, 10, 800, 400, pulses));
        finish(axis_x | axis_z);
        EXPECT_EQ(card().ReadLPS(0), pulses);
        EXPECT_EQ(card().ReadLPS(1), 0);
        EXPECT_EQ(card().ReadLPS(2), pulses);
        EXPECT_EQ(card().ReadCV(0), 0);
    }
}

TEST_F(Contract, AnSCurveMakesExactlyItsPulses) {
    for (const std::int64_t pulses : {1LL, 500LL, -4'001LL}) {
        done(card().LPS(axis_u, 0));
        done(card().SCurve_F(axis_u, 10, 800, 400, 20, pulses));
        finish(axis_u);
        EXPECT_EQ(card().ReadLPS(3), pulses);
    }
}

TEST_F(Contract, ManualAndAsymmetricDecelerationMakeExactlyTheirPulses) {
    done(card().ManualDec(axis_x, 1'500));
    done(card().TCurve_F(axis_x, 10, 800, 400, 2'000));
    finish(axis_x);
    EXPECT_EQ(card().ReadLPS(0), 2'000);
    done(card().AutoDec(axis_x));
    done(card().SetD(axis_x, 100));
    done(card().SetAsymmetric(axis_x, true));
    done(card().TCurve_F(axis_x, 10, 800, 400, -2'000));
    finish(axis_x);
    EXPECT_EQ(card().ReadLPS(0), 0);
}

TEST_F(Contract, PulseAndDriveFixedMoveEachAxisByItsOwnDistance) {
    done(card().SetSV(xyzu, 10));
    done(card().SetV(xyzu, 500));
    done(card().SetA(xyzu, 400));
    done(card().Pulse(axis_x, 700));
    done(card().Pulse(axis_y, -300));
    done(card().DriveFixed(axis_x | axis_y));
    finish(axis_x | axis_y);
    EXPECT_EQ(card().ReadLPS(0), 700);
    EXPECT_EQ(card().ReadLPS(1), -300);
}

TEST_F(Contract, AContinuousDriveRunsUntilItIsStopped) {
    for (const bool negative : {false, true}) {
        done(card().LPS(axis_y, 0));
        done(card().TCurve_C(axis_y, 10, 500, 400, negative));
        EXPECT_TRUE(card().moving(axis_y));
        const Result<void> early = card().wait_until_stopped(axis_y, milliseconds(50));
        ASSERT_FALSE(early);
        EXPECT_THAT(early.error().message, HasSubstr("Y still moves"));
        done(card().stop(axis_y, negative ? StopKind::quick : StopKind::slow));
        finish(axis_y);
        EXPECT_EQ(card().ReadLPS(1) < 0, negative);
        EXPECT_GT(std::abs(card().ReadLPS(1)), 100);
    }
}

TEST_F(Contract, HeldDrivesStartTogether) {
    done(card().SetSV(xyzu, 100));
    done(card().SetV(xyzu, 100));
    done(card().SetA(xyzu, 100));
    done(card().Pulse(axis_x | axis_y, 50));
    card().Hold(axis_x | axis_y);
    card().Drive(axis_x, false);
    card().Drive(axis_y, true);
    card().interrupt().pass(milliseconds(5));
    EXPECT_EQ(card().ReadLPS(0), 0);
    card().Start(axis_x | axis_y);
    finish(axis_x | axis_y);
    EXPECT_EQ(card().ReadLPS(0), 50);
    EXPECT_EQ(card().ReadLPS(1), -50);
}

TEST_F(Contract, LinesOfTwoAndThreeAxesEndAtTheirFinishPoints) {
    LINEDATA data{10, 500, 400, 0, 20, {1'000, -600, 250, -1'000}};
    struct Case {
        const char* name;
        Result<void> (Driver::*draw)(const LINEDATA&, unsigned);
        unsigned axes;
    };
    const std::vector<Case> cases = {{"2C xy", &Driver::Line2D_C, 0x3},  {"2T xz", &Driver::Line2D_T, 0x5},
                                     {"2S xu", &Driver::Line2D_S, 0x9},  {"2T yz", &Driver::Line2D_T, 0x6},
                                     {"2C yu", &Driver::Line2D_C, 0xA},  {"2S zu", &Driver::Line2D_S, 0xC},
                                     {"3C", &Driver::Line3D_C, 0x7},     {"3T xyu", &Driver::Line3D_T, 0xB},
                                     {"3S xzu", &Driver::Line3D_S, 0xD}, {"3T yzu", &Driver::Line3D_T, 0xE}};
    for (const Case& one : cases) {
        SCOPED_TRACE(one.name);
        done(card().LPS(xyzu, 0));
        done((card().*one.draw)(data, one.axes));
        EXPECT_TRUE(card().status().interpolating());
        finish(one.axes);
        for (int i = 0; i < 4; ++i)
            EXPECT_EQ(card().ReadLPS(i), one.axes >> i & 1 ? data.P[static_cast<std::size_t>(i)] : 0) << i;
    }
}

TEST_F(Contract, FinishPointsMayBeSetBefore) {
    done(card().SetFP(axis_x, 300));
    done(card().SetP(axis_y, -400));
    done(card().Line2D_T({10, 500, 400}, 0x3));
    finish(0x3);
    EXPECT_EQ(card().ReadLPS(0), 300);
    EXPECT_EQ(card().ReadLPS(1), -400);
    done(card().SetCP(axis_x, 400));
    done(card().SetC(axis_y, 0));
    done(card().SetFP(axis_x | axis_y, 400));
    done(card().CircleCW_C({10, 500, 400}, 0x3));
    finish(0x3);
    EXPECT_EQ(card().ReadLPS(0), 700);
    EXPECT_EQ(card().ReadLPS(1), 0);
}

TEST_F(Contract, QuartersAndFullCirclesEndAtTheirFinishPoints) {
    struct Case {
        bool clockwise, trapezoid;
        FourAxes finish, centre;
    };
    const std::vector<Case> cases = {{false, false, {500, 500}, {0, 500}},  {true, false, {500, -500}, {0, -500}},
                                     {false, true, {-500, 500}, {-500, 0}}, {true, true, {500, 500}, {500, 0}},
                                     {false, true, {0, 0}, {300, 400}},     {true, true, {0, 0}, {-300, 400}}};
    for (const Case& one : cases) {
        done(card().LPS(xyzu, 0));
        const CIRCLEDATA data{10, 500, 400, 0, one.finish, one.centre};
        const auto end = card().arc_end(data, 0x3, one.clockwise);
        ASSERT_TRUE(end);
        done(one.trapezoid ? (one.clockwise ? card().CircleCW_T(data, 0x3) : card().CircleCCW_T(data, 0x3))
                           : (one.clockwise ? card().CircleCW_C(data, 0x3) : card().CircleCCW_C(data, 0x3)));
        finish(0x3);
        EXPECT_EQ(card().ReadLPS(0), one.finish[0]);
        EXPECT_EQ(card().ReadLPS(1), one.finish[1]);
        EXPECT_EQ(end->first, one.finish[0]);
        EXPECT_EQ(end->second, one.finish[1]);
    }
}

/// The sample of the maker: lines and quarter circles of a rounded square, back to its start.
TEST_F(Contract, TheDocumentedContourIsClosed) {
    for (const std::int64_t acceleration : {0, 400}) {
        done(card().LPS(xyzu, 0));
        done(card().ContStart({20, 300, acceleration, 0}));
        done(card().ContLine(0x3, {450, 0}));
        done(card().ContArc(0x3, {150, 150}, {0, 150}, false));
        done(card().ContLine(0x3, {0, 150}));
        done(card().ContArc(0x3, {-150, 150}, {-150, 0}, false));
        done(card().ContLine(0x3, {-450, 0}));
        done(card().ContArc(0x3, {-150, -150}, {0, -150}, false));
        done(card().ContLine(0x3, {0, -150}));
        done(card().ContArc(0x3, {150, -150}, {150, 0}, false));
        const Result<ContOutcome> outcome = card().ContEnd(contract_max_wait);
        ASSERT_TRUE(outcome) << outcome.error().message;
        EXPECT_EQ(outcome->segments, 8);
        EXPECT_EQ(card().ReadLPS(0), 0);
        EXPECT_EQ(card().ReadLPS(1), 0);
        EXPECT_LE(outcome->end_speed, acceleration == 0 ? 300 : 20);
    }
}

/// Words stacked before the start and words added while the drive runs form one path.
TEST_F(Contract, ABitPatternOfTwoAxesEndsAtTheSumOfItsBits) {
    done(card().BP2D({0, 20, 0, 0}, 0x9));
    const BPWORD word{{0xFFFF, 0x00F0}, {0x0000, 0xFF00}};  // X 16 times +; U 4 times +, 8 times -
    for (int i = 0; i < 3; ++i) done(card().BPStack(word));
    const Result<void> full = card().BPStack(word);
    ASSERT_FALSE(full);
    EXPECT_EQ(full.error().kind, ErrorKind::refused);
    done(card().BPStart());
    for (int i = 0; i < 9; ++i) done(card().BPStack(word, contract_max_wait));
    done(card().SetOutput(axis_x, 0, true));  // does not disturb the pattern
    done(
        card().BPStack({{0x0007, 0x0008}, {0x0000, 0x0008}}, contract_max_wait));  // X three times +, then the end code
    done(card().BPEnd(contract_max_wait));
    EXPECT_EQ(card().ReadLPS(0), 12 * 16 + 3);
    EXPECT_EQ(card().ReadLPS(3), 12 * -4);
    EXPECT_EQ(card().ReadLPS(1), 0);
    // The shared registers have their own functions again.
    done(card().TCurve_F(axis_x, 10, 500, 400, 5));
    finish(axis_x);
    EXPECT_EQ(card().ReadLPS(0), 12 * 16 + 8);
}

TEST_F(Contract, ABitPatternOfThreeAxesDeceleratesAtItsPoint) {
    done(card().BP3D({10, 200, 50, 20}, 0x7));
    done(card().BPStack({{0xFFFF, 0x5555, 0x0000}, {0x0000, 0x0000, 0x8001}}));
    done(card().BPStack({{0xFFFF, 0x5555, 0x0000}, {0x0000, 0x0000, 0x8001}}));
    done(card().BPStack({{0x0001, 0x0000, 0x0000}, {0x0001, 0x0000, 0x0000}}));
    done(card().BPStart());
    done(card().BPEnd(contract_max_wait));
    EXPECT_EQ(card().ReadLPS(0), 32);
    EXPECT_EQ(card().ReadLPS(1), 16);
    EXPECT_EQ(card().ReadLPS(2), -4);
}

TEST_F(Contract, ALineIsMadeStepByStep) {
    done(card().SetStep(StepBy::command));
    done(card().Line2D_C({0, 500, 0, 0, 0, {6, -3}}, 0x3));
    for (int n = 1; n <= 6; ++n) {
        EXPECT_TRUE(card().status().interpolating());
        done(card().Step());
        card().interrupt().pass(milliseconds(2));
        EXPECT_EQ(card().ReadLPS(0), n);
    }
    finish(0x3);
    EXPECT_EQ(card().ReadLPS(1), -3);
    done(card().SetStep(StepBy::generator));
    EXPECT_FALSE(card().Step());
}

TEST_F(Contract, SpeedAndTargetChangeWhileDriving) {
    done(card().TCurve_F(axis_x, 10, 200, 800, 20'000));
    card().interrupt().pass(milliseconds(30));
    done(card().change_speed(axis_x, 2'000));
    done(card().change_pulses(0, 25'000));
    const Result<void> back = card().change_pulses(0, -30'000);
    ASSERT_FALSE(back);
    EXPECT_THAT(back.error().message, HasSubstr("cannot reverse"));
    finish(axis_x);
    EXPECT_EQ(card().ReadLPS(0), 25'000);
    EXPECT_FALSE(card().change_speed(axis_x, 100));
}

TEST_F(Contract, ADrivingAxisRejectsAnotherDrive) {
    done(card().TCurve_C(axis_x, 10, 500, 400));
    for (const Result<void>& refused :
         {card().TCurve_F(axis_x | axis_y, 10, 500, 400, 100), card().SetRange(xyzu, 80'000),
          card().SetMultiple(axis_x, 3), card().Line2D_T({10, 500, 400, 0, 0, {100, 100}}, 0x3),
          card().SetPulseMode(axis_x, 1)}) {
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message, HasSubstr("X is driving"));
    }
    EXPECT_FALSE(card().moving(axis_y));
    card().stop_all(StopKind::slow);
    finish(xyzu);
    EXPECT_EQ(card().ReadLPS(1), 0);
}

TEST_F(Contract, SoftwareLimitsStopAndReportTheRemedy) {
    done(card().SetCompP(axis_x, 1'000));
    done(card().SetCompM(axis_x, -1'000));
    done(card().SLMTP(1, axis_x));
    done(card().SLMTM(1, axis_x));
    done(card().TCurve_C(axis_x, 10, 500, 400));
    const Result<void> stopped = card().wait_until_done(axis_x, contract_max_wait);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::machine);
    EXPECT_THAT(stopped.error().message, HasSubstr("the + software limit was passed"));
    EXPECT_THAT(stopped.error().message, HasSubstr("Drive in - direction"));
    EXPECT_GT(card().ReadLPS(0), 1'000);
    EXPECT_TRUE(card().axis_status(0).at_software_limit());
    done(card().TCurve_F(axis_x, 10, 500, 400, -card().ReadLPS(0)));
    finish(axis_x);
    EXPECT_EQ(card().ReadLPS(0), 0);
}

TEST_F(Contract, TheEndOfADriveInterruptsAndReadingClearsIt) {
    if (!card_->has_interrupt_line()) GTEST_SKIP() << "its interrupts do not reach this program";
    done(card().EnableInterrupt(axis_y, cause::drive_end));
    done(card().TCurve_F(axis_y, 10, 500, 400, 200));
    EXPECT_TRUE(card().interrupt().wait(contract_max_wait));
    EXPECT_FALSE(card().moving(axis_y));
    EXPECT_EQ(card().read_interrupts(1), cause::drive_end);
    EXPECT_EQ(card().read_interrupts(1), 0);
    EXPECT_FALSE(card().interrupt().wait(milliseconds(1)));
    // A wait returns the interrupts that it has read to find the end.
    done(card().TCurve_F(axis_y, 10, 500, 400, 200));
    finish(axis_y);
    EXPECT_EQ(card().read_interrupts(1), cause::drive_end);
    done(card().DisableInterrupt(axis_y));
    done(card().TCurve_F(axis_y, 10, 500, 400, 200));
    finish(axis_y);
    EXPECT_EQ(card().read_interrupts(1), 0);
}

TEST_F(Contract, SpeedsOfAllAxesAreReadInInterpolation) {
    done(card().Line3D_C({0, 200, 0, 0, 0, {40'000, -20'000, 10'000}}, 0x7));
    card().interrupt().pass(milliseconds(10));
    const auto line = card().axis_speeds();
    ASSERT_TRUE(line);
    EXPECT_NEAR((*line)[0], 20'000, 1);
    EXPECT_NEAR((*line)[1], -10'000, 1);
    EXPECT_NEAR((*line)[2], 5'000, 1);
    EXPECT_EQ((*line)[3], 0);
    card().stop_all(StopKind::quick);
    finish(xyzu);
    const auto still = card().axis_speeds();
    ASSERT_TRUE(still);
    EXPECT_EQ((*still)[0], 0);
}

}  // namespace
}  // namespace motionrack::mcx314
