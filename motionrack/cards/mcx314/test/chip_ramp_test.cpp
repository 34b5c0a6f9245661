// Tests that ramps without observers, which the chip computes as one event, equal those with a listener for every
// pulse.
#include <gtest/gtest.h>

#include <iostream>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>
#include <motionrack/cards/mcx314/test/program.hpp>

namespace motionrack::mcx314::outside {
namespace {

struct RampDrive {
    std::int64_t range = 0, start_speed = 0, speed = 0, accel = 0, jerk = 0, pulses = 0;
    unsigned mode = 0;  // WR3
    unsigned code = 0;
    explicit RampDrive(twin::Random& random) {
        range = random.of({16'000, 80'000, 800'000, 8'000'000});
        start_speed = random.between(1, 600);
        speed = random.between(1, 8000);
        accel = random.of({1, 7, 100, 400, 1999, 8000});
        jerk = random.of({1, 13, 400, 9000});
        pulses = random.between(1, 40'000);
        mode = random.of({0u, 2u, 4u, 1u});
        code = random.of({0x20u, 0x21u, 0x22u, 0x30u, 0x33u});
        if (code == 0x33u) mode = 0;  // an arc has no S-curve
    }
    void start(Bench& b) const {
        b.write(5, 0x0004);  // AX1 X, AX2 Y
        b.speeds(X | Y, range, start_speed, speed, accel);
        b.data(X | Y, 0x01, jerk);
        b.mode(X | Y, 3, mode);
        b.data(X | Y, 0x07, pulses / 2);
        b.data(X, 0x06, code == 0x33u ? 0 : pulses);
        b.data(Y, 0x06, code == 0x33u ? 0 : pulses / 3);
        b.data(X, 0x08, pulses);
        b.data(Y, 0x08, 0);
        if (code == 0x30u) b.command(0, 0x3B);
        b.command(X, code);
    }
};

void expect_equal_looks(std::uint64_t seed, int drive) {
    twin::Random random(seed * 1000 + static_cast<std::uint64_t>(drive));
    const RampDrive d(random);
    Bench quiet, heard;
    EdgeLog log;
    for (Bench* b : {&quiet, &heard}) b->start();
    for (int a = 0; a < 2; ++a) heard.chip.pulses(a).set_edge_listener(&log);
    for (Bench* b : {&quiet, &heard}) d.start(*b);
    std::int64_t gap = random.of({3, 300, 30'000});
    for (int sample = 0; sample < 200; ++sample) {
        const Duration time = random.between(1, gap) * tick;
        for (Bench* b : {&quiet, &heard}) b->advance(time);
        if (sample == 150)
            for (Bench* b : {&quiet, &heard}) b->command(X, 0x26);
        ASSERT_EQ(quiet.count(0), heard.count(0)) << "look " << sample << " of drive " << drive;
        ASSERT_EQ(quiet.count(1), heard.count(1)) << "look " << sample << " of drive " << drive;
        for (const char* pin : {"xpp", "xpm", "ypp", "ypm"})
            ASSERT_EQ(quiet.level(pin), heard.level(pin)) << pin << " at look " << sample << " of drive " << drive;
        if (!random.one_in(5)) continue;
        ASSERT_EQ(quiet.cv(X), heard.cv(X)) << "look " << sample << " of drive " << drive;
        ASSERT_EQ(quiet.counter(X, 0x13), heard.counter(X, 0x13)) << "look " << sample << " of drive " << drive;
        ASSERT_EQ(quiet.status(X, 1), heard.status(X, 1)) << "look " << sample << " of drive " << drive;
        ASSERT_EQ(quiet.chip.pulses(0).rate(quiet.kernel.now()), heard.chip.pulses(0).rate(heard.kernel.now()));
    }
}

TEST(ChipRamps, QueriesAndListenersGetTheSameValues) {
    const std::uint64_t seed = 7;
    std::cout << "seed " << seed << std::endl;
    for (int drive = 0; drive < 400 && !testing::Test::HasFatalFailure(); ++drive) expect_equal_looks(seed, drive);
}

TEST(ChipRamps, ARampWithoutAListenerTakesFewEvents) {
    for (const unsigned mode : {0u, 4u}) {
        Bench b;
        b.start();
        b.speeds(X, 16'000, 200, 8000, 400);
        b.data(X, 0x01, 400);
        b.mode(X, 3, mode);
        b.data(X, 0x06, 4'500'000);
        const std::uint64_t before = b.kernel.events();
        b.command(X, 0x20);
        b.advance(whole_seconds(5));
        EXPECT_EQ(b.lp(X), 4'500'000);
        EXPECT_LT(b.kernel.events() - before, 100u) << "of 15,600 steps of the speed";
    }
}

}  // namespace
}  // namespace motionrack::mcx314::outside
