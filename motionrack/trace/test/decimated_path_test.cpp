// Decimation: series keep their extremes, paths stay within tolerance.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/trace/decimated_path.hpp>
#include <vector>

namespace motionrack::trace {
namespace {

RC_GTEST_PROP(ThinSeries, KeepsFirstLastLeastAndGreatest, (const std::vector<float>& drawn, std::uint8_t parts)) {
    std::vector<float> values;
    for (int copy = 0; copy < 20; ++copy) {
        for (const float v : drawn) values.push_back(v * static_cast<float>(copy + 1));
    }
    std::vector<double> seconds(values.size());
    for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i] = static_cast<double>(i);
    const std::size_t buckets = parts % 40U + 1;
    const auto kept = thin_series(seconds, values, buckets);
    std::vector<float> good, chosen;
    for (const float v : values) {
        if (std::isfinite(v)) good.push_back(v);
    }
    for (const std::size_t i : kept) chosen.push_back(values[i]);
    RC_ASSERT(std::is_sorted(kept.begin(), kept.end()));
    RC_ASSERT(std::adjacent_find(kept.begin(), kept.end()) == kept.end());
    RC_ASSERT(kept.size() <= 4 * buckets);
    RC_ASSERT(good.empty() == chosen.empty());
    if (good.empty()) return;
    RC_ASSERT(chosen.front() == good.front());
    RC_ASSERT(chosen.back() == good.back());
    RC_ASSERT(*std::max_element(chosen.begin(), chosen.end()) == *std::max_element(good.begin(), good.end()));
    RC_ASSERT(*std::min_element(chosen.begin(), chosen.end()) == *std::min_element(good.begin(), good.end()));
}

TEST(ThinSeries, OmitsNonFiniteValues) {
    const std::vector<double> seconds = {0, 1, std::numeric_limits<double>::quiet_NaN(), 3};
    const std::vector<float> values = {1, std::numeric_limits<float>::infinity(), 2, 3};
    EXPECT_EQ(thin_series(seconds, values, 10), (std::vector<std::size_t>{0, 3}));
}

std::vector<PathPoint> spiral(int count) {
    std::vector<PathPoint> points;
    for (int i = 0; i < count; ++i) {
        const double angle = i * 0.01;
        points.push_back({angle * std::cos(angle), angle * std::sin(angle), 0.1 * angle, 0});
    }
    return points;
}

TEST(ThinPath, OmitsOnlyPointsWithinTheTolerance) {
    const auto points = spiral(5000);
    const DecimatedPath path = thin_path(points, {}, 0.01, 100'000);
    EXPECT_EQ(path.within, 0.01);
    EXPECT_LT(path.kept.size(), 1500U);
    ASSERT_EQ(path.kept.front(), 0U);
    ASSERT_EQ(path.kept.back(), 4999U);
    for (std::size_t k = 1; k < path.kept.size(); ++k) {
        const PathPoint &a = points[path.kept[k - 1]], &b = points[path.kept[k]];
        for (std::size_t i = path.kept[k - 1]; i <= path.kept[k]; ++i) {
            double best = 1e9;
            for (int s = 0; s <= 200; ++s) {
                double sum = 0;
                for (std::size_t c = 0; c < 4; ++c) sum += std::pow(a[c] + (b[c] - a[c]) * s / 200 - points[i][c], 2);
                best = std::min(best, std::sqrt(sum));
            }
            ASSERT_LT(best, 0.0105);
        }
    }
}

TEST(ThinPath, KeepsFixedPointsUpToTheMaximumNumber) {
    const auto points = spiral(5000);
    std::vector<bool> fixed(points.size(), false);
    for (std::size_t i = 0; i < points.size(); i += 100) fixed[i] = true;
    const DecimatedPath path = thin_path(points, fixed, 1e9, 1000);
    for (std::size_t i = 0; i < points.size(); i += 100) {
        EXPECT_TRUE(std::binary_search(path.kept.begin(), path.kept.end(), i));
    }
    const DecimatedPath few = thin_path(points, fixed, 1e-9, 20);
    EXPECT_LE(few.kept.size(), 20U);
    EXPECT_EQ(few.kept.front(), 0U);
    EXPECT_EQ(few.kept.back(), 4999U);
}

}  // namespace
}  // namespace motionrack::trace
