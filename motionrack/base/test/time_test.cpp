#include <gtest/gtest.h>

#include <limits>
#include <motionrack/base/time.hpp>

namespace motionrack {
namespace {

TEST(Time, SecondsAreRoundedToTheNearestTick) {
    EXPECT_EQ(from_seconds(0), Duration{0});
    EXPECT_EQ(from_seconds(1.5), Duration{15'000'000'000});
    EXPECT_EQ(from_seconds(0.6e-10), Duration{1});
    EXPECT_EQ(from_seconds(-0.6e-10), Duration{-1});
    EXPECT_EQ(from_seconds(9.2e8), Duration{9'200'000'000'000'000'000});
}

TEST(Time, SecondsBeyondItsRangeAreNever) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    for (const double seconds : {9.3e8, 1e300, endless, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(from_seconds(seconds), never) << seconds;
    for (const double seconds : {-9.3e8, -1e300, -endless}) EXPECT_EQ(from_seconds(seconds), -never) << seconds;
}

}  // namespace
}  // namespace motionrack
