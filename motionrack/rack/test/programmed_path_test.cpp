// The distance of a position from a program depends on the program alone. The moves as written count, each with its own
// tolerance, whatever their plan.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/programmed_path.hpp>
#include <vector>

namespace motionrack::rack {
namespace {

using control::PathControl;

/// Straight moves, each with its tolerance.
class Written {
  public:
    explicit Written(control::Point start) : at_(start) {}
    void line(double x, double y, PathControl control = PathControl::continuous, double tolerance_mm = 0.05) {
        control::Move move;
        move.kind = control::MoveKind::feed;
        move.path = control;
        move.tolerance_mm = tolerance_mm;
        move.index = next_++;
        move.end = {x, y};
        path.add(move, at_);
        at_ = move.end;
    }
    void dwell() {
        control::Move move;
        move.kind = control::MoveKind::dwell;
        move.index = next_++;
        path.add(move, at_);
    }
    ProgrammedPath path;

  private:
    control::Point at_;
    std::int64_t next_ = 0;
};

ProgramPart part_of(std::int64_t first, std::int64_t last = 1'000'000, double reach_mm = 1e6) {
    return {first, last, first, reach_mm};
}

TEST(ProgrammedPath, MeasuresTheDeviationAtACorner) {
    Written program({0, 0});
    program.line(10, 0);
    program.line(10, 10);
    const ProgramDistance off = program.path.distance(part_of(0), 9.9, 0.1, 0);
    EXPECT_NEAR(off.mm, 0.1, 1e-12);
    EXPECT_NEAR(off.judged_mm, 0.1, 1e-12);
    EXPECT_EQ(off.tolerance_mm, 0.05);
    EXPECT_NEAR(program.path.distance(part_of(0), 5, -0.2, 0.1).mm, std::hypot(0.2, 0.1), 1e-12);
}

TEST(ProgrammedPath, UsesTheToleranceOfTheMoveThatAllowsThePosition) {
    Written program({0, 0});
    program.line(10, 0, PathControl::continuous, 0.5);
    program.line(10, 10, PathControl::exact_path, 0.5);
    const ProgramDistance off = program.path.distance(part_of(0), 9.8, 0.3, 0);
    EXPECT_NEAR(off.mm, 0.2, 1e-12) << "nearest is the second move";
    EXPECT_NEAR(off.judged_mm, 0.3, 1e-12) << "but the first one allows it";
    EXPECT_EQ(off.tolerance_mm, 0.5);
    EXPECT_EQ(program.path.distance(part_of(1), 9.8, 5, 0).tolerance_mm, 0) << "G61";
}

TEST(ProgrammedPath, ComparesOnlyWithMovesNearTheMachine) {
    Written program({0, 0});
    for (int i = 1; i <= 40; ++i) program.line(i, i % 2 == 0 ? 0 : 1);
    program.line(40, 50);
    program.line(0, 50);
    program.dwell();
    program.line(0, 0.2);
    program.path.drop_before(20);
    EXPECT_GT(program.path.distance(part_of(20, 22), 0, 0, 0).mm, 10)
        << "what is driven long before or after does not count";
    EXPECT_NEAR(program.path.distance(part_of(20, 22), 19, 1, 0).mm, 0, 1e-12) << "the move before does";
    EXPECT_NEAR(program.path.distance(part_of(20, 22), 23, 1, 0).mm, 0, 1e-12) << "and the last one";
    EXPECT_NEAR(program.path.distance(part_of(42, 42), 0, 50, 0).mm, 0, 1e-12)
        << "in a dwell, the end of the move before";
}

TEST(ProgrammedPath, ComparesNoFartherThanTheMachineCanHaveMoved) {
    Written program({0, 0});
    program.line(10, 0);
    program.line(10, 30);
    program.line(0, 30);
    program.line(0, 0.2);
    EXPECT_NEAR(program.path.distance(part_of(0, 3, 20), 1, 1, 0).mm, 1, 1e-12);
    EXPECT_NEAR(program.path.distance(part_of(0, 3), 1, 2, 0).mm, 1, 1e-12) << "the last move is nearer than the first";
}

/// The result equals that of a check of all moves one by one.
TEST(ProgrammedPath, FindsTheNearestOfManyShortMoves) {
    Written program({0, 0});
    std::vector<control::Point> corners = {{0, 0}};
    for (int i = 1; i <= 3'000; ++i) {
        const double angle = 0.01 * i, radius = 1 + 0.002 * i + 0.3 * std::sin(0.7 * i);
        corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        program.line(corners.back()[0], corners.back()[1], PathControl::continuous, i % 7 == 0 ? 0.02 : 0.01);
    }
    for (int k = 0; k < 500; ++k) {
        const double x = 8 * std::sin(1.3 * k), y = 8 * std::cos(2.1 * k);
        double nearest = 1e9, beside = 1e9;
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
            const double dx = corners[i + 1][0] - corners[i][0], dy = corners[i + 1][1] - corners[i][1];
            const double along =
                std::clamp(((x - corners[i][0]) * dx + (y - corners[i][1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
            const double off = std::hypot(x - corners[i][0] - along * dx, y - corners[i][1] - along * dy);
            nearest = std::min(nearest, off);
            beside = std::min(beside, off - ((i + 1) % 7 == 0 ? 0.02 : 0.01));
        }
        const ProgramDistance found = program.path.distance(part_of(0), x, y, 0);
        ASSERT_NEAR(found.mm, nearest, 1e-9) << k;
        ASSERT_NEAR(found.judged_mm - found.tolerance_mm, beside, 1e-9) << k;
    }
}

TEST(ProgrammedPath, WithoutMovesHasNoDeviation) {
    EXPECT_EQ(ProgrammedPath().distance(part_of(0), 1, 2, 3).mm, 0);
}

}  // namespace
}  // namespace motionrack::rack
