// The limits of a segment hold everywhere on it, for every axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/path/junction.hpp>
#include <motionrack/control/trajectory/segment_limits.hpp>
#include <motionrack/control/trajectory/subdivide.hpp>
#include <random>

namespace motionrack::control {
namespace {

class RandomPieces {
  public:
    double between(double min, double max) { return std::uniform_real_distribution<>(min, max)(random_); }
    /// Returns a random segment like one of a corner blend, straight or with a curvature that may change its sign.
    CubicSegment next() {
        CubicSegment piece;
        piece.begin = between(0, 100);
        piece.length = between(1e-3, 3);
        piece.feed = between(1, 400);
        piece.jerk_share = random_() % 4 == 0 ? 0.5 : 1;
        const double bent = random_() % 5 == 0 ? 0 : 1 / between(0.1, 50);
        for (std::size_t i = 0; i < 3; ++i) {
            piece.start[i] = between(-10, 10);
            piece.tangent[i] = between(-1, 1);
            piece.curvature[i] = bent * between(-1, 1);
            piece.curvature_rate[i] = bent * between(-1, 1) / piece.length;
        }
        return piece;
    }
    MachineLimits machine() {
        MachineLimits limits;
        for (AxisLimits& axis : limits)
            axis = {true, -1e9, 1e9, between(50, 400), between(200, 5000), between(5e3, 1e6), 0, 1000};
        return limits;
    }

  private:
    std::mt19937 random_{20261123};
};

TEST(SegmentLimits, KeepEveryAxisWithinItsLimitsOnTheWholeSegment) {
    RandomPieces random;
    for (int run = 0; run < 3000; ++run) {
        const CubicSegment piece = random.next();
        const MachineLimits machine = random.machine();
        const SegmentLimits limits(piece, machine);
        const double top = random.between(0.05, 1) * limits.max_velocity_for(0.97);
        const LimitInterval span = limits.up_to(top, piece.length);
        ASSERT_GT(std::min({span.velocity, span.accel, span.brake, span.jerk}), 0) << run;
        for (int k = 0; k < 40; ++k) {
            const double x = piece.length * random.between(0, 1), v = top * random.between(0, 1),
                         j = random.between(-span.jerk, span.jerk);
            const double a = k % 2 == 0 ? span.accel : -span.brake;
            const Point tangent = tangent_on(piece, x), curvature = curvature_on(piece, x);
            for (std::size_t i = 0; i < 3; ++i) {
                ASSERT_LE(std::fabs(tangent[i] * v), machine[i].max_velocity * (1 + 1e-9)) << run;
                ASSERT_LE(std::fabs(tangent[i] * a + curvature[i] * v * v), machine[i].max_accel * (1 + 1e-9)) << run;
                ASSERT_LE(std::fabs(tangent[i] * j + 3 * curvature[i] * v * a + piece.curvature_rate[i] * v * v * v),
                          piece.jerk_share * machine[i].max_jerk * (1 + 1e-9))
                    << run;
            }
        }
    }
}

/// Full acceleration over the length leads to velocity2_after(); full deceleration leads down from velocity2_before().
TEST(SegmentLimits, GiveTheReachableVelocityWithTheRemainingAcceleration) {
    RandomPieces random;
    int looked = 0;
    for (int run = 0; run < 1000; ++run) {
        const CubicSegment piece = random.next();
        MachineLimits machine = random.machine();
        for (AxisLimits& axis : machine) axis.max_jerk = 1e12;
        const SegmentLimits limits(piece, machine);
        const double from = random.between(0, 0.9) * limits.velocity * limits.velocity, length = 1e-3 * piece.length;
        const double after = limits.velocity2_after(from, length), before = limits.velocity2_before(from, length);
        if (std::max(after, before) > limits.velocity * limits.velocity) continue;
        EXPECT_NEAR(after, from + 2 * length * limits.up_to(std::sqrt(after), length).accel, 1e-9 * after) << run;
        EXPECT_NEAR(before, from + 2 * length * limits.up_to(std::sqrt(before), length).brake, 1e-9 * before) << run;
        ++looked;
    }
    EXPECT_GT(looked, 500);
}

TEST(Parts, OfASegmentMatchTheSegment) {
    RandomPieces random;
    int cut = 0;
    for (int run = 0; run < 500; ++run) {
        const CubicSegment piece = random.next();
        double end = piece.begin;
        int count = 0;
        for_each_subsegment(piece, random.machine(), [&](const CubicSegment& part) {
            ++count;
            EXPECT_NEAR(part.begin, end, 1e-12 * end);
            end = part.begin + part.length;
            for (const double x : {0.0, 0.5 * part.length, part.length})
                for (std::size_t i = 0; i < 3; ++i) {
                    EXPECT_NEAR(position_on(part, x)[i], position_on(piece, part.begin - piece.begin + x)[i], 1e-9);
                    EXPECT_NEAR(tangent_on(part, x)[i], tangent_on(piece, part.begin - piece.begin + x)[i], 1e-9);
                }
        });
        EXPECT_NEAR(end, piece.begin + piece.length, 1e-12 * end);
        EXPECT_TRUE(count == 1 || !is_straight(piece));
        cut += count > 1;
    }
    EXPECT_GT(cut, 100);
}

}  // namespace
}  // namespace motionrack::control
