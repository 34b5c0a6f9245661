// Velocity profiles: properties at every instant, distance from the optimum, and continuity.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <motionrack/control/path_velocity/velocity_planner.hpp>
#include <motionrack/control/rest_profiles.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

/// Random intervals: every number between its bounds, evenly distributed over the orders of magnitude.
class RandomSpans {
  public:
    explicit RandomSpans(unsigned seed) : random_(seed) {}
    /// Returns 1 .. `max_count` intervals. `brakes_alike`: deceleration has the same limit as acceleration.
    std::vector<LimitInterval> next(int max_count, bool brakes_alike = true) {
        std::vector<LimitInterval> out(1 + random_() % static_cast<unsigned>(max_count));
        for (LimitInterval& interval : out)
            interval = {between(1e-4, 100), between(0.1, 300), between(10, 1e4), between(1e3, 1e6)};
        if (!brakes_alike)
            for (LimitInterval& interval : out) interval.brake = between(10, 1e4);
        return out;
    }
    double between(double min, double max) {
        return min * std::exp(std::log(max / min) * std::uniform_real_distribution<>(0, 1)(random_));
    }

  private:
    std::mt19937 random_;
};

double length_of(const std::vector<LimitInterval>& intervals) {
    double length = 0;
    for (const LimitInterval& interval : intervals) length += interval.length;
    return length;
}

double seconds_of_feed(std::span<const ProfileSegment> pieces) {
    double seconds = 0;
    for (const ProfileSegment& piece : pieces) seconds += piece.seconds;
    return seconds;
}

/// Highest used share of each limit, and largest relative step between segments (`jump`), over a whole profile.
struct FeedPeaks {
    double velocity = 0, accel = 0, jerk = 0, jump = 0;
};
FeedPeaks peaks_of(std::span<const ProfileSegment> pieces, const std::vector<LimitInterval>& intervals) {
    FeedPeaks out;
    const double length = length_of(intervals);
    PathMotion last;
    const auto jump = [&](const PathMotion& state) {
        out.jump = std::max({out.jump, std::fabs(state.u - last.u) / length,
                             std::fabs(state.velocity - last.velocity) / (state.velocity + last.velocity + 1e-6),
                             std::fabs(state.accel - last.accel) / intervals.front().accel});
    };
    std::size_t k = 0;
    double end = intervals.front().length;
    for (const ProfileSegment& piece : pieces) {
        for (int i = 0; i <= 6; ++i) {
            const PathMotion state = piece.at(piece.seconds * i / 6);
            if (i == 0) jump(state);
            while (k + 1 < intervals.size() && state.u > end + 1e-10 * length) end += intervals[++k].length;
            // Where two intervals meet, the limits of either one apply.
            LimitInterval interval = intervals[k];
            if (k + 1 < intervals.size() && state.u > end - 1e-10 * length)
                interval = {0, std::max(interval.velocity, intervals[k + 1].velocity),
                            std::max(interval.accel, intervals[k + 1].accel),
                            std::max(interval.jerk, intervals[k + 1].jerk),
                            std::max(interval.brake, intervals[k + 1].brake)};
            out.velocity = std::max(out.velocity, state.velocity / interval.velocity);
            out.accel = std::max({out.accel, state.accel / interval.accel, -state.accel / interval.brake});
            out.jerk = std::max(out.jerk, std::fabs(state.jerk) / interval.jerk);
            last = state;
        }
    }
    jump({length, 0, 0, 0});
    return out;
}

TEST(VelocityPlanner, PlansTheFastestSCurveForEqualIntervals) {
    VelocityPlanner planner;
    for (const double length : {1000.0, 100.0, 20.0, 5.0, 1.0, 0.1, 0.001})
        for (const double velocity : {100.0, 5.0}) {
            const std::vector<LimitInterval> intervals = {{0.3 * length, velocity, 1000, 20'000},
                                                          {0.7 * length, velocity, 1000, 20'000}};
            const auto pieces = planner.plan(intervals);
            EXPECT_NEAR(seconds_of_feed(pieces) / SCurveProfile(length, velocity, 1000, 20'000).duration(), 1, 1e-12)
                << length;
            const FeedPeaks peaks = peaks_of(pieces, intervals);
            EXPECT_LE(std::max({peaks.velocity, peaks.accel, peaks.jerk}), 1 + 1e-9) << length;
            EXPECT_LE(peaks.jump, 1e-9) << length;
        }
}

/// The distance over which the jerk acts may be shorter than the resolution of the positions beside it.
TEST(VelocityPlanner, KeepsTheJerkOfAnIntervalHoweverShort) {
    VelocityPlanner planner;
    for (const double jerk : {1e9, 1e12, 1e15}) {
        const std::vector<LimitInterval> intervals = {{92, 50, 1000, jerk}};
        const auto pieces = planner.plan(intervals);
        EXPECT_NEAR(seconds_of_feed(pieces) / SCurveProfile(92, 50, 1000, jerk).duration(), 1, 1e-12) << jerk;
        const FeedPeaks peaks = peaks_of(pieces, intervals);
        EXPECT_LE(std::max({peaks.velocity, peaks.accel, peaks.jerk}), 1 + 1e-9) << jerk;
        EXPECT_LE(peaks.jump, 1e-8) << jerk;  // rounding errors of 50 mm/s, relative to velocities near 0
        for (const ProfileSegment& piece : pieces) EXPECT_GT(piece.length, 0) << jerk;
    }
}

TEST(VelocityPlanner, IsNearlyAsFastForNearlyEqualIntervals) {
    VelocityPlanner planner;
    for (const double length : {1000.0, 100.0, 20.0, 5.0, 1.0, 0.1, 0.001}) {
        const std::vector<LimitInterval> intervals = {{0.5 * length, 100, 1000, 20'000},
                                                      {0.5 * length, 100.000001, 1000, 20'000}};
        const double min_duration = SCurveProfile(length, 100, 1000, 20'000).duration();
        const double seconds = seconds_of_feed(planner.plan(intervals));
        EXPECT_GE(seconds, min_duration * (1 - 1e-6)) << length;
        EXPECT_LE(seconds, min_duration * 1.01) << length;
    }
}

TEST(VelocityPlanner, KeepsEveryLimitAtEveryInstant) {
    VelocityPlanner planner;
    RandomSpans random(20261122);
    for (int run = 0; run < 3000; ++run) {
        const std::vector<LimitInterval> intervals = random.next(12, run % 2 == 0);
        const FeedPeaks peaks = peaks_of(planner.plan(intervals), intervals);
        ASSERT_LE(peaks.velocity, 1 + 1e-6) << run;
        ASSERT_LE(peaks.accel, 1 + 1e-6) << run;
        ASSERT_LE(peaks.jerk, 1 + 1e-6) << run;
        ASSERT_LE(peaks.jump, 1e-6) << run;
    }
}

/// Acceleration and deceleration have separate limits.
TEST(VelocityPlanner, UsesTheFullAccelerationAndDeceleration) {
    VelocityPlanner planner;
    const std::vector<LimitInterval> intervals = {{100, 1e4, 1000, 1e9, 4000}, {100, 1e4, 1000, 1e9, 4000}};
    double up = 0, down = 0;
    for (const ProfileSegment& piece : planner.plan(intervals)) {
        up = std::max(up, piece.at(0).accel);
        down = std::min(down, piece.at(0).accel);
    }
    EXPECT_NEAR(up, 1000, 1e-3);
    EXPECT_NEAR(down, -4000, 1e-3);
    const double peak = std::sqrt(200 / (1.0 / 2000 + 1.0 / 8000));
    EXPECT_NEAR(seconds_of_feed(planner.plan(intervals)), peak / 1000 + peak / 4000, 1e-3);
}

/// A stop may be faster than passing a slow interval, because it needs no velocity for leaving it.
TEST(VelocityPlanner, IsFasterThanStoppingBetweenIntervals) {
    VelocityPlanner planner;
    RandomSpans random(7);
    int slower = 0;
    for (int run = 0; run < 1000; ++run) {
        const std::vector<LimitInterval> intervals = random.next(6);
        double stopping = 0;
        for (const LimitInterval& interval : intervals)
            stopping += SCurveProfile(interval.length, interval.velocity, interval.accel, interval.jerk).duration();
        const double seconds = seconds_of_feed(planner.plan(intervals));
        ASSERT_LE(seconds, 1.5 * stopping) << run;
        slower += seconds > 1.01 * stopping;
    }
    EXPECT_LT(slower, 60);
}

TEST(VelocityPlanner, PassesASlowIntervalAtItsVelocity) {
    VelocityPlanner planner;
    const std::vector<LimitInterval> intervals = {
        {50, 100, 1000, 20'000}, {2, 20, 1000, 20'000}, {50, 100, 1000, 20'000}};
    double min_velocity = 100, peak_velocity = 0;
    for (const ProfileSegment& piece : planner.plan(intervals)) {
        const PathMotion state = piece.at(0);
        if (state.u > 50.2 && state.u < 51.8) min_velocity = std::min(min_velocity, state.velocity);
        peak_velocity = std::max(peak_velocity, state.velocity);
    }
    EXPECT_NEAR(min_velocity, 20, 1e-6);
    EXPECT_NEAR(peak_velocity, 100, 1e-6);
}

/// A slalom: the velocity limit from its curvature rises and falls, and the profile follows it.
TEST(VelocityPlanner, FollowsLimitsThatChangeSlowly) {
    VelocityPlanner planner;
    std::vector<LimitInterval> intervals;
    double min_seconds = 0;
    for (int i = 0; i < 20'000; ++i) {
        const double velocity = 100 + 50 * std::sin(i * 0.002);
        intervals.push_back({0.1, velocity, 2000, 100'000});
        min_seconds += 0.1 / velocity;
    }
    const double ends = 2 * (SCurveProfile(1000, 100, 2000, 100'000).duration() - 10);
    EXPECT_LE(seconds_of_feed(planner.plan(intervals)), 1.003 * min_seconds + ends);
}

TEST(VelocityPlanner, DoesNotDependOnEarlierPlans) {
    VelocityPlanner used, fresh;
    RandomSpans random(3);
    for (int run = 0; run < 50; ++run) {
        const std::vector<LimitInterval> intervals = random.next(9);
        fresh = VelocityPlanner();
        const auto a = used.plan(intervals), b = fresh.plan(intervals);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            ASSERT_EQ(a[i].velocity2, b[i].velocity2);
            ASSERT_EQ(a[i].seconds, b[i].seconds);
        }
    }
}

TEST(VelocityPlanner, AcceptsLimitsOfAnySize) {
    VelocityPlanner planner;
    RandomSpans random(11);
    for (int run = 0; run < 2000; ++run) {
        std::vector<LimitInterval> intervals(1 + run % 5);
        for (LimitInterval& interval : intervals)
            interval = {random.between(1e-9, 1e4), random.between(1e-6, 1e6), random.between(1e-3, 1e7),
                        random.between(1e-3, 1e10)};
        for (LimitInterval& interval : intervals)
            interval.brake = run % 2 == 0 ? interval.accel : random.between(1e-3, 1e7);
        const auto pieces = planner.plan(intervals);
        const double seconds = seconds_of_feed(pieces);
        ASSERT_TRUE(seconds > 0 && seconds < 1e12) << run << ": " << seconds;
        ASSERT_LT(pieces.size(), 2500U) << run;
        for (const ProfileSegment& piece : pieces) ASSERT_TRUE(piece.seconds >= 0) << run;
    }
}

TEST(VelocityPlanner, HasTheSameBitsOnEveryCompilerAndCpu) {
    std::vector<LimitInterval> intervals;
    for (int i = 0; i < 300; ++i)
        intervals.push_back(
            {0.05 + 0.3 * (i % 7), 10.0 + i * 37 % 90, 500.0 + i * 13 % 700, 9000.0 + i * 101 % 20'000});
    std::uint64_t fold = 0;
    VelocityPlanner planner;
    for (const ProfileSegment& piece : planner.plan(intervals))
        for (const double value : {piece.begin, piece.length, piece.seconds, piece.velocity2, piece.velocity2_slope,
                                   piece.velocity2_curvature, piece.jerk, piece.at(0.3 * piece.seconds).u})
            fold = (fold ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u;
    EXPECT_EQ(fold, 713957576561859831u);
}

TEST(VelocityPlanner, MakesNoSegmentsWithoutIntervals) {
    VelocityPlanner planner;
    EXPECT_TRUE(planner.plan({}).empty());
}

TEST(ProfileSegment, HasItsStatedLengthAndFollowsItsVelocity2) {
    const ProfileSegment cell = parabolic_segment(5, 2, 100, 30, 8);
    EXPECT_NEAR(cell.at(0).velocity, 10, 1e-12);
    EXPECT_NEAR(cell.at(cell.seconds).u, 7, 1e-12);
    EXPECT_NEAR(cell.at(cell.seconds).velocity, std::sqrt(100 + 60 + 16), 1e-12);
    const double time = 0.3 * cell.seconds, step = 1e-5;
    const auto before = cell.at(time - step), here = cell.at(time), after = cell.at(time + step);
    EXPECT_NEAR((after.u - before.u) / (2 * step), here.velocity, 1e-6);
    EXPECT_NEAR((after.velocity - before.velocity) / (2 * step), here.accel, 1e-6);
    EXPECT_NEAR((after.accel - before.accel) / (2 * step), here.jerk, 1e-6);
}

/// Returns the remaining intervals from a position on.
std::vector<LimitInterval> intervals_from(const std::vector<LimitInterval>& intervals, double place) {
    std::vector<LimitInterval> out;
    double end = 0;
    for (LimitInterval interval : intervals) {
        end += interval.length;
        if (end <= place) continue;
        interval.length = std::min(interval.length, end - place);
        out.push_back(interval);
    }
    return out;
}

TEST(VelocityPlannerReplan, StartsFromTheGivenMotionAndKeepsTheLimits) {
    VelocityPlanner planner, on_the_way;
    RandomSpans random(77);
    int steady = 0, steady_found = 0, found = 0, all = 0;
    for (int n = 0; n < 1500; ++n) {
        std::vector<LimitInterval> intervals = random.next(20);
        for (LimitInterval& interval : intervals)
            interval = {random.between(0.05, 30), random.between(5, 150), random.between(200, 3000),
                        random.between(5e3, 1e5)};
        const std::span<const ProfileSegment> plan = planner.plan(intervals);
        double time = random.between(0.02, 0.9) * seconds_of_feed(plan), left = seconds_of_feed(plan) - time;
        std::size_t k = 0;
        while (time > plan[k].seconds) time -= plan[k++].seconds;
        const PathMotion state = plan[k].at(time);
        const std::vector<LimitInterval> rest = intervals_from(intervals, state.u);
        const std::span<const ProfileSegment> next =
            on_the_way.plan_from({state.velocity * state.velocity, 2 * state.accel}, rest);
        const bool is_steady = state.accel > -1 && state.jerk > -1;
        ++all;
        steady += is_steady;
        if (next.empty()) continue;
        ++found;
        steady_found += is_steady;
        const PathMotion first = next[0].at(0);
        EXPECT_NEAR(first.velocity, state.velocity, 1e-9 * state.velocity);
        EXPECT_NEAR(first.accel, state.accel, 1e-6 * rest[0].accel);
        const FeedPeaks peaks = peaks_of(next, rest);
        EXPECT_LE(peaks.velocity, 1 + 1e-6);
        EXPECT_LE(peaks.accel, 1 + 1e-6);
        EXPECT_LE(peaks.jerk, 1 + 1e-6);
        EXPECT_LE(seconds_of_feed(next), 1.1 * left);
    }
    EXPECT_GT(steady_found, 0.99 * steady);
    EXPECT_GT(found, 0.85 * all);
}

TEST(VelocityPlannerReplan, FailsIfItCannotStopInTime) {
    VelocityPlanner planner;
    const std::vector<LimitInterval> intervals = {{0.2, 10, 1000, 20'000}};
    EXPECT_TRUE(planner.plan_from({100, 0}, intervals).empty());  // stopping from 10 mm/s needs 0.2236 mm
    EXPECT_FALSE(planner.plan_from({100, 0}, std::vector<LimitInterval>{{0.3, 10, 1000, 20'000}}).empty());
    EXPECT_TRUE(planner.plan_from({101, 0}, std::vector<LimitInterval>{{50, 10, 1000, 20'000}})
                    .empty());  // starts above the velocity limit
}

TEST(Cell, WithAVelocityMinimumInsideHasTheCorrectDuration) {
    const ProfileSegment cell = parabolic_segment(0, 1, 4, -7, 14);  // velocity2 has its minimum 2.25 in the middle
    EXPECT_NEAR(cell.at(cell.seconds).u, 1, 1e-12);
    EXPECT_NEAR(cell.at(cell.seconds).velocity, 2, 1e-9);
    EXPECT_GT(cell.seconds, 0.5);
}

}  // namespace
}  // namespace motionrack::control
