// Accuracy of the exponential and the logarithm.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <motionrack/base/exponential.hpp>
#include <random>

namespace motionrack {
namespace {

double ulps_of_exponential(double got, long double wanted) {
    const double near = static_cast<double>(wanted);
    const double ulp = std::nextafter(std::fabs(near), std::numeric_limits<double>::infinity()) - std::fabs(near);
    return static_cast<double>(std::fabs(static_cast<long double>(got) - wanted) / static_cast<long double>(ulp));
}

TEST(Exponential, IsWithinOneUlp) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> wide(-700, 700), narrow(-1, 1);
    double max_error = 0;
    for (int i = 0; i < 400'000; ++i) {
        const double x = i % 2 ? wide(random) : narrow(random);
        max_error = std::max(max_error, ulps_of_exponential(exponential(x), std::exp(static_cast<long double>(x))));
    }
    EXPECT_LT(max_error, 1.0);
    RecordProperty("worst_ulp_1000", static_cast<int>(max_error * 1000));
    EXPECT_EQ(exponential(0), 1.0);
    EXPECT_EQ(exponential(-1000), 0.0);
    EXPECT_EQ(exponential(-std::numeric_limits<double>::infinity()), 0.0);
    EXPECT_TRUE(std::isinf(exponential(1000)));
    EXPECT_TRUE(std::isnan(exponential(std::nan(""))));
}

TEST(NaturalLog, IsWithinItsErrors) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> wide(-700, 700), narrow(0.7, 1.4);
    for (int i = 0; i < 200'000; ++i) {
        const double x = std::exp(wide(random)), y = narrow(random);
        if (x < 0.7 || x > 1.4) {
            ASSERT_LT(ulps_of_exponential(natural_log(x), std::log(static_cast<long double>(x))), 1.5) << x;
        }
        ASSERT_LT(std::fabs(natural_log(y) - std::log(static_cast<long double>(y))), 2e-16L) << y;
    }
    EXPECT_EQ(natural_log(1), 0.0);
    EXPECT_TRUE(std::isinf(natural_log(0)));
    EXPECT_TRUE(std::isnan(natural_log(-1)));
}

}  // namespace
}  // namespace motionrack
