// Tests of the causes of stops: the four stop inputs, alarm, limits in both stop modes, and their latched flags.
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

// A drive that has reached 20,000 pulses a second from 1,000.
class Fast : public Bench {
  public:
    explicit Fast(unsigned axis = X) {
        start();
        speeds(axis, 800'000, 100, 2000, 2000);
        command(axis, cmd::CONTINUOUS_PLUS);
        advance(milliseconds(100));
    }
};

TEST(ChipStops, EachStopInputHasItsActiveLevelStopKindAndStatusBit) {
    for (int n = 0; n < 4; ++n)
        for (const int active : {0, 1})
            for (const bool ramp : {true, false}) {
                Bench b;
                b.start();
                const std::string pin = "yin" + std::to_string(n);
                b.wire(pin, 1 - active);
                b.speeds(Y, 800'000, ramp ? 100 : 2000, 2000, 2000);
                b.mode(Y, 1, static_cast<unsigned>(2 + active) << (2 * n));
                b.command(Y, cmd::CONTINUOUS_PLUS);
                b.advance(milliseconds(100));
                b.wire(pin, active);
                b.advance(tick);
                EXPECT_EQ((b.read(0) & Y) != 0, ramp) << "decelerating where it accelerated, else at once; input " << n;
                EXPECT_EQ(field("RR1", "DSND").test(b.status(Y, 1)), ramp);
                b.wire(pin, 1 - active);  // too late to have an effect
                ASSERT_TRUE(b.finish(Y));
                EXPECT_EQ(b.status(Y, 1) & 0xFF00u, 0x0100u << n);
            }
}

TEST(ChipStops, TheAlarmStopsAtOnceAtItsActiveLevelIfEnabled) {
    for (const int active : {0, 1}) {
        Fast b;
        b.wire("xalarm", 1 - active);
        b.mode(X, 2, active ? 0x1000 : 0x0000);
        b.wire("xalarm", active);
        b.advance(milliseconds(1));
        EXPECT_TRUE(b.read(0) & X) << "not enabled";
        EXPECT_FALSE(b.read(0) & X << 4);
        b.wire("xalarm", 1 - active);
        b.mode(X, 2, active ? 0x3000 : 0x2000);
        b.advance(milliseconds(1));
        EXPECT_TRUE(b.read(0) & X);
        b.wire("xalarm", active);
        b.advance(tick);
        EXPECT_FALSE(b.read(0) & X);
        EXPECT_EQ(b.status(X, 1) & 0xFF00u, 0x4000u);
        EXPECT_TRUE(field("RR2", "ALARM").test(b.status(X, 2)));
        b.wire("xalarm", 1 - active);
        EXPECT_FALSE(field("RR2", "ALARM").test(b.status(X, 2)));
        EXPECT_TRUE(b.read(0) & X << 4) << "RR1 remembers";
    }
}

TEST(ChipStops, ALimitStopsAtOnceOrDecelerating) {
    for (const bool decelerating : {false, true}) {
        Fast b;
        b.mode(X, 2, decelerating ? 0x0004 : 0x0000);
        b.wire("xlmtp", 0);
        b.advance(tick);
        EXPECT_EQ((b.read(0) & X) != 0, decelerating);
        const std::int64_t at = b.count(0);
        ASSERT_TRUE(b.finish(X));
        EXPECT_EQ(b.count(0) > at + 50, decelerating);
        EXPECT_EQ(b.status(X, 1) & 0xFF00u, 0x1000u);
    }
}

TEST(ChipStops, EveryStopCauseIsLatchedAtTheEndOfADriveAndClearedByTheNext) {
    Fast b;
    b.mode(X, 1, 0x0022);  // IN0, IN2, active Low
    b.wire("xin0", 0);
    b.advance(milliseconds(1));
    EXPECT_EQ(b.status(X, 1) & 0xFF00u, 0u) << "it still drives";
    b.wire("xin2", 0);
    b.advance(milliseconds(1));
    b.wire("xlmtp", 0);
    b.advance(tick);
    EXPECT_EQ(b.status(X, 1) & 0xFF00u, 0x1500u);
    b.wire("xin0", 1);
    b.wire("xin2", 1);
    b.wire("xlmtp", 1);
    b.data(X, cmd::P, 1);
    b.command(X, cmd::FIXED_MINUS);
    EXPECT_EQ(b.status(X, 1) & 0xFF00u, 0u);
}

TEST(ChipStops, ASlowDriveHasOneSpeedAndNoRamp) {
    Bench b;
    b.start();
    b.speeds(X, 800'000, 100, 50);
    b.data(X, cmd::P, 20);
    b.command(X, cmd::FIXED_PLUS);
    b.advance(milliseconds(20));
    EXPECT_EQ(b.cv(X), 50);
    EXPECT_TRUE(field("RR1", "CNST").test(b.status(X, 1)));
    b.data(X, cmd::V, 100);
    b.advance(milliseconds(5));
    EXPECT_EQ(b.cv(X), 100) << "V counts at once; up to SV it is still no ramp that a stop would need";
    b.command(X, cmd::SLOW_STOP);
    b.advance(tick);
    EXPECT_FALSE(b.read(0) & X);
}

}  // namespace
}  // namespace motionrack::mcx314::outside
