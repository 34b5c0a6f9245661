// Degenerate programs: very small and very large sizes and tolerances, in any order.

#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/control/path/test/path_builder_support.hpp>

namespace motionrack::control {
namespace {

using namespace curve_test;

Move any_move(ProgramMaker& maker, const Point& at) {
    Move move = line_to(at, maker.size_between(1e-9, 1e9));
    move.path = static_cast<PathControl>(maker.one_of(3));
    move.kind = static_cast<MoveKind>(maker.one_of(10) == 0 ? 3 : maker.one_of(3));
    move.feed_mode = static_cast<FeedMode>(maker.one_of(4) == 0);
    move.feed = maker.size_between(1e-6, 1e6);
    move.rapid_override = maker.between(0.01, 1);
    move.first = static_cast<std::uint8_t>(maker.one_of(3));
    move.second = static_cast<std::uint8_t>((move.first + 1) % 3);
    const double size = maker.size_between(1e-12, 1e5);
    for (std::size_t i = 0; i < 6; ++i)
        if (maker.one_of(3) == 0) move.end[i] += maker.between(-size, size) * (maker.one_of(5) == 0 ? 1e-6 : 1);
    if (move.kind == MoveKind::arc) {
        const double radius = maker.size_between(1e-9, 1e6);
        move.turns = (maker.one_of(2) == 0 ? 1 : -1) * (1 + maker.one_of(3));
        const SinCos in = sin_cos(maker.between(0, 6)), out = sin_cos(maker.one_of(3) == 0 ? 0 : maker.between(0, 6));
        move.centre_first = at[move.first] - radius * in.cos;
        move.centre_second = at[move.second] - radius * in.sin;
        move.end[move.first] = move.centre_first + radius * out.cos;
        move.end[move.second] = move.centre_second + radius * out.sin;
    }
    if (move.kind == MoveKind::dwell) move.end = at;
    return move;
}

MachineLimits any_machine(ProgramMaker& maker) {
    MachineLimits limits;
    for (AxisLimits& axis : limits) {
        axis = {maker.one_of(5) != 0, -1e9, 1e9, maker.size_between(1e-3, 1e6), maker.size_between(1e-2, 1e8), 0, 1, 0};
        if (maker.one_of(3) != 0) axis.max_jerk = maker.size_between(1e-1, 1e10);
        if (maker.one_of(5) != 0) axis.pulses_per_unit = maker.size_between(1, 1e6);
    }
    return limits;
}

bool finite(const Point& p) {
    double sum = 0;
    for (const double x : p) sum += x * 0;
    return sum == 0;
}

TEST(RandomPath, IsFiniteContinuousAndEndsAtTheEndOfTheProgram) {
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        ProgramMaker maker(seed);
        std::vector<Move> moves;
        Point at = {};
        for (int i = maker.one_of(60); i >= 0; --i) {
            moves.push_back(any_move(maker, at));
            at = moves.back().end;
        }
        const auto items = curve_of(numbered(moves), any_machine(maker));
        ASSERT_LT(items.size(), 200'000u);
        Point standstill = {};
        double u = 0;
        for (const PathElement& item : items) {
            if (item.rest) {
                standstill = item.at;
                u = 0;
                continue;
            }
            const CubicSegment& piece = item.piece;
            ASSERT_NEAR(piece.begin, u, 1e-15 * (1 + u) * 16);
            ASSERT_GT(piece.length, 0);
            ASSERT_GT(piece.feed, 0);
            ASSERT_TRUE(finite(piece.start) && finite(piece.tangent) && finite(piece.curvature) &&
                        finite(piece.curvature_rate))
                << piece.line;
            u = piece.begin + piece.length;
        }
        for (int i = 0; i < axis_count; ++i) ASSERT_NEAR(standstill[i], at[i], 1.5e-9 + 1e-15 * std::fabs(at[i]));
        if (::testing::Test::HasFailure()) return;
    }
}

}  // namespace
}  // namespace motionrack::control
