// G5 and G5.1: the arcs are within tolerance of the programmed curve and tangent to each other.
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

struct Spot {
    double x, y;
};

/// Returns the point of a cubic at t, 0 .. 1, as a sum of Bernstein polynomials, unlike the reader.
Spot curve_at(const std::array<Spot, 4>& p, double t) {
    const double u = 1 - t;
    const double b[] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
    return {b[0] * p[0].x + b[1] * p[1].x + b[2] * p[2].x + b[3] * p[3].x,
            b[0] * p[0].y + b[1] * p[1].y + b[2] * p[2].y + b[3] * p[3].y};
}

double apart(Spot a, Spot b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

double to_segment(Spot p, Spot a, Spot b) {
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const double along = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
    return apart(p, {a.x + along * dx, a.y + along * dy});
}

/// Returns points along moves, computed with the C library's functions; less than 0.05 mm apart.
std::vector<Spot> spots(const std::vector<Move>& moves, Spot from) {
    std::vector<Spot> out = {from};
    for (const Move& move : moves) {
        const Spot to = {move.end[0], move.end[1]};
        if (move.kind == MoveKind::arc) {
            const Spot c = {move.centre_first, move.centre_second};
            const double radius = apart(from, c);
            EXPECT_NEAR(radius, apart(to, c), 1e-6 * std::max(1.0, radius / 1000));
            const double begin = std::atan2(from.y - c.y, from.x - c.x);
            double sweep = std::atan2(to.y - c.y, to.x - c.x) - begin;
            if (move.turns > 0 && sweep < 0) sweep += 2 * M_PI;
            if (move.turns < 0 && sweep > 0) sweep -= 2 * M_PI;
            EXPECT_LT(std::fabs(sweep), M_PI / 2);
            const int count = 2 + static_cast<int>(std::fabs(sweep) * radius / 0.05);
            for (int i = 1; i < count; ++i)
                out.push_back({c.x + radius * std::cos(begin + sweep * i / count),
                               c.y + radius * std::sin(begin + sweep * i / count)});
        }
        out.push_back(to);
        from = to;
    }
    return out;
}

/// Returns the largest distance of `places` from the polyline through `line`; both have the same direction.
double farthest(const std::vector<Spot>& places, const std::vector<Spot>& line) {
    double max_error = 0;
    std::size_t near = 0;
    for (const Spot p : places) {
        double best = 1e9;
        const std::size_t low = near > 50 ? near - 50 : 0;
        for (std::size_t i = low; i + 1 < line.size() && i < near + 600; ++i) {
            const double d = to_segment(p, line[i], line[i + 1]);
            if (d < best) best = d, near = i;
        }
        max_error = std::max(max_error, best);
    }
    return max_error;
}

double in_tenths() {
    return *rc::gen::inRange(-400, 401) / 10.0;
}

std::string words(const char* letters, std::initializer_list<double> values) {
    std::string out;
    for (const double value : values) {
        char text[40];
        std::snprintf(text, sizeof text, " %c%.4f", *letters++, value);
        out += text;
    }
    return out;
}

const char* const spline_preamble = "G17 G21 G90 F600\n";

}  // namespace

RC_GTEST_PROP(GcodeSpline, ArcsAreWithinAMicrometreOfTheCubicBothWays, ()) {
    const Spot start = {in_tenths(), in_tenths()}, end = {in_tenths(), in_tenths()};
    const Spot i = {in_tenths(), in_tenths()}, p = {in_tenths(), in_tenths()};
    const auto program = read(spline_preamble + ("G0" + words("XY", {start.x, start.y})) + "\nG5" +
                              words("XYIJPQ", {end.x, end.y, i.x, i.y, p.x, p.y}));
    const std::array<Spot, 4> points = {start, Spot{start.x + i.x, start.y + i.y}, Spot{end.x + p.x, end.y + p.y}, end};
    RC_ASSERT(program.problems.empty());
    auto moves = program.moves();
    moves.erase(moves.begin());
    RC_ASSERT(moves.back().end[0] == end.x && moves.back().end[1] == end.y);
    RC_ASSERT(moves.size() < 400);
    std::vector<Spot> fine;
    constexpr int count = 6'000;
    for (int k = 0; k <= count; ++k) fine.push_back(curve_at(points, static_cast<double>(k) / count));
    const std::vector<Spot> driven = spots(moves, start);
    RC_ASSERT(farthest(driven, fine) <= spline_tolerance_mm);
    // Chords of the sampled points are within 0.05^2 / 8 r of the arcs; so the comparison allows slightly more.
    double max_error = 0;
    for (std::size_t k = 0; k < fine.size(); k += 29) {
        double best = 1e9;
        for (std::size_t m = 0; m + 1 < driven.size(); ++m)
            best = std::min(best, to_segment(fine[k], driven[m], driven[m + 1]));
        max_error = std::max(max_error, best);
    }
    RC_ASSERT(max_error <= spline_tolerance_mm + 1e-4);
}

TEST(GcodeSpline, ArcsJoinTangentially) {
    auto moves = read(std::string(spline_preamble) + "G5 X60 Y0 I10 J40 P-30 Q20\nX120 P-10 Q-35\n").moves();
    ASSERT_GT(moves.size(), 8u);
    double x = 0, y = 0, out_x = 10 / std::hypot(10, 40), out_y = 40 / std::hypot(10, 40);
    for (const Move& move : moves) {
        ASSERT_EQ(move.kind, MoveKind::arc);
        const double sense = move.turns;
        const auto along = [&](double px, double py, double& tx, double& ty) {
            const double rx = px - move.centre_first, ry = py - move.centre_second, r = std::hypot(rx, ry);
            tx = -ry / r * sense, ty = rx / r * sense;
        };
        double tx = 0, ty = 0;
        along(x, y, tx, ty);
        EXPECT_NEAR(tx, out_x, 1e-9);
        EXPECT_NEAR(ty, out_y, 1e-9);
        x = move.end[0], y = move.end[1];
        along(x, y, out_x, out_y);
        EXPECT_EQ(move.feed, 10);
    }
    EXPECT_NEAR(out_x, 10 / std::hypot(10, 35), 1e-9);
}

TEST(GcodeSpline, QuadraticIsItsCubic) {
    const auto one = read(std::string(spline_preamble) + "G1 X10 Y5\nG91 G5.1 X30 Y0 I15 J30\n").moves();
    const auto two = read(std::string(spline_preamble) + "G1 X10 Y5\nG5 X40 Y5 I10 J20 P-10 Q20\n").moves();
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i)
        for (const int axis : {0, 1})
            EXPECT_NEAR(one[i].end[static_cast<std::size_t>(axis)], two[i].end[static_cast<std::size_t>(axis)], 1e-9);
}

TEST(GcodeSpline, InchesMeanTheSameCurve) {
    const auto one = read("G17 G20 F60\nG5 X1 Y1 I1 J0 P0 Q-1\n").moves();
    const auto two = read("G17 G21 F1524\nG5 X25.4 Y25.4 I25.4 J0 P0 Q-25.4\n").moves();
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(testing::describe(one[i]), testing::describe(two[i]));
}

TEST(GcodeSpline, CuspsLoopsStraightLinesAndZeroLengthHandlesAreAccepted) {
    for (const char* line :
         {"G5 X40 Y0 I40 J40 P-40 Q40", "G5 X10 Y0 I60 J40 P-60 Q40", "G5 X40 Y0 I10 J0 P-10 Q0",
          "G5 X40 Y0 I0 J0 P0 Q0", "G5 X40 Y20 I0 J0 P-10 Q0", "G5 X40 Y20 I10 J0 P0 Q0", "G5 X40 Y0 I-20 J0 P20 Q0",
          "G5 X0 Y0 I60 J40 P-60 Q40", "G5 X40 Y0 I0.000001 J0 P0 Q0.000001", "G5 X0.0001 Y0 I0.0001 J0.0001 P0 Q0",
          "G5.1 X40 Y0 I-20 J0"}) {
        const auto program = read(std::string(spline_preamble) + line);
        ASSERT_TRUE(program.problems.empty()) << program.problems[0].text();
        EXPECT_LT(program.moves().size(), 300u) << line;
    }
}

TEST(GcodeSpline, CurveStaysWithinTheTravel) {
    // The curve starts tangentially to the travel limit, so a junction of its arcs could lie outside.
    const auto program = read(std::string(spline_preamble) + "G0 X-500 Y0\nG5 X-400 Y300 I0 J100 P-90 Q-30\n");
    ASSERT_TRUE(program.problems.empty()) << program.problems[0].text();
    for (const Move& move : program.moves()) EXPECT_GE(move.end[0], -500 - limit_slack);
}

namespace {

const testing::Refused spline_refused[] = {
    {"G5 X10 Y0 I1 J1", 1, "needs P and Q"},
    {"G5 X10 Y0 I1 J1 P1", 1, "needs P and Q"},
    {"G5 X10 Y0 P1 Q1", 1, "only a G5 right after another may omit"},
    {"G5 X10 Y0 I1 J1 P1 Q1\nG1 X5\nG5 X0 P1 Q1", 1, "only a G5 right after another may omit"},
    {"G5 X10 Y0 I1 P1 Q1", 1, "J word missing"},
    {"G5 X10 Y0 J1 P1 Q1", 1, "I word missing"},
    {"G5 I1 J1 P1 Q1", 1, "needs its end"},
    {"G5", 1, "needs its end"},
    {"G5.1 X10", 1, "needs I or J"},
    {"G5.1 X10 I0 J0", 1, "needs I or J"},
    {"G5.1 X10 I5 J0 P1", 16, "nothing on this line uses the P word"},
    {"G5 X0 Y0 I0 J0 P0 Q0", 1, "no length"},
    {"G18 G5 X10 I1 J1 P1 Q1", 5, "write G17"},
    {"G5 X10 Z1 I1 J1 P1 Q1", 8, "moves X and Y only"},
    {"G5 X10 I1 J1 K1 P1 Q1", 14, "nothing on this line uses the K word"},
    {"G93 F1 G5 X10 I1 J1 P1 Q1", 8, "inverse time"},
    {"G41.1 D2\nG5 X10 I1 J1 P1 Q1", 1, "cutter compensation"},
    {"G5 X400 Y0 I300 J0 P300 Q0", 1, "this curve exceeds the travel"},
    {"G5.2 X10 Y0 P1", 1, "NURBS are not supported"},
    {"G4 P-1", 4, "negative"},
    {"G5 X10 Y0 I1 J1 P1 Q1\nG4 P-1", 4, "negative"},
};

}  // namespace

TEST(GcodeSpline, RejectsImpossibleContoursWithPositionAndReason) {
    testing::expect_refused(spline_preamble, spline_refused);
}

}  // namespace motionrack::control::gcode
