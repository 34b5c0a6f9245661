// Tests of the MCX314As through its registers and pins: input filters, rings, inverted counters and pulses, triangle
// prevention, jerk and automatic deceleration of asymmetric ramps, the deviation counter clear pulse.
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

struct ChipAsHost : Bench {
    ChipAsHost() : Bench(Variant::mcx314as) {}
    void extension(unsigned axes, unsigned em6, unsigned em7 = 0) {
        data(axes, cmd::EM, std::int64_t{em7} << 16 | em6);
    }
};

constexpr unsigned filter_of_in2 = field("EM6", "FE1").mask, ring = field("EM6", "VRING").mask;

// ---- the variant

TEST(ChipAs, TheMcx314IgnoresItsCommandsAndReportsWhichChipHasThem) {
    Bench b;
    b.start();
    for (const unsigned code : {0x0Eu, 0x14u, 0x60u, 0x61u, 0x62u, 0x63u, 0x64u, 0x65u}) b.command(X, code);
    const auto conditions = b.kernel.conditions();
    ASSERT_EQ(conditions.size(), 8u);
    EXPECT_EQ(conditions[2].code, unknown_command);
    EXPECT_EQ(describe(conditions[2], "motion"),
              "motion: command 60h belongs to the MCX314As, and this is an MCX314; nothing was done; set variant = "
              "\"mcx314as\" for the card, or leave the command out");
    EXPECT_EQ(b.read(0), 0u);
}

// ---- input filters

TEST(ChipAs, AFilterDelaysByTheTablesValueAndRemovesShorterPulses) {
    for (unsigned fl = 0; fl < 8; ++fl) {
        const std::int64_t delay = map::filter_ticks[fl];
        ChipAsHost b;
        b.start();
        b.mode(X, 1, 0x0020);  // IN2 enabled, active Low
        b.extension(X, filter_of_in2 | fl << 13);
        b.speeds(X, 80'000, 100, 100);
        b.command(X, 0x22);
        b.advance(tick * 10 + tick / 2);
        b.wire("xin2", 0);
        b.advance(tick * delay);  // sampled `delay` times
        b.wire("xin2", 1);
        b.advance(tick * (2 * delay));
        EXPECT_EQ(b.read(0) & X, X) << "FL " << fl << ": a bounce of " << delay << " ticks stopped the drive";
        b.wire("xin2", 0);
        b.advance(tick * delay);
        EXPECT_EQ(b.read(0) & X, X) << "FL " << fl << ": earlier than " << delay << " ticks";
        EXPECT_NE(b.read(4) & 4u, 0u) << "RR4 shows the filtered level";
        b.advance(tick);
        EXPECT_EQ(b.read(0) & X, 0u) << "FL " << fl << ": later than " << delay << " ticks";
        EXPECT_NE(b.status(X, 1) & 0x0400u, 0u);
        EXPECT_EQ(b.read(4) & 4u, 0u);
    }
}

TEST(ChipAs, AnUnfilteredInputStopsInTheNextTick) {
    ChipAsHost b;
    b.start();
    b.mode(X, 1, 0x0020);
    b.extension(X, 0x1D00);  // all filters except that of IN2
    b.speeds(X, 80'000, 100, 100);
    b.command(X, 0x22);
    b.advance(tick * 10);
    b.wire("xin2", 0);
    b.advance(tick);
    EXPECT_EQ(b.read(0) & X, 0u);
}

TEST(ChipAs, TheEmergencyStopIsFilteredByXForAllAxes) {
    ChipAsHost b;
    b.start();
    b.extension(X, 0x0100);
    b.speeds(U, 80'000, 100, 100);
    b.command(U, 0x22);
    b.advance(tick * 10);
    b.wire("emgn", 0);
    b.advance(tick * 15);
    b.wire("emgn", 1);
    b.advance(tick * 20);
    EXPECT_EQ(b.read(0) & U, U);
    EXPECT_EQ(b.status(U, 2) & 0x20u, 0u);
    b.wire("emgn", 0);
    b.advance(tick * 17);
    EXPECT_EQ(b.read(0) & U, 0u);
    EXPECT_NE(b.status(U, 2) & 0x20u, 0u);
    b.wire("emgn", 1);
    b.extension(X, 0);  // no filter again: the level of the wire counts
    EXPECT_EQ(b.status(U, 2) & 0x20u, 0u);
}

TEST(ChipAs, AHandWheelDrivesAtEachOfItsCycles) {
    for (const Variant variant : {Variant::mcx314as, Variant::mcx314}) {
        Bench b(variant);
        b.start();
        b.speeds(X, 16'000, 8000, 8000);
        b.data(X, cmd::P, 3);
        b.mode(X, 3, 0x0018);
        const auto turn = [&b](int cycles, bool plus) {  // A leads B in plus direction
            for (int i = 0; i < cycles; ++i) {
                for (const int level : {0, 1}) {
                    b.wire(plus ? "xexpm" : "xexpp", level);
                    b.advance(microseconds(5));
                    b.wire(plus ? "xexpp" : "xexpm", level);
                    b.advance(microseconds(5));
                }
            }
        };
        turn(4, false);
        EXPECT_EQ(b.lp(X), variant == Variant::mcx314as ? 12 : 0);
        turn(1, true);
        EXPECT_EQ(b.lp(X), variant == Variant::mcx314as ? 9 : 0);
        b.wire("xexpp", 0);
        b.advance(microseconds(5));
        b.wire("xexpp", 1);  // a bounce of A while B is High counts up and down again
        b.advance(microseconds(5));
        EXPECT_EQ(b.lp(X), variant == Variant::mcx314as ? 9 : 0);
    }
}

// ---- counters

TEST(ChipAs, InARingTheCountersWrapFromTheMaximumToZeroAndBack) {
    ChipAsHost b;
    b.start();
    b.data(X, cmd::COMP_PLUS, 9);
    b.extension(X, ring);
    b.speeds(X, 16'000, 8000, 8000);
    std::int32_t expected = 0;
    for (const int pulses : {9, 1, 1, 25}) {
        b.data(X, cmd::P, pulses);
        b.command(X, 0x20);
        ASSERT_TRUE(b.finish(X));
        expected = (expected + pulses) % 10;
        EXPECT_EQ(b.lp(X), expected);
    }
    EXPECT_EQ(b.count(0), 36) << "the motor does not go round";
    b.data(X, cmd::P, 7);
    b.command(X, 0x21);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.lp(X), 9);
    b.data(X, cmd::LP, 123);
    EXPECT_EQ(b.lp(X), 3);
}

TEST(ChipAs, TheRingAppliesToAConnectedEncoder) {
    ChipAsHost b;
    HandWheel wheel;
    b.chip.connect_encoder(0, wheel);
    b.start();
    b.data(X, cmd::COMP_PLUS, 99);
    b.extension(X, ring);
    wheel.turn(99, b.kernel.now());
    EXPECT_EQ(b.ep(X), 99);
    wheel.turn(101, b.kernel.now());
    EXPECT_EQ(b.ep(X), 1);
    wheel.turn(-1, b.kernel.now());
    EXPECT_EQ(b.ep(X), 99);
    wheel.turn(-1001, b.kernel.now());
    EXPECT_EQ(b.ep(X), 99);
    b.data(X, cmd::COMP_PLUS, 49);  // in a smaller ring, 99 becomes 49
    EXPECT_EQ(b.ep(X), 49);
    wheel.turn(-1000, b.kernel.now());
    EXPECT_EQ(b.ep(X), 0);
    b.extension(X, 0);
    wheel.turn(-1001, b.kernel.now());
    EXPECT_EQ(b.ep(X), -1);
}

TEST(ChipAs, AnInterruptComesAtEachTurnOfTheRing) {
    ChipAsHost b;
    HandWheel wheel;
    b.chip.connect_encoder(0, wheel);
    b.start();
    b.data(X, cmd::COMP_PLUS, 9);
    b.data(X, cmd::COMP_MINUS, -1);
    b.extension(X, ring);
    b.mode(X, 2, 0x0020);  // the comparisons use EP
    b.mode(X, 1, 0x1000);  // P >= C+
    for (int turn = 1; turn <= 3; ++turn) {
        wheel.turn(10 * turn - 2, b.kernel.now());
        EXPECT_EQ(b.status(X, 3), 0u);
        wheel.turn(10 * turn, b.kernel.now());
        EXPECT_EQ(b.status(X, 3), 0x10u) << "turn " << turn;
    }
}

TEST(ChipAs, TheEncoderCanCountTheOtherWayRound) {
    ChipAsHost b;
    HandWheel wheel;
    b.chip.connect_encoder(0, wheel);
    b.start();
    wheel.turn(10, b.kernel.now());
    b.extension(X, field("EM6", "EPINV").mask);
    EXPECT_EQ(b.ep(X), 10);
    wheel.turn(14, b.kernel.now());
    EXPECT_EQ(b.ep(X), 6);
    const int lines[][2] = {{0, 1}, {0, 0}, {1, 0}};  // three steps upwards
    b.extension(Z, field("EM6", "EPINV").mask);
    for (const auto& line : lines) b.wire("zeca", line[0]), b.wire("zecb", line[1]);
    EXPECT_EQ(b.ep(Z), -3);
}

TEST(ChipAs, Input2ClearsTheEncoderCounterEachTimeItBecomesActive) {
    ChipAsHost b;
    HandWheel wheel;
    b.chip.connect_encoder(0, wheel);
    b.start();
    b.extension(X, field("EM6", "EPCLR").mask);
    wheel.turn(40, b.kernel.now());
    b.wire("xin2", 0);
    EXPECT_EQ(b.ep(X), 40) << "sampled at the next tick";
    b.advance(tick);
    EXPECT_EQ(b.ep(X), 0);
    wheel.turn(45, b.kernel.now());
    b.advance(tick * 10);
    EXPECT_EQ(b.ep(X), 5);
    b.wire("xin2", 1);
    b.advance(tick * 10);
    EXPECT_EQ(b.ep(X), 5);
    b.wire("xin2", 0);
    b.advance(tick);
    EXPECT_EQ(b.ep(X), 0);
}

// ---- pulses and ramps

TEST(ChipAs, ThePulseOutputsCanBeExchanged) {
    ChipAsHost b;
    WireLog log(b.kernel);
    Follower follower(b.kernel);
    for (const char* wire : {"c.xpp", "c.xpm"}) follower.listen(wire);
    b.start();
    b.extension(X, field("EM6", "POINV").mask);
    for (const char* wire : {"c.xpp", "c.xpm"}) follower.follow(wire, true);
    b.speeds(X, 16'000, 1000, 1000);
    b.data(X, cmd::P, 3);
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X));
    b.advance(microseconds(10));
    EXPECT_EQ(log.of("c.xpp").size(), 0u);
    EXPECT_EQ(log.of("c.xpm").size(), 6u);
    EXPECT_EQ(b.lp(X), 3);
}

// Maximum speed (CV) of a fixed drive, and the number of its pulses at that speed.
struct Top {
    std::int32_t speed = 0;
    std::int64_t pulses = 0;
};
Top drive_and_watch(Bench& b, std::int64_t pulses) {
    b.data(X, cmd::P, pulses);
    b.command(X, 0x20);
    Top top;
    std::int64_t from = 0;
    while ((b.read(0) & X) != 0) {
        const std::int32_t speed = b.cv(X);
        const std::int64_t count = b.count(0);
        if (speed > top.speed) top = {speed, 0}, from = count;
        if (speed == top.speed) top.pulses = count - from;
        b.advance(microseconds(5));
    }
    return top;
}

TEST(ChipAs, TrianglePreventionGivesHalfThePulsesToConstantSpeed) {
    for (const bool prevented : {false, true}) {
        ChipAsHost b;
        b.start();
        b.speeds(X, 80'000, 100, 8000, 1000);
        b.extension(X, prevented ? field("EM6", "AVTRI").mask : 0u);
        const Top top = drive_and_watch(b, 4000);
        EXPECT_EQ(b.count(0), 4000);
        if (prevented) {
            EXPECT_NEAR(static_cast<double>(top.pulses), 2000, 40);
            // A quarter of the pulses, 1000, accelerates, in V units: V2 = SV2 + 2 * 125 * A * 1000 / M.
            EXPECT_NEAR(top.speed, 1584, 10);
        } else {
            EXPECT_LT(top.pulses, 100);
            EXPECT_NEAR(top.speed, 2238, 10);
        }
    }
}

TEST(ChipAs, TheDriveAfterAPreventedTriangleReachesVAgain) {
    ChipAsHost b;
    b.start();
    b.speeds(X, 80'000, 100, 3000, 1000);
    b.extension(X, field("EM6", "AVTRI").mask);
    EXPECT_LT(drive_and_watch(b, 4000).speed, 2000);
    EXPECT_EQ(drive_and_watch(b, 40'000).speed, 3000);
}

// Final speed of a drive of 60,000 pulses with D other than A, and the duration of its creep at the start speed.
struct End {
    std::int32_t speed = 0;
    std::int64_t creeping_us = 0;
};
End end_of_asymmetric_drive(Variant variant, int a, int d) {
    Bench b(variant);
    b.start();
    b.speeds(X, 80'000, 100, 4000, a);
    b.data(X, cmd::D, d);
    b.mode(X, 3, 0x0002);  // DSNDE
    b.data(X, cmd::P, 60'000);
    b.command(X, 0x20);
    End end;
    while ((b.read(0) & X) != 0) {
        end.speed = b.cv(X);
        if (end.speed == 100 && b.count(0) > 30'000) end.creeping_us += 10;
        b.advance(microseconds(10));
    }
    EXPECT_EQ(b.count(0), 60'000);
    return end;
}

TEST(ChipAs, AsymmetricRampsDecelerateByThemselvesToTheStartSpeed) {
    for (const auto& [a, d] : {std::pair{800, 200}, std::pair{200, 800}, std::pair{777, 333}}) {
        const End end = end_of_asymmetric_drive(Variant::mcx314as, a, d);
        EXPECT_LE(end.speed, 140) << "A " << a << ", D " << d << ": it stopped from high speed";
        EXPECT_LT(end.creeping_us, 3000) << "A " << a << ", D " << d;
    }
    EXPECT_GT(end_of_asymmetric_drive(Variant::mcx314, 800, 200).speed, 3000) << "the original reckons with A";
}

TEST(ChipAs, TheDecelerationOfAnSCurveHasItsOwnJerk) {
    const auto falling_time = [](Variant variant, std::int64_t l) {
        Bench b(variant);
        b.start();
        b.speeds(X, 80'000, 100, 2000, 8000);
        b.data(X, cmd::K, 100);
        if (variant == Variant::mcx314as) b.data(X, cmd::L, l);
        b.mode(X, 3, 0x0006);  // S-curve, DSNDE
        b.command(X, 0x22);
        b.advance(milliseconds(400));
        EXPECT_EQ(b.cv(X), 2000);
        b.command(X, 0x26);
        const Instant from = b.kernel.now();
        while ((b.read(0) & X) != 0) b.advance(microseconds(50));
        return static_cast<double>((b.kernel.now() - from).count());
    };
    const double original = falling_time(Variant::mcx314, 0);
    EXPECT_NEAR(falling_time(Variant::mcx314as, 100) / original, 1, 0.001);
    EXPECT_NEAR(falling_time(Variant::mcx314as, 400) / original, 2, 0.01)
        << "a quarter of the jerk takes twice the time";
}

// ---- the pin nDRIVE

TEST(ChipAs, NDriveShowsADriveUnlessItGivesTheClearPulse) {
    for (const bool followed : {false, true}) {
        ChipAsHost b;
        WireLog log(b.kernel);
        Follower follower(b.kernel);
        follower.listen("c.ydrive");
        b.start();
        if (followed) follower.follow("c.ydrive", true);
        b.speeds(Y, 16'000, 1000, 1000);
        b.data(Y, cmd::P, 2);
        b.command(Y, 0x20);
        b.kernel.settle();
        EXPECT_EQ(b.level("ydrive"), 1);
        b.advance(tick * 34);
        EXPECT_EQ(b.level("ydrive"), 0);
        for (unsigned width = 0; width < 8; ++width) {
            const std::int64_t ticks = map::clear_ticks[width];
            b.extension(Y, 0, 0x0800 | width << 13);
            b.command(Y, cmd::DCC);
            b.kernel.settle();
            EXPECT_EQ(b.level("ydrive"), 1);
            b.advance(tick * (ticks - 1));
            EXPECT_EQ(b.level("ydrive"), 1);
            b.advance(tick);
            EXPECT_EQ(b.level("ydrive"), 0) << "width " << width;
            b.extension(Y, 0, 0x1800 | width << 13);  // Low pulses
            EXPECT_EQ(b.level("ydrive"), 1);
            b.command(Y, cmd::DCC);
            b.kernel.settle();
            EXPECT_EQ(b.level("ydrive"), 0);
            b.advance(tick * ticks);
            EXPECT_EQ(b.level("ydrive"), 1);
        }
        b.extension(Y, 0);
        b.command(Y, cmd::DCC);
        EXPECT_EQ(b.level("ydrive"), 0) << "without DCCE there is no pulse";
        if (followed) {
            EXPECT_GT(log.of("c.ydrive").size(), 30u);
        }
    }
}

}  // namespace
}  // namespace motionrack::mcx314::outside
