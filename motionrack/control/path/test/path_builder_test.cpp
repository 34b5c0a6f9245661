// Path builder: curves of typical program shapes.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <motionrack/control/path/test/path_builder_support.hpp>

namespace motionrack::control {
namespace {

using namespace curve_test;

Move exact(Move move) {
    move.path = PathControl::exact_path;
    return move;
}

Point end_of(const std::vector<Move>& moves) {
    return moves.empty() ? Point{} : moves.back().end;
}

int rests(const std::vector<Move>& moves) {
    return rests_in(curve_of(numbered(moves)));
}

/// Maximum curvature and curvature rate of XYZ on the curve.
struct CurvePeaks {
    double curvature = 0, curvature_rate = 0;
};

CurvePeaks peaks_of(const std::vector<CubicSegment>& pieces) {
    CurvePeaks out;
    for (const CubicSegment& piece : pieces) {
        out.curvature =
            std::max({out.curvature, xyz_size(piece.curvature), xyz_size(curvature_on(piece, piece.length))});
        out.curvature_rate = std::max(out.curvature_rate, xyz_size(piece.curvature_rate));
    }
    return out;
}

/// Returns the largest distance from a set of paths.
double max_distance(const std::vector<CubicSegment>& pieces, const std::vector<Geometry>& paths) {
    double max = 0;
    for (const CubicSegment& piece : pieces)
        for (int k = 0; k <= 8; ++k) {
            const Point at = position_on(piece, piece.length * k / 8);
            double min_distance = std::numeric_limits<double>::infinity();
            for (const Geometry& path : paths)
                min_distance = std::min(min_distance, distance_to(path, at[0], at[1], at[2]));
            max = std::max(max, min_distance);
        }
    return max;
}

TEST(PathBuilderTest, OfALineIsOneSegmentAndAStop) {
    const auto items = curve_of(numbered({line_to({3, 4, 0, 10, 0, 0})}));
    ASSERT_EQ(items.size(), 2u);
    const CubicSegment& piece = items[0].piece;
    EXPECT_DOUBLE_EQ(piece.length, 5);
    EXPECT_EQ(piece.feed, 100);
    EXPECT_EQ(piece.line, 1);
    EXPECT_EQ(piece.tangent, (Point{3.0 / 5, 4.0 / 5, 0, 2, 0, 0}));
    EXPECT_EQ(piece.curvature, Point{});
    EXPECT_EQ(piece.curvature_rate, Point{});
    EXPECT_TRUE(items[1].rest);
    EXPECT_EQ(items[1].at, (Point{3, 4, 0, 10, 0, 0}));
    EXPECT_EQ(items[1].seconds, 0);
}

TEST(PathBuilderTest, OfNoMovesIsEmpty) {
    EXPECT_TRUE(curve_of({}).empty());
    EXPECT_TRUE(curve_of(numbered({line_to({}), line_to({})})).empty());
}

TEST(PathBuilderTest, RoundsACornerByItsTolerance) {
    const double tolerance = 0.05;
    std::vector<Move> moves = numbered({line_to({20, 0, 0}, tolerance), line_to({20, 20, 0}, tolerance)});
    for (Move& move : moves) move.feed = 5;
    const auto items = curve_of(moves);
    EXPECT_EQ(rests_in(items), 1);
    const auto pieces = pieces_of(items);
    ASSERT_EQ(pieces.size(), 4u);
    EXPECT_EQ(pieces[0].curvature, Point{});
    EXPECT_EQ(pieces[3].curvature_rate, Point{});
    const double width = pieces[1].length + pieces[2].length;
    EXPECT_NEAR(width, 12 * 0.996 * tolerance / std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(max_distance(pieces, paths_of(moves)), 0.996 * tolerance / std::sqrt(2.0), 1e-6);
}

TEST(PathBuilderTest, StopsWhereTheProgramRequiresIt) {
    const Point a = {10, 0, 0}, b = {10, 10, 0};
    EXPECT_EQ(rests({slow(line_to(a)), slow(line_to(b))}), 1);
    EXPECT_EQ(rests({line_to(a), line_to(b)}), 2);  // at this feed rate the stop is faster than the slow detour
    EXPECT_EQ(rests({exact(line_to(a)), line_to(b)}), 2);
    EXPECT_EQ(rests({exact(line_to(a)), line_to({20, 0, 0})}), 1);
    Move stopping = line_to(a);
    stopping.path = PathControl::exact_stop;
    EXPECT_EQ(rests({stopping, line_to({20, 0, 0})}), 2);
    Move dwell = line_to(a);
    dwell.kind = MoveKind::dwell;
    dwell.seconds = 0.5;
    const auto items = curve_of(numbered({line_to(a), dwell, dwell, line_to({20, 0, 0})}));
    ASSERT_EQ(items.size(), 5u);
    EXPECT_EQ(items[1].seconds, 0.5);
    EXPECT_EQ(items[1].line, 2);
    EXPECT_EQ(items[1].at, a);
    EXPECT_EQ(items[2].seconds, 0.5);
    EXPECT_EQ(items[3].piece.begin, 0);
}

TEST(PathBuilderTest, StopsAtCornersAbove120Degrees) {
    for (const double degrees : {100.0, 119.0, 121.0, 180.0}) {
        const SinCos out = sin_cos(degrees * pi / 180);
        EXPECT_EQ(rests({slow(line_to({10, 0, 0})), slow(line_to({10 + 10 * out.cos, 10 * out.sin, 0}))}),
                  degrees < 120 ? 1 : 2)
            << degrees;
    }
    EXPECT_EQ(rests({line_to({0, 0, 0, 90, 0, 0}), line_to({0, 0, 0, 0, 0, 0})}), 2);
}

TEST(PathBuilderTest, StopsBetweenMovesOfLinearAxesAndOfRotaryAxesAlone) {
    EXPECT_EQ(rests({line_to({10, 0, 0}), line_to({10, 0, 0, 90, 0, 0}), line_to({10, 0, 0, 180, 0, 0}),
                     line_to({20, 0, 0, 180, 0, 0})}),
              3);
}

TEST(PathBuilderTest, PassesTangentJunctionsWithoutAStop) {
    for (const bool stay : {false, true}) {
        std::vector<Move> moves = {line_to({10, 0, 0})};
        moves.push_back(arc_from(end_of(moves), 0, 5, 1.5));
        moves.push_back(arc_from(end_of(moves), 1.5, 2, -3));
        const SinCos out = sin_cos(-1.5);
        Point end = end_of(moves);
        end[0] += 5 * out.cos, end[1] += 5 * out.sin;
        moves.push_back(line_to(end));
        for (int i = 0; i < 20; ++i) end[0] += 0.1 * out.cos, end[1] += 0.1 * out.sin, moves.push_back(line_to(end));
        if (stay)
            for (Move& move : moves) move = exact(move);
        EXPECT_EQ(rests(moves), 1);
    }
}

TEST(PathBuilderTest, OfDenseChordsIsNearlyTheirArc) {
    for (const double step : {0.02, 0.1, 0.3}) {
        std::vector<Move> moves;
        const double radius = 10;
        for (int i = 1; i * step < 25; ++i) {
            const SinCos at = sin_cos(i * step / radius);
            moves.push_back(line_to({radius * at.sin, radius * (1 - at.cos), 0}));
        }
        const auto items = curve_of(numbered(moves));
        EXPECT_EQ(rests_in(items), 1);
        const auto pieces = pieces_of(items);
        EXPECT_LT(pieces.size(), 4 * moves.size());
        std::vector<CubicSegment> inside;
        for (const CubicSegment& piece : pieces)
            if (piece.begin > 4 && piece.begin < 20) inside.push_back(piece);
        const CurvePeaks peaks = peaks_of(inside);
        EXPECT_LT(peaks.curvature * radius, 1.03) << step;
        EXPECT_LT(peaks.curvature_rate, 0.1) << step;
    }
}

TEST(PathBuilderTest, MergesNoisyChordsOfALine) {
    std::vector<Move> moves;
    for (int i = 1; i <= 1000; ++i) moves.push_back(line_to({0.05 * i, i % 3 * 0.0005, 0}));
    const auto pieces = pieces_of(curve_of(numbered(moves)));
    EXPECT_LT(pieces.size(), 3u * 1000 / 30);
}

TEST(PathBuilderTest, DoesNotMergeReversals) {
    std::vector<Move> moves;
    for (int i = 1; i <= 50; ++i) moves.push_back(line_to({i % 2 == 0 ? 0.5 * i : 0.5 * i + 1, 0, 0}));
    EXPECT_EQ(rests(moves), 50);
}

TEST(PathBuilderTest, KeepsRotaryAxesInProportionToTheDistance) {
    std::vector<Move> moves;
    for (int i = 1; i <= 100; ++i) moves.push_back(line_to({0.1 * i, 0, 0, i < 50 ? 0 : 0.2 * (i - 49), 0, 0}));
    const auto pieces = pieces_of(curve_of(numbered(moves)));
    for (const CubicSegment& piece : pieces) {
        const Point at = position_on(piece, 0.5 * piece.length);
        const double wanted = at[0] < 4.9 ? 0 : 2 * (at[0] - 4.9);
        EXPECT_NEAR(at[3], wanted, 0.01 / 100 * 180 / pi * (1 + 1e-6)) << at[0];
    }
}

TEST(PathBuilderTest, OfAnArcHasItsCurvatureAndNoMoreThanAThirteenthMoreAtItsJunctions) {
    for (const double tolerance : {half_pulse, 0.01, 0.1})
        for (const double radius : {0.5, 10.0, 300.0})
            for (const double sweep : {0.3, 2.0, 6.0, 50.0}) {
                std::vector<Move> moves = {line_to({2 * radius, 0, 0}, tolerance)};
                moves.push_back(arc_from(end_of(moves), 0, radius, sweep, tolerance));
                const SinCos out = sin_cos(sweep);
                Point end = end_of(moves);
                end[0] += 2 * radius * out.cos, end[1] += 2 * radius * out.sin;
                moves.push_back(line_to(end, tolerance));
                const auto items = curve_of(numbered(moves));
                EXPECT_EQ(rests_in(items), 1);
                const auto pieces = pieces_of(items);
                EXPECT_LT(peaks_of(pieces).curvature * radius, 1.08) << radius << " " << sweep;
                EXPECT_LT(max_distance(pieces, paths_of(moves)), 0.5 * tolerance) << radius << " " << sweep;
            }
}

TEST(PathBuilderTest, StartsAnArcFromStandstillWithItsFullCurvature) {
    const std::vector<Move> moves = numbered({arc_from({}, 0.3, 10, 2 * pi)});
    const auto pieces = pieces_of(curve_of(moves));
    ASSERT_FALSE(pieces.empty());
    EXPECT_NEAR(xyz_size(pieces.front().curvature) * 10, 1, 0.01);
    EXPECT_LT(peaks_of(pieces).curvature * 10, 1.01);
    EXPECT_LT(pieces.size(), 40u);
    EXPECT_LT(max_distance(pieces, paths_of(moves)), 0.1 * 0.01 * 1.2);
}

TEST(PathBuilderTest, OfAHelixOfManyTurnsStaysOnIt) {
    Move move = arc_from({}, 0, 3, 40 * pi + 1);
    move.end[2] = 20;
    move.end[5] = 720;
    const std::vector<Move> moves = numbered({move});
    const auto pieces = pieces_of(curve_of(moves));
    EXPECT_LT(max_distance(pieces, paths_of(moves)), 0.0012);
    for (const CubicSegment& piece : pieces) EXPECT_NEAR(piece.start[5], piece.start[2] * 36, 1e-6);
}

TEST(PathBuilderTest, ReplacesArcsBelowTheResolutionByLines) {
    EXPECT_EQ(pieces_of(curve_of(numbered({arc_from({}, 0, 1e-5, 4)}))).size(), 1u);
    EXPECT_EQ(pieces_of(curve_of(numbered({arc_from({}, 0, 1e6, 1e-6)}))).size(), 1u);
    EXPECT_TRUE(curve_of(numbered({arc_from({}, 0, 1e-5, 2 * pi)})).empty());
}

TEST(PathBuilderTest, SkipsTooShortMovesButKeepsTheirEndPoint) {
    std::vector<Move> moves;
    Point at = {};
    for (int i = 0; i < 1000; ++i) at[0] += 1e-9 * (i % 7), at[1] += 5e-10, moves.push_back(line_to(at));
    at[2] += 1;
    moves.push_back(line_to(at));
    at[0] += 1e-8;
    moves.push_back(line_to(at));
    const auto items = curve_of(numbered(moves));
    ASSERT_FALSE(items.empty());
    EXPECT_EQ(items.back().at, at);
    EXPECT_LT(items.size(), 40u);
}

/// Each feed rate applies to its own move, also near corners and junctions, whatever the neighbours' feed rates are.
TEST(PathBuilderTest, FeedsAreThoseOfTheProgram) {
    std::vector<Move> moves = {line_to({10, 0, 0}), line_to({20, 1, 0}), line_to({30, 1, 0}), line_to({40, 0, 0})};
    moves[1].feed = 20;
    moves[2].kind = MoveKind::rapid;
    moves[3].feed_mode = FeedMode::inverse_time;
    moves[3].feed = 2;
    moves.push_back(arc_from({40, 0, 0}, -0.099668652491162038, 5, 2));
    moves.back().feed = 3;
    const double lengths[] = {10, std::sqrt(101.0), 10, std::sqrt(101.0), 1e9};
    const double feeds[] = {100, 20, std::numeric_limits<double>::infinity(), 2 * std::sqrt(101.0), 3};
    double begin = 0;
    std::size_t of = 0;
    for (const CubicSegment& piece : pieces_of(curve_of(numbered(moves)))) {
        if (piece.begin >= begin + lengths[of] - 1e-9) begin += lengths[of++];
        ASSERT_EQ(piece.line, static_cast<int>(of) + 1) << piece.begin;
        EXPECT_LE(piece.feed, feeds[of]) << piece.line;
        EXPECT_GE(piece.feed, feeds[of] * 0.99) << piece.line;
    }
    EXPECT_EQ(of, 4u);
}

TEST(PathBuilderTest, EndsWithAStopWheneverItIsFlushed) {
    PathBuilder builder(machine(), Point{});
    PathElement item;
    Point at = {};
    for (int i = 0; i < 20; ++i) {
        at[i % 3] += 1;
        builder.push(line_to(at));
        builder.flush();
        builder.flush();
        ASSERT_TRUE(builder.pull(item));
        EXPECT_FALSE(item.rest);
        ASSERT_TRUE(builder.pull(item));
        EXPECT_TRUE(item.rest);
        EXPECT_EQ(item.at, at);
        EXPECT_FALSE(builder.pull(item));
    }
}

/// Hashes the bits of all segments; the number was the same with g++ and clang++ at -O0, -O2 and -O3.
TEST(PathBuilderTest, BitsAreTheSameOnEveryCompilerAndCpu) {
    std::vector<Move> moves;
    double heading = 0;
    for (int i = 0; i < 2000; ++i) {
        heading += 0.05 * sin_cos(i * 0.03).sin;
        const SinCos along = sin_cos(heading);
        Point end = end_of(moves);
        if (i % 40 == 39) {
            moves.push_back(arc_from(end, heading, 2 + 0.1 * (i % 7), i % 80 == 39 ? 1.5 : -2.5));
            moves.back().end[2] += i % 3 == 0 ? 0.2 : 0;
            heading += i % 80 == 39 ? 1.5 : -2.5;
            continue;
        }
        end[0] += 0.2 * along.cos, end[1] += 0.2 * along.sin, end[4] += 0.01 * (i % 100);
        moves.push_back(i % 300 == 299 ? exact(line_to(end)) : line_to(end));
        moves.back().feed = i % 17 == 0 ? 50 : 100;
    }
    std::uint64_t fold = 0;
    const auto mix = [&fold](const Point& values) {
        for (const double value : values) fold = (fold ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u;
    };
    for (const CubicSegment& piece : pieces_of(curve_of(numbered(moves)))) {
        mix({piece.begin, piece.length, piece.feed, 0, 0, 0});
        for (const Point& values : {piece.start, piece.tangent, piece.curvature, piece.curvature_rate}) mix(values);
    }
    EXPECT_EQ(fold, 898072449474637829u);
}

}  // namespace
}  // namespace motionrack::control
