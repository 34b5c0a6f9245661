// Lines, arcs, helices and rotary moves: lengths, positions, tangents and distances.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/geometry.hpp>
#include <random>

namespace motionrack::control {
namespace {

Move line(const Point& end) {
    Move move;
    move.kind = MoveKind::feed;
    move.end = end;
    return move;
}

Move arc_xy(const Point& end, double centre_x, double centre_y, int turns) {
    Move move = line(end);
    move.kind = MoveKind::arc;
    move.centre_first = centre_x;
    move.centre_second = centre_y;
    move.turns = turns;
    return move;
}

/// A random arc or helix in any plane, with its start.
struct RandomArc {
    Move move;
    Point start{};
};

RandomArc random_arc(std::uint64_t seed, bool helix) {
    std::mt19937_64 random(seed);
    const auto between = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    RandomArc out;
    const int first = std::uniform_int_distribution<int>(0, 2)(random);
    const int second = (first + 1) % 3;
    const double radius = between(0.1, 100);
    const SinCos from = sin_cos(between(0, 6.28));
    const SinCos to = sin_cos(between(0, 6.28));
    out.move.kind = MoveKind::arc;
    out.move.first = static_cast<std::uint8_t>(first);
    out.move.second = static_cast<std::uint8_t>(second);
    out.move.centre_first = between(-50, 50);
    out.move.centre_second = between(-50, 50);
    out.move.turns = std::uniform_int_distribution<int>(1, 3)(random) * (between(0, 1) < 0.5 ? -1 : 1);
    for (int i = 0; i < axis_count; ++i) out.move.end[i] = out.start[i] = between(-20, 20);
    if (helix) out.move.end[(first + 2) % 3] += between(1, 30);
    out.start[first] = out.move.centre_first + radius * from.cos;
    out.start[second] = out.move.centre_second + radius * from.sin;
    out.move.end[first] = out.move.centre_first + radius * to.cos;
    out.move.end[second] = out.move.centre_second + radius * to.sin;
    return out;
}

double apart(const Point& a, const Point& b) {
    return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

TEST(Geometry, ALineHasTheLengthOfItsXyzPartAndCarriesTheRotaryAxes) {
    const Geometry path = geometry_of(line({3, 4, 0, 10, 0, 0}), {});
    EXPECT_EQ(path.shape, PathShape::line);
    EXPECT_DOUBLE_EQ(path.length, 5);
    EXPECT_DOUBLE_EQ(path.tangent_in[0], 0.6);
    EXPECT_DOUBLE_EQ(path.tangent_out[3], 2);  // degrees per mm
    EXPECT_DOUBLE_EQ(position_at(path, 2.5)[1], 2);
    EXPECT_DOUBLE_EQ(position_at(path, 2.5)[3], 5);
    EXPECT_EQ(position_at(path, 5), path.end);
    EXPECT_EQ(position_at(path, 7), path.end);
    EXPECT_EQ(position_at(path, -1), path.start);
    EXPECT_TRUE(std::isinf(curvature_radius(path)));
}

TEST(Geometry, TakesTheLargestRotationAsTheLengthOfARotaryMove) {
    const Geometry path = geometry_of(line({1, 2, 3, 10, -40, 0}), {1, 2, 3, 0, 0, 0});
    EXPECT_EQ(path.shape, PathShape::rotary);
    EXPECT_DOUBLE_EQ(path.length, 40);
    EXPECT_DOUBLE_EQ(path.tangent_in[4], -1);
    EXPECT_DOUBLE_EQ(path.tangent_in[3], 0.25);
    EXPECT_DOUBLE_EQ(distance_to(path, 1, 2, 5), 2);
}

TEST(Geometry, MovesWithoutDistanceHaveNoLength) {
    const Point at = {1, 2, 3, 4, 5, 6};
    EXPECT_EQ(geometry_of(line(at), at).shape, PathShape::nothing);
    EXPECT_EQ(geometry_of(line({1 + 1e-12, 2, 3, 4, 5, 6}), at).length, 0);
    Move dwell;
    dwell.kind = MoveKind::dwell;
    EXPECT_EQ(geometry_of(dwell, at).shape, PathShape::nothing);
    EXPECT_EQ(geometry_of(dwell, at).end, at);
}

TEST(Geometry, AQuarterArcCounterClockwise) {
    const Geometry path = geometry_of(arc_xy({0, 10, 0, 0, 0, 0}, 0, 0, 1), {10, 0, 0, 0, 0, 0});
    EXPECT_EQ(path.shape, PathShape::arc);
    EXPECT_DOUBLE_EQ(path.length, 5 * pi);
    EXPECT_DOUBLE_EQ(path.sweep, pi / 2);
    EXPECT_DOUBLE_EQ(path.tangent_in[1], 1);
    EXPECT_DOUBLE_EQ(path.tangent_out[0], -1);
    EXPECT_DOUBLE_EQ(position_at(path, 2.5 * pi)[0], 10 * std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(curvature_radius(path), 10);
    EXPECT_DOUBLE_EQ(distance_to(path, 8, 8, 0), std::sqrt(128.0) - 10);
    EXPECT_DOUBLE_EQ(distance_to(path, 10, -3, 0), 3);  // beside the start
    EXPECT_DOUBLE_EQ(distance_to(path, 0, 14, 3), 5);   // above and outside
}

TEST(Geometry, TheSameArcClockwiseCoversTheOtherThreeQuarters) {
    const Geometry path = geometry_of(arc_xy({0, 10, 0, 0, 0, 0}, 0, 0, -1), {10, 0, 0, 0, 0, 0});
    EXPECT_DOUBLE_EQ(path.sweep, -1.5 * pi);
    EXPECT_DOUBLE_EQ(path.tangent_in[1], -1);
    EXPECT_NEAR(distance_to(path, 8, 8, 0), std::sqrt(68.0), 1e-12);
}

TEST(Geometry, AnArcThatEndsWhereItStartsIsAWholeTurn) {
    const Point start = {10, 0, 0, 0, 0, 0};
    EXPECT_DOUBLE_EQ(geometry_of(arc_xy(start, 0, 0, 1), start).sweep, 2 * pi);
    EXPECT_DOUBLE_EQ(geometry_of(arc_xy(start, 0, 0, -1), start).sweep, -2 * pi);
    EXPECT_DOUBLE_EQ(geometry_of(arc_xy(start, 0, 0, 3), start).sweep, 6 * pi);
    EXPECT_DOUBLE_EQ(geometry_of(arc_xy({10, 1e-12, 0, 0, 0, 0}, 0, 0, 1), start).sweep, 2 * pi);
    EXPECT_DOUBLE_EQ(geometry_of(arc_xy({0, 10, 0, 0, 0, 0}, 0, 0, 2), start).sweep, 2.5 * pi);
}

TEST(Geometry, AHelixIsAsLongAsItsUnrolledLine) {
    const Geometry path = geometry_of(arc_xy({10, 0, 5, 90, 0, 0}, 0, 0, 2), {10, 0, 0, 0, 0, 0});
    const double length = std::sqrt(40 * pi * 40 * pi + 25);
    EXPECT_DOUBLE_EQ(path.length, length);
    EXPECT_DOUBLE_EQ(path.tangent_in[2], 5 / length);
    EXPECT_DOUBLE_EQ(path.tangent_in[3], 90 / length);
    EXPECT_DOUBLE_EQ(curvature_radius(path), length * length / (10 * 16 * pi * pi));
    EXPECT_DOUBLE_EQ(position_at(path, length / 2)[2], 2.5);
    EXPECT_NEAR(distance_to(path, 10, 0, 2.5), 0, 1e-12);
    EXPECT_NEAR(distance_to(path, 11, 0, 2.5), 1, 1e-3);
}

TEST(Geometry, AnArcWhoseRadiiDifferStillEndsAtItsEnd) {
    const Geometry path = geometry_of(arc_xy({0, 10.01, 0, 0, 0, 0}, 0, 0, 1), {10, 0, 0, 0, 0, 0});
    EXPECT_EQ(position_at(path, path.length), path.end);
    EXPECT_NEAR(apart(position_at(path, path.length * (1 - 1e-9)), path.end), 0, 1e-7);
    EXPECT_DOUBLE_EQ(path.radius, 10.005);
}

TEST(Geometry, DegenerateArcsBecomeLines) {
    EXPECT_EQ(geometry_of(arc_xy({1, 0, 0, 0, 0, 0}, 0, 0, 1), {}).shape, PathShape::line);
    EXPECT_EQ(geometry_of(arc_xy({1, 0, 0, 0, 0, 0}, 5, 5, 0), {}).shape, PathShape::line);
    EXPECT_EQ(geometry_of(arc_xy({}, 0, 0, 1), {}).shape, PathShape::nothing);
}

RC_GTEST_PROP(GeometryLaws, PositionsOnAnArcKeepItsRadiusAndMoveByTheTangent, ()) {
    const RandomArc made = random_arc(*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::arbitrary<bool>());
    const Geometry path = geometry_of(made.move, made.start);
    const double h = path.length * 1e-6;
    for (int k = 0; k <= 20; ++k) {
        const double s = std::clamp(path.length * k / 20, h, path.length - h);
        const Point here = position_at(path, s);
        const double x = here[path.first] - path.centre_first;
        const double y = here[path.second] - path.centre_second;
        RC_ASSERT(std::fabs(std::sqrt(x * x + y * y) - path.radius) < 1e-9);
        const Point before = position_at(path, s - h);
        const Point after = position_at(path, s + h);
        const Point tangent = tangent_at(path, s);
        double unit = 0;
        for (int i = 0; i < axis_count; ++i) {
            RC_ASSERT(std::fabs((after[i] - before[i]) / (2 * h) - tangent[i]) < 1e-5);
            if (i < 3) unit += tangent[i] * tangent[i];
        }
        RC_ASSERT(std::fabs(unit - 1) < 1e-12);
    }
    const Point out = tangent_at(path, path.length);
    for (int i = 0; i < axis_count; ++i) RC_ASSERT(std::fabs(out[i] - path.tangent_out[i]) < 1e-9);
}

RC_GTEST_PROP(GeometryLaws, TheMaximumComponentIsThatOfManyTangents, ()) {
    const RandomArc made = random_arc(*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::arbitrary<bool>());
    const Geometry path = geometry_of(made.move, made.start);
    const Point max_error = max_tangent_components(path);
    Point seen{};
    for (int k = 0; k <= 2000; ++k) {
        const Point tangent = tangent_at(path, path.length * k / 2000);
        for (int i = 0; i < axis_count; ++i) seen[i] = std::max(seen[i], std::fabs(tangent[i]));
    }
    for (int i = 0; i < axis_count; ++i) {
        RC_ASSERT(seen[i] <= max_error[i] + 1e-12);
        RC_ASSERT(seen[i] >= max_error[i] - 1e-4 * (1 + max_error[i]));
    }
}

RC_GTEST_PROP(GeometryLaws, TheDistanceIsTheLeastOverThePath, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    const bool helix = *rc::gen::arbitrary<bool>();
    RandomArc made = random_arc(seed, helix);
    if (!helix) {
        // removes the motion along the third axis
        const int third = 3 - made.move.first - made.move.second;
        made.move.end[third] = made.start[third];
        if (seed % 3 == 0) made.move.kind = MoveKind::feed;
    }
    const Geometry path = geometry_of(made.move, made.start);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> part(0, 1), off(-0.02, 0.02);
    const double scale = path.shape == PathShape::arc ? path.radius : path.length;
    Point point = position_at(path, path.length * part(random));
    for (int i = 0; i < 3; ++i) point[i] += scale * off(random);
    constexpr int samples = 20'000;
    double min_distance = 1e300;
    for (int k = 0; k <= samples; ++k)
        min_distance = std::min(min_distance, apart(point, position_at(path, path.length * k / samples)));
    const double got = distance_to(path, point[0], point[1], point[2]);
    RC_ASSERT(got <= min_distance + 1e-9);
    const double half_step = 0.5 * path.length / samples;
    RC_ASSERT(got >=
              std::sqrt(std::max(0.0, min_distance * min_distance - half_step * half_step)) - half_step * 0.1 - 1e-9);
}

}  // namespace
}  // namespace motionrack::control
