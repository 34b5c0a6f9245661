// Tests of refusals of the function library: the message contains the range, and no register is written, whichever of
// several axes is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <functional>
#include <limits>
#include <motionrack/cards/mcx314/driver/home_series.hpp>
#include <motionrack/cards/mcx314/driver/manual.hpp>
#include <motionrack/cards/mcx314/driver/real_axis.hpp>
#include <vector>

namespace motionrack::mcx314 {
namespace {

using testing::_;
using testing::HasSubstr;
using testing::NiceMock;
using testing::Return;

class MockPort : public RegisterPort {
  public:
    MOCK_METHOD(void, write, (std::uint32_t, std::uint16_t), (override));
    MOCK_METHOD(std::uint16_t, read, (std::uint32_t), (override));
};

class StillClock final : public Interrupt {
  public:
    bool wait(Duration timeout) override { return now_ += timeout, false; }
    void pass(Duration duration) override { now_ += duration; }
    Instant now() const override { return now_; }

  private:
    Instant now_{};
};

/// A card that is set up; after forbid_writing() a write is an error.
class DriverRejects : public testing::Test {
  protected:
    void set_up() {
        EXPECT_TRUE(driver_.SetMultiple(axis_x | axis_y | axis_z, 10));
        EXPECT_TRUE(driver_.SetSV(axis_x, 10));
    }
    /// Makes every later write an error. RR0 reads as `main`, every other register as 0.
    void forbid_writing(std::uint16_t main = 0) {
        testing::Mock::VerifyAndClearExpectations(&port_);
        EXPECT_CALL(port_, write(_, _)).Times(0);
        ON_CALL(port_, read(_)).WillByDefault(Return(std::uint16_t{0}));
        ON_CALL(port_, read(reg::RR0)).WillByDefault(Return(main));
    }
    template <class T>
    void expect_refused(const Result<T>& result, const std::string& part) {
        ASSERT_FALSE(result) << part;
        EXPECT_EQ(result.error().kind, ErrorKind::refused);
        EXPECT_THAT(result.error().message, HasSubstr(part));
        EXPECT_THAT(result.error().message, testing::AnyOf(HasSubstr("Nothing was"), HasSubstr("was not changed")));
    }

    NiceMock<MockPort> port_;
    StillClock clock_;
    Driver driver_{port_, clock_};
};

struct Ranged {
    const char* name;
    std::function<Result<void>(Driver&, unsigned, std::int64_t)> call;
    std::int64_t min, max;
};

const std::vector<Ranged>& ranged() {
    static const std::vector<Ranged> table = {
        {"SetMultiple", [](Driver& d, unsigned a, std::int64_t n) { return d.SetMultiple(a, n); }, 1, 500},
        {"SetRange", [](Driver& d, unsigned a, std::int64_t n) { return d.SetRange(a, n); }, 16'000, 8'000'000},
        {"SetMaxSpeed", [](Driver& d, unsigned a, std::int64_t n) { return d.SetMaxSpeed(a, n); }, 1, 4'000'000},
        {"SetSV", [](Driver& d, unsigned a, std::int64_t n) { return d.SetSV(a, n); }, 1, 8'000},
        {"SetV", [](Driver& d, unsigned a, std::int64_t n) { return d.SetV(a, n); }, 1, 8'000},
        {"SetA", [](Driver& d, unsigned a, std::int64_t n) { return d.SetA(a, n); }, 1, 8'000},
        {"SetD", [](Driver& d, unsigned a, std::int64_t n) { return d.SetD(a, n); }, 1, 8'000},
        {"SetAA", [](Driver& d, unsigned a, std::int64_t n) { return d.SetAA(a, n); }, 1, 65'535},
        {"SetAO", [](Driver& d, unsigned a, std::int64_t n) { return d.SetAO(a, n); }, 0, 65'535},
        {"Pulse", [](Driver& d, unsigned a, std::int64_t n) { return d.Pulse(a, n); }, -268'435'455, 268'435'455},
        {"ManualDec", [](Driver& d, unsigned a, std::int64_t n) { return d.ManualDec(a, n); }, 0, 268'435'455},
        {"SetDecPoint", [](Driver& d, unsigned a, std::int64_t n) { return d.SetDecPoint(a, n); }, 0, 268'435'455},
        {"WriteRange", [](Driver& d, unsigned a, std::int64_t n) { return d.WriteRange(a, n); }, 16'000, 13'856'407},
        {"SetFP", [](Driver& d, unsigned a, std::int64_t n) { return d.SetFP(a, n); }, -8'388'608, 8'388'607},
        {"SetCP", [](Driver& d, unsigned a, std::int64_t n) { return d.SetCP(a, n); }, -8'388'608, 8'388'607},
        {"LPS", [](Driver& d, unsigned a, std::int64_t n) { return d.LPS(a, n); }, -2'147'483'648LL, 2'147'483'647LL},
        {"EPS", [](Driver& d, unsigned a, std::int64_t n) { return d.EPS(a, n); }, -2'147'483'648LL, 2'147'483'647LL},
        {"SetCompP", [](Driver& d, unsigned a, std::int64_t n) { return d.SetCompP(a, n); }, -2'147'483'648LL,
         2'147'483'647LL},
        {"SetCompM", [](Driver& d, unsigned a, std::int64_t n) { return d.SetCompM(a, n); }, -2'147'483'648LL,
         2'147'483'647LL},
    };
    return table;
}

TEST_F(DriverRejects, NumbersOutsideTheirRangeWithTheRangeInTheSentence) {
    set_up();
    forbid_writing();
    for (const Ranged& one : ranged()) {
        SCOPED_TRACE(one.name);
        for (const std::int64_t wrong : {one.min - 1, one.max + 1, std::numeric_limits<std::int64_t>::min(),
                                         std::numeric_limits<std::int64_t>::max()}) {
            const Result<void> result = one.call(driver_, axis_x, wrong);
            expect_refused(result, std::to_string(wrong));
            expect_refused(result, std::to_string(one.max));
        }
    }
}

TEST_F(DriverRejects, EndsOfTheRangesAreAccepted) {
    for (const Ranged& one : ranged())
        for (const std::int64_t right : {one.min, one.max})
            EXPECT_TRUE(one.call(driver_, xyzu, right)) << one.name << ' ' << right;
}

TEST_F(DriverRejects, AxisMasksThatNameNoAxes) {
    set_up();
    forbid_writing();
    for (const unsigned axes : {0u, 16u, 17u, 0xFFFFFFFFu}) {
        for (const Ranged& one : ranged()) expect_refused(one.call(driver_, axes, one.max), "X is 1, Y 2, Z 4, U 8");
        expect_refused(driver_.TCurve_F(axes, 1, 1, 1, 1), "X is 1, Y 2, Z 4, U 8");
        expect_refused(driver_.wait_until_stopped(axes, milliseconds(1)), "X is 1, Y 2, Z 4, U 8");
        expect_refused(driver_.wait_until_done(axes, milliseconds(1)), "X is 1, Y 2, Z 4, U 8");
        expect_refused(driver_.stop(axes, StopKind::quick), "X is 1, Y 2, Z 4, U 8");
        expect_refused(driver_.HLMTP(1, axes), "X is 1, Y 2, Z 4, U 8");
        expect_refused(driver_.SetOutput(axes, 1, true), "X is 1, Y 2, Z 4, U 8");
        expect_refused(driver_.Line2D_C({1, 1, 1, 0, 0, {1, 1, 1, 1}}, axes), "X is 1, Y 2, Z 4, U 8");
    }
}

TEST_F(DriverRejects, AxesThatDoNotExist) {
    set_up();
    forbid_writing();
    for (const int axis : {-1, 4, 32, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
        const std::string reported = "the axis is " + std::to_string(axis) + "; it must be one of 0 X, 1 Y, 2 Z, 3 U";
        expect_refused(driver_.change_pulses(axis, 100), reported);
        const Finish ends[] = {{0, 1, 1}, {axis, 1, 1}};
        expect_refused(driver_.Line(ends, 2), reported);
        expect_refused(driver_.Arc(ends, false), reported);
        const std::int64_t away[] = {1};
        expect_refused(home(driver_, axis, {}), reported);
        expect_refused(repeat_home(driver_, axis, {}, 1, away), reported);
        Manual manual(driver_, axis);
        expect_refused(manual.set({}), reported);
        expect_refused(manual.jog(1, clock_.now()), reported);
        expect_refused(manual.step_jog(0, 1), reported);
        expect_refused(manual.home({}, clock_.now()), reported);
        RealAxis real(driver_, axis, {200}, {400});
        expect_refused(real.set({1, 1, 1}), reported);
        expect_refused(real.move_to(1), "Call set first");
        expect_refused(real.change_distance(1), reported);
        expect_refused(real.set_position(1), reported);
        expect_refused(real.speed(), reported);
    }
}

struct Whole {
    std::function<Result<void>(Driver&)> call;
    const char* part;
};

TEST_F(DriverRejects, CurvesWithOneWrongNumber) {
    set_up();
    forbid_writing();
    const std::vector<Whole> calls = {
        {[](Driver& d) { return d.TCurve_F(3, 0, 100, 100, 10); }, "initial speed SV of XY is 0; it must be 1 to 8000"},
        {[](Driver& d) { return d.TCurve_F(3, 1, 8'001, 100, 10); },
         "drive speed V of XY is 8001; it must be 1 to 8000"},
        {[](Driver& d) { return d.TCurve_F(3, 1, 100, -5, 10); }, "acceleration A of XY is -5; it must be 1 to 8000"},
        {[](Driver& d) { return d.TCurve_F(3, 1, 100, 5, 268'435'456); },
         "268435456; it must be -268435455 to 268435455"},
        {[](Driver& d) { return d.SCurve_F(3, 1, 100, 5, 0, 10); }, "rate K of XY is 0; it must be 1 to 65535"},
        {[](Driver& d) { return d.SCurve_C(3, 1, 100, 5, 65'536); }, "rate K of XY is 65536; it must be 1 to 65535"},
        {[](Driver& d) { return d.TCurve_C(3, 1, 0, 5); }, "drive speed V of XY is 0; it must be 1 to 8000"},
        {[](Driver& d) { return d.TCurve_F(9, 1, 100, 5, 10); }, "the multiple of U is not set"},
        {[](Driver& d) { return d.DriveFixed(axis_x); }, "The drive speed V of X is not set"},
    };
    for (const Whole& one : calls) expect_refused(one.call(driver_), one.part);
}

TEST_F(DriverRejects, ImpossibleLinesAndArcs) {
    set_up();
    forbid_writing();
    const std::vector<Whole> calls = {
        {[](Driver& d) {
             return d.Line2D_T({1, 100, 5, 0, 0, {1, 1}}, 0x7);
         },
         "must name two axes: xy 3, xz 5"},
        {[](Driver& d) {
             return d.Line3D_T({1, 100, 5, 0, 0, {1, 1}}, 0x3);
         },
         "must name three axes: xyz 7"},
        {[](Driver& d) {
             return d.Line2D_T({1, 100, 5, 0, 0, {1, 8'388'608}}, 0x3);
         },
         "of Y is 8388608; it must be -8388608 to"},
        {[](Driver& d) {
             return d.Line3D_C({0, 100, 0, 0, 0, {1, 1, -8'388'609}}, 0x7);
         },
         "of Z is -8388609"},
        {[](Driver& d) {
             return d.Line2D_T({1, 100, 5, 0, 0, {0, 0, 9, 9}}, 0x3);
         },
         "every finish point of XY is 0"},
        {[](Driver& d) {
             return d.Line2D_S({1, 100, 5, 0, 0, {1, 1}}, 0x3);
         },
         "rate K of X is 0"},
        {[](Driver& d) {
             return d.Line2D_T({1, 100, 5, 9'000, 0, {1, 1}}, 0x3);
         },
         "deceleration D of X is 9000"},
        {[](Driver& d) {
             return d.CircleCW_C({0, 100, 0, 0, {1, 1}, {}}, 0x3);
         },
         "the radius is 0"},
        {[](Driver& d) {
             return d.CircleCW_T({1, 100, 0, 0, {10, 0}, {5, 0}}, 0x3);
         },
         "acceleration A of X is 0"},
        {[](Driver& d) {
             return d.CircleCCW_C({0, 100, 0, 0, {10, 0}, {5, 9'000'000}}, 0x3);
         },
         "centre C of Y is 9000000"},
        // The finish point is not on the circle.
        {[](Driver& d) {
             return d.CircleCW_C({0, 100, 0, 0, {10'000, 20'000}, {5'000, 0}}, 0x3);
         },
         "20615.5 pulses from the centre"},
        {[](Driver& d) {
             return d.ContLine(0x3, {1, 1});
         },
         "no chain is open"},
        {[](Driver& d) { return d.BPStack({}); }, "no pattern is open"},
        {[](Driver& d) { return d.BPStart(); }, "no pattern with data is open"},
        {[](Driver& d) {
             return d.BP3D({1, 100, 0, 0}, 0x3);
         },
         "must name three axes"},
        {[](Driver& d) {
             return d.BP2D({1, 0, 0, 0}, 0x3);
         },
         "drive speed V of X is 0"},
        {[](Driver& d) { return d.Step(); }, "does not step by command"},
        {[](Driver& d) { return d.SetVectorSpeed(4); }, "1 (off), 2 or 3"},
        {[](Driver& d) { return d.set_arc_tolerance(std::numeric_limits<double>::quiet_NaN()); }, "0 to 1"},
    };
    for (const Whole& one : calls) {
        const Result<void> result = one.call(driver_);
        ASSERT_FALSE(result) << one.part;
        EXPECT_THAT(result.error().message, HasSubstr(one.part));
    }
}

TEST_F(DriverRejects, SwitchesOtherThanTheirPositions) {
    set_up();
    forbid_writing();
    using Call = Result<void> (Driver::*)(int, unsigned);
    for (const Call call :
         {&Driver::HLMTP, &Driver::HLMTM, &Driver::HLMTSig, &Driver::SLMTP, &Driver::SLMTM, &Driver::SLMTSig,
          &Driver::EncoderMode, &Driver::EnableALM, &Driver::EnableInPos, &Driver::ALMSig, &Driver::InPosSig})
        for (const int n : {-1, 2, 255}) expect_refused((driver_.*call)(n, axis_x), "it must be 0 to 1");
    expect_refused(driver_.EncoderCWCCW(3, axis_x), "it must be 0 to 2");
    expect_refused(driver_.SetPulseMode(axis_x, 2), "it must be 0 to 1");
    expect_refused(driver_.SetStopInput(axis_x, 4, StopInput::at_low), "it must be 0 to 3");
    expect_refused(driver_.SetOutput(axis_x, 8, true), "it must be 0 to 7");
    expect_refused(driver_.EnableInterrupt(axis_x, 0x0100), "are not bits 0 to 7");
}

TEST_F(DriverRejects, CommandsThatNeedAnAxisAtStandstill) {
    set_up();
    EXPECT_TRUE(driver_.ContStart({0, 100, 0, 0}));
    EXPECT_TRUE(driver_.SetV(axis_x, 1));
    EXPECT_TRUE(driver_.SetA(axis_x, 1));
    EXPECT_TRUE(driver_.Pulse(axis_x, 1));
    forbid_writing(0x0001);
    const std::vector<std::function<Result<void>(Driver&)>> calls = {
        [](Driver& d) { return d.SetRange(800'000); },
        [](Driver& d) { return d.SetMultiple(axis_x, 2); },
        [](Driver& d) { return d.SetMaxSpeed(100); },
        [](Driver& d) { return d.SetPulseMode(axis_x, 1); },
        [](Driver& d) { return d.SetPulseLevels(axis_x, true, true); },
        [](Driver& d) { return d.TCurve_F(7, 1, 2, 3, 4); },
        [](Driver& d) { return d.TCurve_C(1, 1, 2, 3); },
        [](Driver& d) { return d.SCurve_F(1, 1, 2, 3, 4, 5); },
        [](Driver& d) { return d.DriveFixed(1); },
        [](Driver& d) {
            return d.Line2D_C({0, 100, 0, 0, 0, {1, 1}}, 0x3);
        },
        [](Driver& d) {
            return d.Line3D_T({1, 100, 5, 0, 0, {1, 1, 1}}, 0x7);
        },
        [](Driver& d) {
            return d.CircleCW_T({1, 100, 5, 0, {10, 0}, {5, 0}}, 0x3);
        },
        [](Driver& d) {
            return d.BP2D({0, 100, 0, 0}, 0x3);
        },
        [](Driver& d) {
            return d.ContLine(0x3, {1, 1});
        },
    };
    for (const auto& call : calls) expect_refused(call(driver_), "X is driving");
}

TEST_F(DriverRejects, ASecondInterpolationAtATime) {
    EXPECT_TRUE(driver_.SetMultiple(xyzu, 10));
    EXPECT_TRUE(driver_.ContStart({0, 100, 0, 0}));
    forbid_writing(0x0103);  // X and Y are interpolated
    expect_refused(driver_.Line2D_T({1, 100, 5, 0, 0, {0, 0, 9, 9}}, 0xC), "an interpolation runs");
    expect_refused(driver_.CircleCW_C({0, 100, 0, 0, {0, 0, 10, 0}, {0, 0, 5, 0}}, 0xC), "an interpolation runs");
    expect_refused(driver_.BP2D({0, 100, 0, 0}, 0xC), "an interpolation runs");
    expect_refused(driver_.ContLine(0xC, {0, 0, 9, 9}), "an interpolation runs");
}

TEST_F(DriverRejects, SpeedAndTargetChangesAtStandstill) {
    set_up();
    forbid_writing();
    expect_refused(driver_.change_speed(axis_x, 100), "X stands");
    expect_refused(driver_.change_pulses(0, 100), "X stands");
    expect_refused(driver_.change_speed(axis_x, 0), "1 to 8000");
}

TEST_F(DriverRejects, ContinuousInterpolationAboveItsSpeed) {
    EXPECT_TRUE(driver_.SetMultiple(xyzu, 500));
    EXPECT_TRUE(driver_.ContStart({1, 4'001, 10, 0}));
    forbid_writing();
    expect_refused(driver_.ContLine(0x3, {1, 1}), "at most 2000000");
}

TEST_F(DriverRejects, RealValuesThatTheChipDoesNotReach) {
    RealAxis axis(driver_, 0, {200});
    forbid_writing();
    expect_refused(axis.move(1), "Call set first");
    expect_refused(axis.set({20'001, 1, 1}), "20000 units/s");
    expect_refused(axis.set({1, 1, 2.6e6}), "2.5e+06 units/s2");
    for (const double wrong :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        expect_refused(axis.set({wrong, 1, 1}), "more than 0");
        expect_refused(axis.set({1, wrong, 1}), "more than 0");
        expect_refused(axis.set({1, 1, wrong}), "more than 0");
    }
    expect_refused(axis.set({1, 1, 1, -1}), "deceleration");
    expect_refused(real_setting({0}, {1, 1, 1}), "scale");
    expect_refused(to_pulses({200}, 1e9), "at most 2147483647");
}

/// Calls with arbitrary arguments are either executed, or refused without a write.
TEST_F(DriverRejects, RejectedCallsWriteNothingWhateverTheArguments) {
    set_up();
    int writes = 0;
    ON_CALL(port_, write(_, _)).WillByDefault([&writes](std::uint32_t, std::uint16_t) { ++writes; });
    const auto number =
        rc::gen::oneOf(rc::gen::arbitrary<std::int64_t>(), rc::gen::inRange<std::int64_t>(-9'000, 9'000));
    EXPECT_TRUE(rc::check([&] {
        const auto axes = static_cast<unsigned>(*rc::gen::inRange(0, 20));
        std::array<std::int64_t, 6> n{};
        for (std::int64_t& one : n) one = *number;
        auto quiet = [&](const Result<void>& result, int before) {
            if (!result) RC_ASSERT(writes == before);
        };
        int before = writes;
        quiet(driver_.TCurve_F(axes, n[0], n[1], n[2], n[3]), before);
        before = writes;
        quiet(driver_.SCurve_F(axes, n[0], n[1], n[2], n[3], n[4]), before);
        before = writes;
        quiet(driver_.Line2D_T({n[0], n[1], n[2], 0, 0, {n[3], n[4]}}, axes), before);
        before = writes;
        quiet(driver_.CircleCW_T({n[0], n[1], n[2], 0, {n[3] % 20'000, n[4] % 20'000}, {n[5] % 10'000, 0}}, axes),
              before);
        before = writes;
        quiet(driver_.Pulse(axes, n[5]), before);
    }));
}

}  // namespace
}  // namespace motionrack::mcx314
