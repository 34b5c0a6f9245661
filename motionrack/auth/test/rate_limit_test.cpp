// Token buckets, at times set by the test.
#include <gtest/gtest.h>

#include <motionrack/auth/rate_limit.hpp>
#include <string>

namespace motionrack::auth {
namespace {

using namespace std::chrono_literals;

TEST(RateLimit, AllowsABurstAndThenARatePerSecond) {
    RateLimit limit(3, 2);
    RateLimit::Time now{};
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(limit.take("a", now));
    EXPECT_FALSE(limit.take("a", now));
    EXPECT_TRUE(limit.take("b", now)) << "each has its own";
    now += 500ms;
    EXPECT_TRUE(limit.there_is("a", now));
    EXPECT_TRUE(limit.take("a", now));
    EXPECT_FALSE(limit.there_is("a", now));
    now += 1h;
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(limit.take("a", now)) << "never more than at first";
    EXPECT_FALSE(limit.take("a", now));
}

TEST(RateLimit, AllowsNothingMoreWhenTheClockGoesBack) {
    RateLimit limit(1, 1);
    RateLimit::Time now{1h};
    EXPECT_TRUE(limit.take("a", now));
    EXPECT_FALSE(limit.take("a", now - 30min));
    EXPECT_FALSE(limit.take("a", now));
}

TEST(RateLimit, LimitsItsKeysAndRemovesFullBucketsFirst) {
    RateLimit limit(1, 1, 100);
    RateLimit::Time now{};
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(limit.take(std::to_string(i), now));
    EXPECT_TRUE(limit.take("new", now));
    EXPECT_FALSE(limit.take("newer", now)) << "those that are too many share one bucket";
    EXPECT_LE(limit.keys(), 101u);
    now += 2s;
    EXPECT_TRUE(limit.take("newest", now));
    EXPECT_EQ(limit.keys(), 1u);
}

}  // namespace
}  // namespace motionrack::auth
