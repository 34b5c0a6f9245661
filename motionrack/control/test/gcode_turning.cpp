// Turning cycles G70 .. G72.2: what they cut and what not, by a work piece that is turned here in numbers; and what is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/control/gcode/cutter.hpp>
#include <motionrack/control/gcode/planar.hpp>
#include <optional>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using testing::Refused;

constexpr double top = 60;  ///< height of the start
constexpr double near = 1e-6;
/// Of what joints that are nearly tangent are off, mm.
constexpr double rough = cutter_tolerance_mm + near;

/// A contour in the view of a cycle: `first` along the cut, `second` away from the work piece.
std::vector<ContourPiece> random_contour(bool arcs, double widest) {
    std::vector<ContourPiece> out;
    Planar at = {0, *rc::gen::inRange(0, 40) * 1.0};
    const int count = *rc::gen::inRange(1, 8);
    for (int i = 0; i < count; ++i) {
        ContourPiece piece;
        piece.from = at;
        piece.line = i + 1;
        const bool after_upright = !out.empty() && out.back().to.first == out.back().from.first;
        const double wide =
            !after_upright && *rc::gen::inRange(0, 4) == 0 ? 0 : *rc::gen::inRange(30, 100) * widest / 100;
        const double high = *rc::gen::inRange(0, 40);
        piece.to = {at.first + wide, wide > 0 && *rc::gen::inRange(0, 3) == 0 ? at.second : high};
        if (arcs && wide > 0 && *rc::gen::inRange(0, 3) == 0) {  // a bulge or a groove that goes one way
            piece.to.second = at.second;
            const double deep = *rc::gen::inRange(0, 100) * wide / 100;
            const bool up = *rc::gen::arbitrary<bool>();
            piece.centre = {at.first + wide / 2, up ? at.second - deep : at.second + deep};
            piece.turns = up ? -1 : 1;
        }
        if (length(piece.to - piece.from) < 1) continue;
        out.push_back(piece);
        at = piece.to;
    }
    if (out.empty() || out.back().to.first - out.front().from.first < 1) {
        ContourPiece piece;
        piece.from = at;
        piece.to = {at.first + 20, at.second};
        piece.line = 99;
        out.push_back(piece);
    }
    return out;
}

/// The height of a move or of a piece of contour at a place along the cut; nothing where it is not there, or upright.
std::optional<double> height_at(Planar from, Planar to, std::int32_t turns, Planar centre, double along) {
    const double least = std::min(from.first, to.first), greatest = std::max(from.first, to.first);
    if (along < least || along > greatest || greatest - least < near) return std::nullopt;
    if (turns == 0) return from.second + (to.second - from.second) * (along - from.first) / (to.first - from.first);
    const double radius = length(from - centre), over = along - centre.first;
    const double half = std::sqrt(std::max(0.0, radius * radius - over * over));
    return (turns < 0) == (to.first > from.first) ? centre.second + half : centre.second - half;
}

double contour_at(const std::vector<ContourPiece>& contour, double along) {
    double height = -1e9;
    for (const ContourPiece& piece : contour)
        if (const auto here = height_at(piece.from, piece.to, piece.turns, piece.centre, along))
            height = std::max(height, *here);
    return height;
}

double distance_to(const ContourPiece& piece, Planar p) {
    if (piece.turns == 0) {
        const Planar way = piece.to - piece.from;
        const double share = std::clamp(dot(p - piece.from, way) / dot(way, way), 0.0, 1.0);
        return length(p - (piece.from + way * share));
    }
    const Planar out = p - piece.centre;
    const double radius = length(piece.from - piece.centre);
    const double sense = piece.turns;
    const bool beside =
        sense * cross(piece.from - piece.centre, out) >= 0 && sense * cross(out, piece.to - piece.centre) >= 0;
    if (beside && length(out) > near) return std::fabs(length(out) - radius);
    return std::min(length(p - piece.from), length(p - piece.to));
}

double distance_to(const std::vector<ContourPiece>& contour, Planar p) {
    double nearest = 1e9;
    for (const ContourPiece& piece : contour) nearest = std::min(nearest, distance_to(piece, p));
    return nearest;
}

/// Above the contour or on it. Where it is upright, its lower side counts: a tool may stand there.
bool is_above(const std::vector<ContourPiece>& contour, Planar p) {
    return p.second >= std::min(contour_at(contour, p.first - near), contour_at(contour, p.first + near)) - near ||
           distance_to(contour, p) <= rough;
}

struct Moved {
    Planar from;
    TurningMove move;  ///< in the view

    Planar at(double share) const {
        if (move.turns == 0) return from + (move.to - from) * share;
        const Planar a = from - move.centre, b = move.to - move.centre;
        const double angle = std::atan2(cross(a, b), dot(a, b)) * share, c = std::cos(angle), s = std::sin(angle);
        return move.centre + Planar{a.first * c - a.second * s, a.first * s + a.second * c};
    }
};

/// Does a cycle on a contour given in its view, in one of the eight ways in which that can lie in X and Z.
std::string cut(const TurningView& view, TurningPlan plan, std::vector<ContourPiece> contour, std::vector<Moved>& out) {
    for (ContourPiece& piece : contour) {
        piece.from = view.out(piece.from);
        piece.to = view.out(piece.to);
        piece.centre = view.out(piece.centre);
        piece.turns = view.turns(piece.turns);
    }
    const Planar start = plan.start;
    plan.start = view.out(start);
    if (view.swapped && plan.code != 700) plan.code = static_cast<std::int16_t>(plan.code + 10);
    std::vector<TurningMove> moves;
    std::string fault = turn(plan, contour, plan.start, moves);
    Planar at = start;
    out.clear();
    for (TurningMove move : moves) {
        move.to = view.in(move.to);
        move.centre = view.in(move.centre);
        move.turns = view.turns(move.turns);
        out.push_back({at, move});
        at = move.to;
    }
    return fault;
}

TurningView random_view() {
    TurningView view;
    view.swapped = *rc::gen::arbitrary<bool>();
    view.along = *rc::gen::arbitrary<bool>() ? 1 : -1;
    view.away = *rc::gen::arbitrary<bool>() ? 1 : -1;
    return view;
}

/// What is left of a cylinder at a place, after some moves.
double left_at(const std::vector<Moved>& moves, std::size_t count, double along) {
    double height = top;
    for (std::size_t i = 0; i < count; ++i) {
        const Moved& one = moves[i];
        if (one.move.kind == MoveKind::traverse) continue;
        if (const auto here = height_at(one.from, one.move.to, one.move.turns, one.move.centre, along))
            height = std::min(height, *here);
    }
    return height;
}

}  // namespace

RC_GTEST_PROP(GcodeTurning, NeverCutsIntoWhatIsToBeLeftAndTakesNoMoreThanIAtOnceAndNeverRapidsThroughThePiece, ()) {
    const auto contour = random_contour(true, 30);
    TurningPlan plan;
    plan.start = {-2, top};
    plan.distance = *rc::gen::inRange(0, 3) == 0 ? 0 : *rc::gen::inRange(1, 15) / 10.0;
    plan.depth = *rc::gen::inRange(5, 90) / 10.0;
    plan.retract = *rc::gen::inRange(0, 20) / 10.0;
    std::vector<Moved> moves;
    const std::string fault = cut(random_view(), plan, contour, moves);
    if (!fault.empty()) RC_DISCARD("no room");
    RC_ASSERT(!moves.empty());
    const double begin = contour.front().from.first + plan.distance, end = contour.back().to.first - plan.distance;
    // The levels begin on the line from the start to where the path beside the contour begins. Where the contour goes
    // down at once, that lies past its first corner, and the line leads over the corner at less than D.
    std::vector<ContourPiece> beside;
    RC_ASSERT(beside_contour(contour, plan.distance, beside) == "");
    ContourPiece way_in;
    way_in.from = plan.start, way_in.to = beside.front().from;
    const double over_corner = std::min(plan.distance, distance_to(way_in, contour.front().from));
    for (std::size_t i = 0; i < moves.size(); ++i) {
        for (int k = 0; k <= 12; ++k) {
            const Planar p = moves[i].at((k + 0.37) / 13);
            RC_ASSERT(distance_to(contour, p) >= (p.first < way_in.to.first ? over_corner : plan.distance) - rough);
            RC_ASSERT(is_above(contour, p));
            if (p.first <= begin + near || p.first >= end - near ||
                std::fabs(moves[i].move.to.first - moves[i].from.first) < near)
                continue;
            const double left = left_at(moves, i, p.first);
            if (moves[i].move.kind == MoveKind::traverse)
                RC_ASSERT(p.second >= left - rough);
            else
                RC_ASSERT(left - p.second <= plan.depth + rough);
        }
    }
}

RC_GTEST_PROP(GcodeTurning, LeavesNothingOnTheContourButD, ()) {
    const auto contour = random_contour(true, 30);
    TurningPlan plan;
    plan.start = {-2, top};
    plan.depth = *rc::gen::inRange(5, 90) / 10.0;
    const TurningView view = random_view();
    std::vector<Moved> moves;
    RC_ASSERT(cut(view, plan, contour, moves) == "");
    for (const ContourPiece& piece : contour)
        for (const double share : {0.21, 0.5, 0.83}) {
            const double along = piece.from.first + (piece.to.first - piece.from.first) * share;
            if (piece.to.first - piece.from.first < near) continue;
            RC_ASSERT(std::fabs(left_at(moves, moves.size(), along) - contour_at(contour, along)) < 1e-5);
        }
    RC_ASSERT(std::fabs(moves.back().move.to.first - contour.back().to.first) < near);
    RC_ASSERT(std::fabs(moves.back().move.to.second - top) < near);
    // First all but the pockets, then these, leave the same.
    std::vector<Moved> rest;
    plan.code = 711;
    RC_ASSERT(cut(view, plan, contour, moves) == "");
    plan.code = 712;
    RC_ASSERT(cut(view, plan, contour, rest) == "");
    moves.insert(moves.end(), rest.begin(), rest.end());
    for (int k = 1; k < 40; ++k) {
        const double along = contour.back().to.first * (k + 0.2928932) / 41;  // no upright piece stands there
        RC_ASSERT(std::fabs(left_at(moves, moves.size(), along) - contour_at(contour, along)) < 1e-5);
    }
}

RC_GTEST_PROP(GcodeTurning, FinishesAlongTheContourInPassesThatComeNearer, ()) {
    const auto contour = random_contour(true, 30);
    TurningPlan plan;
    plan.code = 700;
    plan.start = {-2, top};
    plan.distance = *rc::gen::inRange(0, 20) / 10.0;
    plan.end_distance = *rc::gen::inRange(0, 10) / 10.0;
    plan.passes = *rc::gen::inRange(1, 4);
    std::vector<Moved> moves;
    TurningView view;  // not across: a contour that goes one way along both is taken along Z
    view.along = *rc::gen::arbitrary<bool>() ? 1 : -1;
    view.away = *rc::gen::arbitrary<bool>() ? 1 : -1;
    if (!cut(view, plan, contour, moves).empty()) RC_DISCARD("no room");
    double nearest = 1e9;
    for (const Moved& one : moves)
        for (int k = 0; k <= 12; ++k) {
            const Planar p = one.at(k / 12.0);
            nearest = std::min(nearest, distance_to(contour, p));
            RC_ASSERT(is_above(contour, p));
        }
    const double last = plan.end_distance, first = last + (plan.distance - last) * (plan.passes - 1) / plan.passes;
    RC_ASSERT(std::fabs(nearest - std::min(first, last)) < rough);
}

RC_GTEST_PROP(GcodeTurning, LeadsThroughNothingThatIsToBeLeftFromWhereverItStarts, ()) {
    const auto contour = random_contour(true, 30);
    TurningPlan plan;
    plan.code = *rc::gen::element<std::int16_t>(700, 710, 711, 712);
    plan.start = {*rc::gen::inRange(-5, 60) * 1.0, contour.front().from.second + *rc::gen::inRange(1, 60)};
    plan.distance = *rc::gen::inRange(0, 20) / 10.0;
    plan.end_distance = *rc::gen::inRange(0, 10) / 10.0;
    plan.passes = *rc::gen::inRange(1, 4);
    plan.depth = *rc::gen::inRange(5, 90) / 10.0;
    plan.retract = *rc::gen::inRange(0, 20) / 10.0;
    TurningView view;
    view.along = *rc::gen::arbitrary<bool>() ? 1 : -1;
    view.away = *rc::gen::arbitrary<bool>() ? 1 : -1;
    std::vector<Moved> moves;
    if (!is_above(contour, plan.start) || !cut(view, plan, contour, moves).empty()) RC_DISCARD("no room");
    for (const Moved& one : moves)
        for (int k = 0; k <= 12; ++k) RC_ASSERT(is_above(contour, one.at(k / 12.0)));
}

/// G70 in two passes along a contour that is given in its view.
void expect_finished_above(const std::vector<ContourPiece>& contour, Planar start, double distance,
                           double end_distance) {
    TurningPlan plan;
    plan.code = 700;
    plan.start = start;
    plan.distance = distance;
    plan.end_distance = end_distance;
    plan.passes = 2;
    std::vector<Moved> moves;
    ASSERT_EQ(cut({}, plan, contour, moves), "");
    for (const Moved& one : moves)
        for (int k = 0; k <= 12; ++k)
            EXPECT_TRUE(is_above(contour, one.at(k / 12.0)))
                << one.at(k / 12.0).first << " " << one.at(k / 12.0).second;
}

TEST(GcodeTurning, FinishingComesBackOverABulgeThatEndsWhereItBegan) {
    expect_finished_above({{{0, 1}, {19.2, 1}, -1, {9.6, 1}, 0, false, 1}}, {-2, top}, 0, 0);
}

// Beside the contour the groove ends a little past its half circle, because its bulge begins within the tolerance of
// that.
TEST(GcodeTurning, FinishingComesBackOverABulgeBehindAGrooveThatItNearlyTouches) {
    expect_finished_above(
        {{{0, 0}, {12.9, 0}, 1, {6.45, 0}, 0, false, 1}, {{12.9, 0}, {27.6, 0}, -1, {20.25, -0.147}, 0, false, 2}},
        {-2, top}, 0, 0.2);
}

TEST(GcodeTurning, FinishingComesBackOverABulgeThatIsHigherThanTheStart) {
    expect_finished_above({{{0, 1}, {20, 1}, -1, {10, 1}, 0, false, 1}}, {-2, 5}, 0, 0);
    expect_finished_above({{{0, 1}, {10, 20}, 0, {}, 0, false, 1},
                           {{10, 20}, {20, 20}, 0, {}, 0, false, 2},
                           {{20, 20}, {30, 30}, 0, {}, 0, false, 3}},
                          {-2, 5}, 0, 0);
    expect_finished_above({{{0, 10}, {10, 20}, 0, {}, 0, false, 1},
                           {{10, 20}, {12, 0}, 0, {}, 0, false, 2},
                           {{12, 0}, {20, 0}, 0, {}, 0, false, 3}},
                          {15, 12}, 0.5, 0);
}

TEST(GcodeTurning, AFilletTouchesBothSidesAndAChamferHasItsEnds) {
    const auto pieces = [](double radius, bool chamfer) {
        std::vector<ContourPiece> contour(2);
        contour[0] = {{0, 10}, {-10, 10}, 0, {}, radius, chamfer, 1};
        contour[1] = {{-10, 10}, {-10, 20}, 0, {}, 0, false, 2};
        EXPECT_EQ(round_corners(contour), "");
        return contour;
    };
    const auto fillet = pieces(2, false), chamfer = pieces(2, true);
    ASSERT_EQ(fillet.size(), 3u);
    EXPECT_NEAR(fillet[1].centre.first, -8, 1e-12);
    EXPECT_NEAR(fillet[1].centre.second, 12, 1e-12);
    EXPECT_EQ(fillet[1].turns, -1);
    ASSERT_EQ(chamfer.size(), 3u);
    EXPECT_EQ(chamfer[1].turns, 0);
    EXPECT_NEAR(chamfer[1].from.first, -8, 1e-12);
    EXPECT_NEAR(chamfer[1].to.second, 12, 1e-12);
    std::vector<ContourPiece> straight(2);
    straight[0] = {{0, 10}, {-10, 10}, 0, {}, 2, false, 1};
    straight[1] = {{-10, 10}, {-20, 10}, 0, {}, 0, false, 2};
    EXPECT_THAT(round_corners(straight), ::testing::HasSubstr("does not turn at the end of line 1"));
}

TEST(GcodeTurning, TheMachineStandsAtTheEndAndModesAreThoseOfTheProgram) {
    const std::string sub = "o1 sub\nG0 X10 Z2\nG1 Z-30 F7 S5 M3\n#9=3\nX20\no1 endsub\n";
    const auto read = testing::read("G21 G18 G90 F600\n" + sub + "#9=1\nG0 X25 Z5\nG71 Q1 I6 (turn) M8\nG91\nG1 X#9\n");
    EXPECT_EQ(read.problems.size(), 0u);
    const auto moves = read.moves();
    ASSERT_GT(moves.size(), 5u);
    EXPECT_EQ(moves.back().end[0], 26) << "what the contour sets is not kept";
    EXPECT_EQ(moves.back().end[2], -30);
    int events = 0;
    for (const Step& step : read.steps) {
        events += step.kind != StepKind::move;
        if (step.kind == StepKind::move && step.move.kind == MoveKind::feed) {
            EXPECT_EQ(step.move.feed, 10);
        }
    }
    EXPECT_EQ(events, 2) << "coolant and a comment; the contour has none";
    for (const Move& move : moves) EXPECT_EQ(move.end[1], 0);
}

TEST(GcodeTurning, AreRefusedWithTheirPlace) {
    const std::string before =
        "G21 G18 G90 F600\no1 sub\nG0 X10 Z2\nG1 Z-30\nX20\no1 endsub\no2 sub\nG0 X10 Z2\nG1 Z-30\nG1 X20 Z-20\no2 "
        "endsub\no3 sub\no3 endsub\n"
        "o4 sub\nG0 X10 Z2\nG1 Z-10\nX5 Z-12\nZ-13\nX10 Z-15\no4 endsub\no5 sub\nG2 X10 Z2 R9\nG1 Z9\no5 endsub\no6 "
        "sub\nG0 X1 Z1\nG1 Z-9 Y2\no6 endsub\n"
        "o7 sub\nG0 X1 Z1\nG71 Q1\no7 endsub\nG0 X25 Z5\n";
    const Refused rows[] = {{"G71", 1, "Q word missing: G71 needs the number of the sub"},
                            {"G71 Q1.5", 5, "an integer"},
                            {"G71 Q9", 1, "o9 call: this program has no o9 sub"},
                            {"G71 Q1 I0", 8, "I is how much deeper"},
                            {"G71 Q1 D-1", 8, "a distance, 0 or more"},
                            {"G71 Q1 R-1", 8, "a distance, 0 or more"},
                            {"G71 Q1 P2", 8, "nothing on this line uses"},
                            {"G70 Q1 I2", 8, "nothing on this line uses"},
                            {"G70 Q1 P0", 8, "from 1"},
                            {"G71 Q1 Y2", 8, "X and Z only"},
                            {"G71 Q1 A2", 8, "X and Z only"},
                            {"G17 G71 Q1", 5, "write G18"},
                            {"G93 G71 Q1 F1", 5, "inverse time"},
                            {"G41.1 D1 G71 Q1", 10, "cutter compensation"},
                            {"G71 Q1 M2", 1, "on a line of its own"},
                            {"G71 Q1 G92 X1", 1, "on a line of its own"},
                            {"G71 Q2", 1, "the contour goes back along Z in line 10"},
                            {"G72 Q4", 1, "ends where it began along X"},
                            {"G71 Q3", 1, "draws no contour"},
                            {"G71 Q4 D5", 1, "there is no room in line"},
                            {"G71 Q1 X600", 8, "X600 leads to"},
                            {"G71 Q1\nX5", 1, "no motion is active"}};
    for (const Refused& row : rows) {
        SCOPED_TRACE(row.program);
        const std::string text = before + row.program;
        const auto read = testing::read(text);
        ASSERT_EQ(read.problems.size(), 1u);
        EXPECT_EQ(read.problems[0].place.line, 1 + std::count(text.begin(), text.end(), '\n'));
        EXPECT_EQ(read.problems[0].place.column, row.column);
        EXPECT_THAT(read.problems[0].message, ::testing::HasSubstr(row.says));
    }
    const struct {
        const char* line;
        int at;
        const char* says;
    } inside[] = {{"G71 Q5", 22, "leads straight to where it begins"},
                  {"G71 Q6", 27, "X and Z only"},
                  {"G71 Q7", 31, "within the contour of another cycle"}};
    for (const auto& row : inside) {
        const auto read = testing::read(before + row.line);
        ASSERT_EQ(read.problems.size(), 1u) << row.line;
        EXPECT_EQ(read.problems[0].place.line, row.at) << row.line;
        EXPECT_THAT(read.problems[0].message, ::testing::HasSubstr(row.says));
    }
    EXPECT_FALSE(Interpreter(testing::machine()).line("G71 Q1", 1)) << "a sender's line";
    EXPECT_FALSE(Interpreter(testing::machine()).line("G18 G71 Q1 F5", 1, Language::expressions));
}

TEST(GcodeTurning, ARefusedCycleMovesNothingAndTheProgramGoesOn) {
    const auto read =
        testing::read("G18 F600\no1 sub\nG0 X10 Z2\nG1 Z-700\nX20\no1 endsub\nG0 X25 Z5\nG71 Q1\nG0 X1\n");
    ASSERT_EQ(read.problems.size(), 1u);
    EXPECT_THAT(read.problems[0].message, ::testing::HasSubstr("G71 leads to Z = -700 mm"));
    EXPECT_EQ(read.problems[0].place.line, 8);
    ASSERT_EQ(read.moves().size(), 2u);
    EXPECT_EQ(read.moves()[1].end[2], 5);
}

}  // namespace motionrack::control::gcode
