// Tests of drives of one axis through registers and pins: speeds, stops, status and interrupts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

// The sample of the maker: R = 800,000 (M = 10), A = D = 200, SV = 100, V = 4000 give 1,000 to 40,000 pulses/s in 0.156
// s, with 3,198 pulses in each ramp.
TEST(ChipDrive, ATrapezoidHasTheDocumentedRampAndExactlyItsPulses) {
    Bench b;
    EdgeLog log;
    b.start();
    b.chip.pulses(0).set_edge_listener(&log);
    b.speeds(X, 800'000, 100, 4000);
    b.data(X, 0x06, 80'000);
    const Instant from = b.kernel.now();
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.lp(X), 80'000);
    EXPECT_EQ(b.count(0), 80'000);
    ASSERT_EQ(log.list.size(), 80'000u);
    // 73,604 pulses at 40,000 pps lie between two ramps; ideally the drive takes 2.1521 s. During deceleration every
    // speed comes one step earlier than during acceleration, which saves the last pulse and a half.
    EXPECT_NEAR(to_seconds(b.kernel.now() - from), 2.1521, 0.002);
    const auto period = [&](std::size_t i) { return log.list[i].tick - log.list[i - 1].tick; };
    const auto of_ramp = [&](std::size_t from_pulse,
                             std::size_t to_pulse) {  // pulses not 200 ticks apart, with a jitter of one
        std::size_t pulses = 0;
        for (std::size_t i = from_pulse; i < to_pulse; ++i) pulses += period(i) > 201;
        return static_cast<double>(pulses);
    };
    EXPECT_NEAR(of_ramp(1, 40'000), 3198, 60);
    EXPECT_NEAR(of_ramp(40'000, 80'000), 3198, 60);
    EXPECT_EQ(period(40'000), 200);  // 8 MHz / 40 kHz
}

TEST(ChipDrive, TheStatusGoesThroughAccelerationConstantSpeedAndDeceleration) {
    Bench b;
    b.start();
    b.speeds(X, 800'000, 100, 4000);
    b.data(X, 0x06, 80'000);
    b.command(X, 0x20);
    EXPECT_EQ(b.cv(X), 100);
    b.advance(3 * tick);
    std::vector<unsigned> seen;
    std::int32_t before = 100;
    while (b.read(0) & X) {
        const unsigned now = b.status(X, 1) >> 2 & 7;
        const std::int32_t speed = b.cv(X);
        if (seen.empty() || seen.back() != now) seen.push_back(now);
        EXPECT_GE((speed - before) * (now == 4 ? -1 : 1), 0);
        EXPECT_EQ(speed == 4000, now == 2);
        before = speed;
        b.advance(microseconds(100));
    }
    EXPECT_EQ(seen, (std::vector<unsigned>{1, 2, 4}));
    EXPECT_LT(before, 150);  // with AO = 0 the last pulse comes shortly before SV is reached
    EXPECT_EQ(b.cv(X), 0);
}

TEST(ChipDrive, AShortDriveIsATriangleAndStillHasExactlyItsPulses) {
    for (const int pulses : {1, 2, 3, 7, 100, 999, 1000, 5001}) {
        Bench b;
        b.start();
        b.speeds(Y, 800'000, 100, 4000);
        b.data(Y, 0x06, pulses);
        b.command(Y, 0x21);
        ASSERT_TRUE(b.finish(Y));
        EXPECT_EQ(b.lp(Y), -pulses);
        EXPECT_EQ(b.count(1), -pulses);
    }
}

TEST(ChipDrive, AnSCurveReachesItsSpeedInTheComputedTime) {
    Bench b;
    b.start();
    b.speeds(X, 800'000, 100, 4000);
    b.data(X, 0x01, 1010);  // J = 618,812 pps/s2: 0.50209 s and 10,292.9 pulses up to 40,000 pps
    b.mode(X, 3, 0x0004);
    b.data(X, 0x06, 50'000);
    const Instant from = b.kernel.now();
    b.command(X, 0x20);
    while (b.cv(X) < 4000) b.advance(microseconds(100));
    EXPECT_NEAR(to_seconds(b.kernel.now() - from), 0.50209, 0.003);
    EXPECT_NEAR(static_cast<double>(b.count(0)), 10'292.9, 60);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.lp(X), 50'000);
}

TEST(ChipDrive, ANewSpeedAndANewTargetApplyDuringTheDrive) {
    Bench b;
    b.start();
    b.speeds(X, 80'000, 100, 1000);
    b.data(X, 0x06, 1'000'000);
    b.command(X, 0x20);
    b.advance(milliseconds(100));
    EXPECT_EQ(b.cv(X), 1000);
    b.data(X, 0x05, 2000);
    b.advance(milliseconds(100));
    EXPECT_EQ(b.cv(X), 2000);
    b.data(X, 0x06, 60'000);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.lp(X), 60'000);
}

// As in the maker's home search: a drive with V above SV decelerates at an input, one with V below SV stops at once.
TEST(ChipDrive, AnInputDeceleratesAFastDriveAndStopsASlowOneAtOnce) {
    Bench b;
    b.start();
    b.speeds(X, 800'000, 100, 2000);
    b.mode(X, 1, 0x0008);  // IN1, active Low
    b.command(X, 0x23);
    b.advance(milliseconds(500));
    b.wire("xin1", 0);
    const std::int64_t at = b.count(0);
    EXPECT_TRUE(b.read(0) & X);
    ASSERT_TRUE(b.finish(X, whole_seconds(1)));
    EXPECT_LT(b.count(0), at - 500);
    EXPECT_EQ(b.status(X, 1) & 0xFF00u, 0x0200u);

    b.mode(X, 1, 0x000C);  // active High
    b.data(X, 0x05, 50);
    b.command(X, 0x22);
    b.advance(milliseconds(100));
    EXPECT_EQ(b.cv(X), 50);
    b.wire("xin1", 1);
    const std::int64_t here = b.count(0);
    b.advance(tick);
    EXPECT_FALSE(b.read(0) & X);
    EXPECT_EQ(b.count(0), here);
}

TEST(ChipDrive, AnInputThatIsNotEnabledDoesNothing) {
    Bench b;
    b.start();
    b.speeds(X, 80'000, 1000, 1000);
    b.data(X, 0x06, 1000);
    b.command(X, 0x20);
    for (const char* pin : {"xin0", "xin1", "xin2", "xin3", "xalarm", "xinpos", "xexpp", "xexpm"}) b.wire(pin, 0);
    EXPECT_EQ(b.read(4) & 0xFFu, 0u);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.lp(X), 1000);
    EXPECT_EQ(b.read(0), 0u);
}

TEST(ChipDrive, ALimitStopsOnlyItsOwnDirectionAndIsRemembered) {
    Bench b;
    b.start();
    b.speeds(U, 80'000, 1000, 1000);
    b.command(U, 0x22);
    b.advance(milliseconds(1));
    b.wire("ulmtm", 0);
    b.advance(milliseconds(1));
    EXPECT_TRUE(b.read(0) & U);
    EXPECT_TRUE(b.read(0) & U << 4);  // RR0 shows the limit as an error nevertheless
    b.wire("ulmtp", 0);
    b.advance(tick);
    EXPECT_FALSE(b.read(0) & U);
    EXPECT_EQ(b.status(U, 1) & 0xFF00u, 0x1000u);
    EXPECT_EQ(b.status(U, 2), 0x000Cu);
    // A drive into the active limit makes no pulse.
    const std::int64_t at = b.count(3);
    b.command(U, 0x22);
    b.advance(milliseconds(1));
    EXPECT_FALSE(b.read(0) & U);
    EXPECT_EQ(b.count(3), at);
    // Command 25h clears the stored stop causes.
    b.wire("ulmtp", 1);
    b.wire("ulmtm", 1);
    EXPECT_TRUE(b.read(0) & U << 4);
    b.command(U, 0x25);
    EXPECT_EQ(b.read(0), 0u);
}

TEST(ChipDrive, TheEmergencyInputStopsEveryAxisAtOnce) {
    Bench b;
    b.start();
    b.speeds(X | Y | Z | U, 80'000, 1000, 5000);
    b.command(X | Y | Z | U, 0x22);
    b.advance(milliseconds(20));
    b.wire("emgn", 0);
    b.advance(tick);
    EXPECT_EQ(b.read(0) & 0xFu, 0u);
    for (const unsigned axis : {X, Y, Z, U}) EXPECT_TRUE(b.status(axis, 1) & 0x8000u);
}

TEST(ChipDrive, ASoftwareLimitDeceleratesAndAllowsTheOtherDirection) {
    Bench b;
    b.start();
    b.speeds(X, 80'000, 100, 1000, 2000);
    b.data(X, 0x0B, 10'000);
    b.data(X, 0x0C, -10);
    b.mode(X, 2, 0x0003);
    b.data(X, 0x06, 100'000);
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X));
    EXPECT_GT(b.lp(X), 10'000);
    EXPECT_LT(b.lp(X), 10'600);
    EXPECT_EQ(b.status(X, 2), 0x0001u);
    b.data(X, 0x06, 5000);
    const std::int32_t at = b.lp(X);
    b.command(X, 0x21);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.lp(X), at - 5000);
    EXPECT_EQ(b.status(X, 2), 0u);
}

TEST(ChipDrive, EveryInterruptComesAtItsOwnTickAndReadingClearsIt) {
    Bench b;
    EdgeLog log;
    b.start();
    b.chip.pulses(2).set_edge_listener(&log);
    b.speeds(Z, 80'000, 1000, 1000);
    b.data(Z, 0x0B, 5);
    b.mode(Z, 1, 0x9000);  // P >= C+, D-END
    b.data(Z, 0x06, 10);
    b.command(Z, 0x20);
    ASSERT_TRUE(b.wait(whole_seconds(1)));
    EXPECT_EQ(b.lp(Z), 5);
    EXPECT_EQ(b.kernel.now() % tick, Duration{0});
    const std::int64_t at = b.kernel.now() / tick;
    EXPECT_EQ(b.status(Z, 3), 0x0010u);
    EXPECT_FALSE(b.interrupt());
    EXPECT_EQ(b.read(3), 0u);
    ASSERT_TRUE(b.wait(whole_seconds(1)));
    EXPECT_EQ(b.status(Z, 3), 0x0080u);
    EXPECT_EQ(b.lp(Z), 10);
    ASSERT_EQ(log.list.size(), 10u);
    EXPECT_EQ(log.list[4].tick, at);
}

TEST(ChipDrive, RequestsAPulseInterruptAtEveryPulse) {
    Bench b;
    b.start();
    b.speeds(X, 80'000, 1000, 1000);
    b.mode(X, 1, 0x0100);
    b.data(X, 0x06, 20);
    b.command(X, 0x20);
    for (int i = 1; i <= 20; ++i) {
        ASSERT_TRUE(b.wait(whole_seconds(1)));
        EXPECT_EQ(b.lp(X), i);
        EXPECT_EQ(b.status(X, 3), 1u);
    }
    EXPECT_FALSE(b.read(0) & X);
}

TEST(ChipDrive, HeldDrivesStartTogether) {
    Bench b;
    EdgeLog x, y;
    b.start();
    b.chip.pulses(0).set_edge_listener(&x);
    b.chip.pulses(1).set_edge_listener(&y);
    b.speeds(X | Y, 80'000, 1000, 1000);
    b.data(X | Y, 0x06, 3);
    b.command(X | Y, 0x24);
    b.command(X, 0x20);
    b.advance(milliseconds(3));
    b.command(Y, 0x21);
    b.advance(milliseconds(3));
    EXPECT_EQ(b.read(0) & 3u, 0u);
    b.command(X | Y, 0x25);
    ASSERT_TRUE(b.finish(X | Y));
    b.advance(tick);
    ASSERT_EQ(x.list.size(), 3u);
    ASSERT_EQ(y.list.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(x.list[i].tick, y.list[i].tick);
    EXPECT_EQ(y.list[0].step, -1);
}

TEST(ChipDrive, TheDriveBitWaitsForInPosition) {
    Bench b;
    b.start();
    b.speeds(X, 80'000, 1000, 1000);
    b.mode(X, 2, 0x8000);
    b.data(X, 0x06, 5);
    b.command(X, 0x20);
    b.advance(milliseconds(5));
    EXPECT_EQ(b.lp(X), 5);
    EXPECT_TRUE(b.read(0) & X);
    b.wire("xinpos", 0);
    b.advance(tick);
    EXPECT_FALSE(b.read(0) & X);
    b.wire("xinpos", 1);
    EXPECT_FALSE(b.read(0) & X);
}

TEST(ChipDrive, ImpossibleCommandsAreReportedAndChangeNothing) {
    Bench b;
    b.start();
    b.speeds(X, 80'000, 1000, 1000);
    b.data(X, 0x06, 100);
    b.command(X, 0x20);
    b.command(X, 0x21);
    b.command(X, 0x62);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.lp(X), 100);
    const auto conditions = b.kernel.conditions();
    ASSERT_EQ(conditions.size(), 2u);
    EXPECT_NE(describe(conditions[0], "motion").find("21h was ignored because axis X is driving"), std::string::npos);
    EXPECT_NE(describe(conditions[1], "motion").find("command 62h"), std::string::npos);
}

TEST(ChipDrive, AResetStopsEverythingAndClearsTheRegisters) {
    Bench b;
    b.start();
    b.speeds(X, 80'000, 1000, 1000);
    b.mode(X, 1, 0x8000);
    b.write(4, 0xFFFF);
    EXPECT_EQ(b.level("uout3"), 1);
    b.command(X, 0x22);
    b.advance(milliseconds(2));
    const std::int64_t at = b.count(0);
    EXPECT_GT(at, 0);
    b.write(0, 0x8000);
    b.advance(milliseconds(2));
    EXPECT_EQ(b.read(0), 0u);
    EXPECT_EQ(b.lp(X), 0);
    EXPECT_EQ(b.count(0), at);  // the motor does not jump
    EXPECT_EQ(b.level("uout3"), 0);
    EXPECT_FALSE(b.interrupt());
}

TEST(ChipDrive, EventsAfterTheEndOfTimeDoNotBlockTheClock) {
    Bench b;
    b.start();
    b.data(X, 0x00, 16'000'000);  // a pulse in two seconds: LP would wrap after 136 years
    b.data(X, 0x04, 1);
    b.data(X, 0x05, 1);
    b.mode(X, 1, 0x1E00);
    b.command(X, 0x22);
    b.advance(whole_seconds(10));
    EXPECT_EQ(b.count(0), 4);
    EXPECT_LT(b.kernel.events(), 100u);
}

TEST(ChipDrive, OutOfRangeParametersAreUsedAtTheirLimits) {
    Bench b;
    b.start();
    b.speeds(X, 0, 0, 65'535, 0);
    b.data(X, 0x06, 100'000);
    b.command(X, 0x20);
    b.advance(milliseconds(100));
    EXPECT_EQ(b.cv(X), 13);  // with SV = 1 and A = 1 the speed rises by 1 in 64,000 ticks, which are 8 ms
    EXPECT_TRUE(b.read(0) & X);
}

}  // namespace
}  // namespace motionrack::mcx314::outside
