#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/base/numbers.hpp>

namespace motionrack {
namespace {

TEST(NumberOf, ParsesTheWholeTextOrReturnsNaN) {
    EXPECT_EQ(number_of("12.5"), 12.5);
    EXPECT_EQ(number_of("-1e-3"), -0.001);
    EXPECT_EQ(number_of("0"), 0);
    for (const char* none : {"", " 1", "1 ", "1,5", "1s", "+1", "0x10", "one"})
        EXPECT_TRUE(std::isnan(number_of(none))) << none;
}

}  // namespace
}  // namespace motionrack
