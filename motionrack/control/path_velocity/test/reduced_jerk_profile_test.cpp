// Velocity profiles of lines with reduced jerk at their ends.
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/control/path_velocity/reduced_jerk_profile.hpp>
#include <motionrack/control/path_velocity/velocity_planner.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

double seconds_of(std::span<const ProfileSegment> feed) {
    double seconds = 0;
    for (const ProfileSegment& piece : feed) seconds += piece.seconds;
    return seconds;
}

class LineWithReducedJerk : public testing::Test {
  protected:
    double between(double a, double b) {
        return a * std::exp(std::log(b / a) * std::uniform_real_distribution<>(0, 1)(random_));
    }

    /// Returns the intervals of a line with equal limits, except for a reduced jerk at one or both ends.
    std::vector<LimitInterval> intervals() {
        const double length = between(0.05, 100), velocity = between(5, 200), accel = between(200, 5000),
                     jerk = between(5e3, 1e6);
        std::vector<LimitInterval> out(3, {0, velocity, accel, jerk});
        for (const std::size_t end : {0u, 2u})
            out[end].length = length * between(1e-4, 0.3), out[end].jerk = jerk * between(0.1, 0.8);
        out[1].length = length - out[0].length - out[2].length;
        const auto kinds = random_() % 3;
        if (kinds == 1) out.pop_back();
        if (kinds == 2) out.erase(out.begin());
        return out;
    }

    std::mt19937 random_{7};
};

TEST_F(LineWithReducedJerk, KeepsAllLimitsWithoutStepsAndIsNotSlowerThanByCells) {
    int written = 0;
    for (int n = 0; n < 2000; ++n) {
        SCOPED_TRACE(n);
        const std::vector<LimitInterval> line = intervals();
        std::vector<ProfileSegment> feed;
        if (!write_reduced_jerk_profile(line, feed)) continue;
        ++written;
        double length = 0, end = line[0].length;
        for (const LimitInterval& interval : line) length += interval.length;
        PathMotion before;
        std::size_t at = 0;
        for (const ProfileSegment& piece : feed) {
            const double middle = piece.begin + 0.5 * piece.length;
            while (at + 1 < line.size() && middle > end) end += line[++at].length;
            const LimitInterval& limits = line[at];
            const PathMotion first = piece.at(0), last = piece.last();
            ASSERT_NEAR(first.u, before.u, 1e-9 * length);
            ASSERT_NEAR(first.velocity, before.velocity, 1e-7 * limits.velocity);
            ASSERT_NEAR(first.accel, before.accel, 1e-7 * limits.accel);
            ASSERT_LE(std::fabs(first.jerk), limits.jerk * (1 + 1e-9));
            ASSERT_LE(std::max(std::fabs(first.accel), std::fabs(last.accel)), limits.accel * (1 + 1e-9));
            ASSERT_LE(std::max(first.velocity, last.velocity), limits.velocity * (1 + 1e-9));
            before = last;
        }
        ASSERT_NEAR(before.u, length, 1e-9 * length);
        ASSERT_NEAR(before.velocity, 0, 1e-7);
        std::vector<LimitInterval> cut = line;  // an interval with other limits disables the special case
        cut.push_back(cut.back());
        cut.back().length = cut[cut.size() - 2].length *= 0.5;
        cut.insert(cut.begin(), cut.front());
        cut.front().length = cut[1].length *= 0.5;
        VelocityPlanner planner;
        ASSERT_LE(seconds_of(feed), seconds_of(planner.plan(cut)) * (1 + 1e-9));
    }
    EXPECT_GT(written, 1000);
}

TEST(ReducedJerkProfile, IsNotWrittenWhereItsEndsAreTooLongOrItsMiddleIsUnlike) {
    std::vector<ProfileSegment> feed;
    EXPECT_FALSE(write_reduced_jerk_profile(
        std::vector<LimitInterval>{{1, 1, 2000, 20'000}, {1, 1, 2000, 40'000}, {1, 1, 2000, 20'000}}, feed));
    EXPECT_FALSE(write_reduced_jerk_profile(
        std::vector<LimitInterval>{{0.1, 50, 2000, 20'000}, {1, 60, 2000, 40'000}, {0.1, 50, 2000, 20'000}}, feed));
    EXPECT_FALSE(write_reduced_jerk_profile(
        std::vector<LimitInterval>{{0.1, 50, 2000, 40'000}, {1, 50, 2000, 20'000}, {0.1, 50, 2000, 40'000}}, feed));
    EXPECT_TRUE(feed.empty());
}

}  // namespace
}  // namespace motionrack::control
