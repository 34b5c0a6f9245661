// Cutter compensation: the edge of the cutter follows the contour, and impossible contours are refused with their
// position.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using ::testing::HasSubstr;
using testing::read;

struct CutterSpot {
    double x, y;
};

double distance_to_segment(CutterSpot p, CutterSpot a, CutterSpot b) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double along = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

/// Returns dense points of a move, computed with the C library's own functions.
std::vector<CutterSpot> cutter_spots(const Move& move, CutterSpot from) {
    std::vector<CutterSpot> out;
    const CutterSpot to = {move.end[0], move.end[1]};
    constexpr int count = 60;
    if (move.kind != MoveKind::arc) {
        for (int i = 0; i <= count; ++i)
            out.push_back({from.x + (to.x - from.x) * i / count, from.y + (to.y - from.y) * i / count});
        return out;
    }
    const double radius = std::hypot(from.x - move.centre_first, from.y - move.centre_second);
    const double begin = std::atan2(from.y - move.centre_second, from.x - move.centre_first);
    double sweep = std::atan2(to.y - move.centre_second, to.x - move.centre_first) - begin;
    const double whole = move.turns > 0 ? 2 * M_PI : -2 * M_PI;
    while (move.turns > 0 && sweep <= 1e-9) sweep += whole;
    while (move.turns < 0 && sweep >= -1e-9) sweep += whole;
    for (int i = 0; i <= count; ++i) {
        const double angle = begin + sweep * i / count;
        out.push_back({move.centre_first + radius * std::cos(angle), move.centre_second + radius * std::sin(angle)});
    }
    return out;
}

std::string place(CutterSpot p) {
    char text[64];
    std::snprintf(text, sizeof text, " X%.4f Y%.4f", p.x, p.y);
    return text;
}

/// Returns the corners of a star-shaped polygon around the origin, counter-clockwise, rounded to the decimals of the
/// program.
std::vector<CutterSpot> star() {
    const int corners = *rc::gen::inRange(4, 14);
    std::vector<CutterSpot> out;
    for (int i = 0; i < corners; ++i) {
        const double radius = *rc::gen::inRange(400, 900) / 10.0;
        const double angle = 2 * M_PI * (i + *rc::gen::inRange(0, 400) / 1000.0) / corners;
        out.push_back(
            {std::round(radius * std::cos(angle) * 1e4) / 1e4, std::round(radius * std::sin(angle) * 1e4) / 1e4});
    }
    return out;
}

const char* const cutter_preamble = "G17 G21 G90 F600\nG0 X0 Y0\n";

}  // namespace

RC_GTEST_PROP(GcodeCutter, EdgeTouchesTheContourEverywhereAndCutsItNowhere, ()) {
    const std::vector<CutterSpot> corners = star();
    const double radius = *rc::gen::inRange(5, 60) / 10.0;
    const bool inside = *rc::gen::arbitrary<bool>();
    const std::size_t count = corners.size();
    const auto middle = [&](std::size_t i, double part) {
        const CutterSpot a = corners[i % count], b = corners[(i + 1) % count];
        return CutterSpot{a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part};
    };
    std::string text =
        std::string(cutter_preamble) + (inside ? "G41.1 D" : "G42.1 D") + std::to_string(2 * radius) + "\n";
    // Approaches the first edge along the edge itself, goes round, and leaves it.
    text += "G1" + place(middle(0, 0.4)) + "\n" + "G1" + place(middle(0, 0.5)) + "\n";
    for (std::size_t i = 1; i <= count; ++i) text += "G1" + place(corners[i % count]) + "\n";
    text += "G1" + place(middle(0, 0.3)) + "\nG40\n";
    const auto program = read(text);
    // A cutter that does not fit between neighbours is refused.
    if (!program.problems.empty()) {
        RC_ASSERT(program.problems[0].status == GrblStatus::bad_target);
        RC_DISCARD("the cutter does not fit");
    }
    CutterSpot at = {0, 0};
    int number = 0;
    for (const Move& move : program.moves()) {
        const auto places = cutter_spots(move, at);
        at = places.back();
        if (++number <= 3) continue;
        for (const CutterSpot p : places) {
            double near = 1e9;
            for (std::size_t i = 0; i < count; ++i)
                near = std::min(near, distance_to_segment(p, corners[i], corners[(i + 1) % count]));
            RC_ASSERT(near < radius + cutter_tolerance_mm + 1e-4);
            // Edges that are not neighbours may come too close; the programmer must avoid this.
            double neighbours = 1e9;
            for (std::size_t i = 0; i < count; ++i) {
                const double apart = distance_to_segment(p, corners[i], corners[(i + 1) % count]);
                if (std::fabs(apart - radius) < 0.01) neighbours = std::min(neighbours, apart);
            }
            RC_ASSERT(neighbours > radius - cutter_tolerance_mm - 1e-4);
        }
    }
    RC_ASSERT(number > static_cast<int>(count));
}

RC_GTEST_PROP(GcodeCutter, LeftOfAContourIsRightOfItsMirrorImage, ()) {
    const std::vector<CutterSpot> corners = star();
    const auto path = [&](double sign, const char* side) {
        std::string text = std::string(cutter_preamble) + side + " D7\n";
        for (const CutterSpot p : corners) text += "G1" + place({p.x, sign * p.y}) + "\n";
        text += "G40 G1 X0 Y0\n";
        return read(text);
    };
    const auto one = path(1, "G41.1");
    const auto two = path(-1, "G42.1");
    RC_ASSERT(one.problems.size() == two.problems.size());
    const auto moves = one.moves(), mirrored = two.moves();
    RC_ASSERT(moves.size() == mirrored.size());
    for (std::size_t i = 0; i < moves.size(); ++i) {
        RC_ASSERT(moves[i].end[0] == mirrored[i].end[0]);
        RC_ASSERT(moves[i].end[1] == -mirrored[i].end[1]);
        RC_ASSERT(moves[i].turns == -mirrored[i].turns);
    }
}

TEST(GcodeCutter, KeepsTheCentreOfAFullCircleInsideAndOutside) {
    const auto program =
        read(std::string(cutter_preamble) +
             "G0 X50 Y-40\nG41.1 D10\nG1 X50 Y-20\nG1 X50 Y0\nG3 I-30 Z4 P3\nG1 X50 Y20\nG40 G1 X0 Y0\n"
             "G0 X50 Y-40\nG42.1 D10\nG1 X50 Y-20\nG1 X50 Y0\nG3 I-30 P2\nG1 X50 Y20\nG40 G1 X0 Y0\n");
    ASSERT_TRUE(program.problems.empty()) << program.problems[0].text();
    std::vector<Move> arcs;
    for (const Move& move : program.moves())
        if (move.kind == MoveKind::arc) arcs.push_back(move);
    ASSERT_EQ(arcs.size(), 2u);
    EXPECT_EQ(arcs[0].turns, 3);
    EXPECT_DOUBLE_EQ(arcs[0].end[0], 45);
    EXPECT_EQ(arcs[0].end[2], 4);
    EXPECT_EQ(arcs[1].turns, 2);
    EXPECT_DOUBLE_EQ(arcs[1].end[0], 55);
    for (const Move& arc : arcs) EXPECT_EQ(arc.centre_first, 20);
}

TEST(GcodeCutter, EventsStayInOrderWithTheMoves) {
    const auto program = read(std::string(cutter_preamble) + "G41.1 D6\nG1 X20 Y0\nM8\nG4 P1\nZ-1\nM0\nY-30\nM5\nM2\n");
    ASSERT_TRUE(program.problems.empty()) << program.problems[0].text();
    std::string order;
    for (const CanonCall& step : program.steps) {
        if (step.kind == CanonCallKind::move)
            order += step.move.kind == MoveKind::dwell ? 'd' : step.move.kind == MoveKind::arc ? 'a' : 'm';
        else
            order += step.kind == CanonCallKind::coolant ? 'c'
                     : step.kind == CanonCallKind::pause ? 'p'
                     : step.kind == CanonCallKind::end   ? 'e'
                                                         : 's';
    }
    EXPECT_EQ(order, "mmcdmpamse");
}

TEST(GcodeCutter, QueuesAtMostTenThousandCallsBeforeTheNextMove) {
    std::string program = "F100\nG41.1 D4\nG1 X20\n";
    for (int i = 0; i < 9'999; ++i) program += "M8\n";
    const auto good = read(program + "(a comment)\nY20\nM8\n");
    EXPECT_TRUE(good.problems.empty());
    const auto one_more = read(program + "M9\nY20\nM8\nG40\n");
    ASSERT_EQ(one_more.problems.size(), 1u);
    EXPECT_EQ(one_more.problems[0].location.line, 10'003);
    EXPECT_THAT(one_more.problems[0].message, HasSubstr("10000 steps already wait for the contour move after line 3"));
    EXPECT_EQ(one_more.steps.size(), 9'999u + 3) << "X20, Y20 and M8 with them";
    EXPECT_EQ(read(program + "G40\nM9\n").steps.size(), 9'999u + 2) << "what ends the contour lets them go";
}

TEST(GcodeCutter, DeliversTheLastMoveWithoutAProgramEnd) {
    for (const char* end : {"", "G40\n", "M2\n", "%\n", "M30"}) {
        const auto program = read(std::string("%\n") + cutter_preamble + "G42.1 D6\nG1 X20\nG1 X40\n" + end);
        ASSERT_TRUE(program.problems.empty());
        ASSERT_EQ(program.moves().size(), 3u) << end;
        EXPECT_EQ(program.moves().back().end, (Point{40, -3, 0, 0, 0, 0})) << end;
    }
}

TEST(GcodeCutter, InsertsNoArcsAtNearlyTangentCorners) {
    std::string text = std::string(cutter_preamble) + "G42.1 D6\nG1 X0 Y-100\n";
    constexpr int chords = 720;
    for (int i = 1; i <= chords; ++i)
        text += "G1" + place({100 * std::sin(2 * M_PI * i / chords), -100 * std::cos(2 * M_PI * i / chords)}) + "\n";
    const auto moves = read(text + "G40\n").moves();
    int arcs = 0;
    for (std::size_t i = 2; i < moves.size(); ++i) {
        arcs += moves[i].kind == MoveKind::arc;
        EXPECT_NEAR(std::hypot(moves[i].end[0], moves[i].end[1]), 103, 0.003);
    }
    EXPECT_EQ(arcs, 1);  // at the corner between the lead-in and the first chord
}

TEST(GcodeCutter, UsesTheDiameterOfTheTool) {
    Settings settings = testing::machine();
    settings.tools = *read_tool_table("T7 D8\nT3 D2\n");
    for (const char* way :
         {"G41 D7\n", "T7 M6\nG41\n", "T7 M6 G41 D0\n", "T3 M6\nG10 L1 P7 R4\nG41 D7\n", "M61 Q7\nG41\n"}) {
        const auto program = read(std::string(cutter_preamble) + way + "G1 X20\nG40\n", settings);
        ASSERT_TRUE(program.problems.empty()) << program.problems[0].text();
        EXPECT_EQ(program.moves().back().end[1], 4);
    }
    EXPECT_THAT(read(std::string(cutter_preamble) + "G41 D8\n", settings).problems.at(0).message,
                HasSubstr("the tool table has no tool 8"));
    EXPECT_THAT(read(std::string(cutter_preamble) + "G42\n", settings).problems.at(0).message,
                HasSubstr("no tool is in the spindle"));
}

TEST(GcodeCutter, ContourMayLeaveTheTravelWhereTheCutterDoesNot) {
    EXPECT_TRUE(
        read(std::string(cutter_preamble) + "G41.1 D20\nG1 X400 Y-505\nG1 X450\nG40 G1 X0 Y0\n").problems.empty());
    const auto program = read(std::string(cutter_preamble) + "G42.1 D20\nG1 X400 Y-495\nG1 X450\nG40 G1 X0 Y0\n");
    ASSERT_EQ(program.problems.size(), 1u);  // the lead-in is refused; the next move becomes the lead-in
    EXPECT_EQ(program.problems[0].status, GrblStatus::travel_exceeded);
    EXPECT_THAT(program.problems[0].message, HasSubstr("at the offset contour of the cutter's centre"));
}

TEST(GcodeCutter, ARefusedLineLeavesTheMoveBeforeItWaiting) {
    const auto program =
        read(std::string(cutter_preamble) + "G41.1 D6\nG1 X20\nG1 X22 Y0.5\nG18\nG1 X22 Y30 Q1\nG1 X60 Y0\nG40\n");
    ASSERT_EQ(program.problems.size(), 2u);
    EXPECT_EQ(program.problems[0].location.line, 6);
    EXPECT_EQ(program.problems[1].location.line, 7);
    EXPECT_NEAR(program.moves().back().end[1], 3, 0.05);
}

namespace {

const testing::Refused cutter_refused[] = {
    {"G41.1", 1, "D word missing"},
    {"G41.1 D2000", 7, "largest diameter is 1000 mm"},
    {"G42 D1", 1, "no tool table"},
    {"G41.1 D6\nG41.1 D6", 1, "is on already (left of the contour)"},
    {"G41.1 D6\nG42.1 D6", 1, "write G40"},
    {"G41.1 D6\nG1 X3", 1, "longer in its plane than the cutter's radius of 3 mm"},
    {"G41.1 D6\nG18", 1, "the plane cannot change"},
    {"G41.1 D6\nG20", 1, "the units cannot change"},
    {"G41.1 D6\nG55", 1, "the work offset cannot change"},
    {"G41.1 D6\nG43.1 Z5", 1, "the tool length cannot change"},
    {"G41.1 D6\nG53 G0 X20", 1, "G53 cannot be done"},
    {"G41.1 D6\nG28", 1, "G28 cannot be done"},
    {"G41.1 D6\nG92 X0", 1, "G92 cannot be done"},
    {"G41.1 D6\nG10 L2 P1 X1", 1, "G10 cannot be done"},
    {"G41.1 D6\nG93 G1 X20 F1", 1, "G93 (inverse time) cannot be used"},
    {"G41.1 D6\nT1 M6", 4, "M6 cannot change the tool"},
    {"G41.1 D6\nG81 X20 Z-1 R1", 1, "cannot drill"},
    {"G41.1 D6\nG1 X20\nG3 X20 Y4 J2", 1, "does not fit into this arc of radius 2 mm"},
    {"G41.1 D6\nG1 X20\nY2\nX10", 1, "backwards along the move of line 5"},
    {"G41.1 D6\nG1 X20\nY2\nX10 M2", 1, "backwards along the move of line 5"},
    {"G41.1 D6\nG1 X20\nX40\nG40\nG2 X60 Y20 I20", 1, "leave it with a straight move"},
    {"G41.1 D6\nG1 X20\nX40\nG40 G2 X60 Y20 I20", 5, "leave it with a straight move"},
    {"G41.1 D6\nG1 X20\nX40\nG40\nG81 X60 Y20 R2 Z1", 1, "leave it with a straight move"},
    {"G41.1 D6\nG1 X20\nG3 X40 Y0 I10\nG1 X40.5\nG3 X60.5 Y0 I10\nG1 Y1\nX50", 1, "backwards along the move of line 8"},
    {"G41.1 D30\nG1 X40\nG3 X60 Y20 J20\nG1 X20", 1, "does not fit into the corner between line 5 and this one"},
};

}  // namespace

TEST(GcodeCutter, RejectsImpossibleContoursWithPositionAndReason) {
    testing::expect_refused(cutter_preamble, cutter_refused);
}

TEST(GcodeCutter, ReportsATooShortLastMoveAtTheEndOfTheProgram) {
    const auto program = read(std::string(cutter_preamble) + "G41.1 D6\nG1 X20\nY60\nX10\nY57.5\n");
    ASSERT_EQ(program.problems.size(), 1u);
    EXPECT_EQ(program.problems[0].location, (TextPosition{7, 1}));
    EXPECT_THAT(program.problems[0].message, HasSubstr("line 7"));
}

}  // namespace motionrack::control::gcode
