// Tests of the chip options for which the sources allow two readings: both must behave as documented.
#include <gtest/gtest.h>

#include <array>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

TEST(ChipReadings, ADriveSlowerThanSvRunsAtVOrAtSv) {
    for (const SlowDrive reading : {SlowDrive::at_v, SlowDrive::at_sv})
        for (const Variant variant : {Variant::mcx314, Variant::mcx314as}) {
            const int slow = reading == SlowDrive::at_v ? 50 : 100;
            Bench b({variant, reading});
            b.start();
            b.speeds(X, 800'000, 100, 50);
            b.data(X, 0x06, 10);
            b.command(X, 0x20);
            b.advance(milliseconds(2));
            EXPECT_EQ(b.cv(X), slow);
            ASSERT_TRUE(b.finish(X));
            EXPECT_EQ(b.count(0), 10);
            b.command(X, 0x22);
            b.data(X, 0x04, 40);  // V is now above SV
            b.advance(milliseconds(100));
            EXPECT_EQ(b.cv(X), 50);
            b.command(X, 0x26);
            EXPECT_TRUE(b.finish(X));
            EXPECT_EQ(b.chip.inspect("V", 0), 50) << "as it was written";
        }
}

TEST(ChipReadings, ASoftwareLimitActsBeyondCompPlusOrAtIt) {
    for (const SoftwareLimit reading : {SoftwareLimit::beyond, SoftwareLimit::at}) {
        Bench b({Variant::mcx314, SlowDrive::at_v, reading});
        b.start();
        b.speeds(X, 800'000, 100, 50);
        b.data(X, 0x0B, 20);
        b.data(X, 0x0C, -20);
        b.mode(X, 2, 0x0003);
        const int last = reading == SoftwareLimit::beyond ? 21 : 20;
        b.command(X, 0x22);
        ASSERT_TRUE(b.finish(X));
        EXPECT_EQ(b.count(0), last);
        EXPECT_EQ(b.status(X, 2) & 3u, 1u);
        b.command(X, 0x23);
        ASSERT_TRUE(b.finish(X));
        EXPECT_EQ(b.count(0), -21) << "the other end has one reading";
        EXPECT_EQ(b.status(X, 2) & 3u, 2u);
    }
}

TEST(ChipReadings, AoHasTheValueOfTheSettingUntilItIsWrittenAndAfterReset) {
    for (const std::uint16_t offset : std::array<std::uint16_t, 3>{0, 8, 500}) {
        Bench b({Variant::mcx314, SlowDrive::at_v, SoftwareLimit::beyond, offset});
        b.start();
        EXPECT_EQ(b.chip.inspect("AO", 0), offset);
        b.data(X, 0x0D, 7);
        b.write(0, 0x8000);
        EXPECT_EQ(b.chip.inspect("AO", 0), offset);
        b.data(X, 0x00, 800'000);
        b.data(X, 0x04, 100);
        b.data(X, 0x05, 4000);
        b.data(X, 0x02, 200);
        b.data(X, 0x06, 20'000);
        b.command(X, 0x20);
        const Instant from = b.kernel.now();
        ASSERT_TRUE(b.finish(X));
        EXPECT_EQ(b.count(0), 20'000);
        // 20,000 pulses with two ramps of 0.156 s; the last AO pulses are made at 1,000 pulses/s instead of 40,000.
        const double seconds = 0.156 * 2 + (20'000 - 6'396) / 40'000.0 + offset * (1 / 1'000.0 - 1 / 40'000.0);
        EXPECT_NEAR(static_cast<double>((b.kernel.now() - from) / microseconds(1)) * 1e-6, seconds, 0.002);
    }
}

}  // namespace
}  // namespace motionrack::mcx314::outside
