// Lathe cycles G70 .. G72.2: their cuts, and material that they must not cut, checked with a numeric workpiece.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/control/gcode/cutter_geometry.hpp>
#include <motionrack/control/gcode/plane_point.hpp>
#include <optional>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

constexpr double top = 60;  ///< height of the start
constexpr double near = 1e-6;
/// Error of junctions that are nearly tangent, mm.
constexpr double rough = cutter_tolerance_mm + near;

/// Makes a contour in the orientation of a cycle: `first` along the cut, `second` away from the workpiece.
std::vector<ContourSegment> random_contour(bool arcs, double widest) {
    std::vector<ContourSegment> out;
    PlanePoint at = {0, *rc::gen::inRange(0, 40) * 1.0};
    const int count = *rc::gen::inRange(1, 8);
    for (int i = 0; i < count; ++i) {
        ContourSegment piece;
        piece.from = at;
        piece.line = i + 1;
        const bool after_upright = !out.empty() && out.back().to.first == out.back().from.first;
        const double wide =
            !after_upright && *rc::gen::inRange(0, 4) == 0 ? 0 : *rc::gen::inRange(30, 100) * widest / 100;
        const double high = *rc::gen::inRange(0, 40);
        piece.to = {at.first + wide, wide > 0 && *rc::gen::inRange(0, 3) == 0 ? at.second : high};
        if (arcs && wide > 0 && *rc::gen::inRange(0, 3) == 0) {  // a monotone bulge or groove
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
        ContourSegment piece;
        piece.from = at;
        piece.to = {at.first + 20, at.second};
        piece.line = 99;
        out.push_back(piece);
    }
    return out;
}

/// Returns the height of a move or a contour segment at a position along the cut; nothing outside of it, or if it is
/// vertical.
std::optional<double> height_at(PlanePoint from, PlanePoint to, std::int32_t turns, PlanePoint centre, double along) {
    const double min_along = std::min(from.first, to.first), max_along = std::max(from.first, to.first);
    if (along < min_along || along > max_along || max_along - min_along < near) return std::nullopt;
    if (turns == 0) return from.second + (to.second - from.second) * (along - from.first) / (to.first - from.first);
    const double radius = length(from - centre), over = along - centre.first;
    const double half = std::sqrt(std::max(0.0, radius * radius - over * over));
    return (turns < 0) == (to.first > from.first) ? centre.second + half : centre.second - half;
}

double contour_at(const std::vector<ContourSegment>& contour, double along) {
    double height = -1e9;
    for (const ContourSegment& piece : contour)
        if (const auto here = height_at(piece.from, piece.to, piece.turns, piece.centre, along))
            height = std::max(height, *here);
    return height;
}

double contour_distance_to(const ContourSegment& piece, PlanePoint p) {
    if (piece.turns == 0) {
        const PlanePoint way = piece.to - piece.from;
        const double share = std::clamp(dot(p - piece.from, way) / dot(way, way), 0.0, 1.0);
        return length(p - (piece.from + way * share));
    }
    const PlanePoint out = p - piece.centre;
    const double radius = length(piece.from - piece.centre);
    const double sense = piece.turns;
    const bool beside =
        sense * cross(piece.from - piece.centre, out) >= 0 && sense * cross(out, piece.to - piece.centre) >= 0;
    if (beside && length(out) > near) return std::fabs(length(out) - radius);
    return std::min(length(p - piece.from), length(p - piece.to));
}

double contour_distance_to(const std::vector<ContourSegment>& contour, PlanePoint p) {
    double nearest = 1e9;
    for (const ContourSegment& piece : contour) nearest = std::min(nearest, contour_distance_to(piece, p));
    return nearest;
}

/// Returns true above the contour or on it. On a vertical segment the lower side counts, because a tool may be there.
bool is_above(const std::vector<ContourSegment>& contour, PlanePoint p) {
    return p.second >= std::min(contour_at(contour, p.first - near), contour_at(contour, p.first + near)) - near ||
           contour_distance_to(contour, p) <= rough;
}

struct Moved {
    PlanePoint from;
    LatheMove move;  ///< in the orientation of the cycle

    PlanePoint at(double share) const {
        if (move.turns == 0) return from + (move.to - from) * share;
        const PlanePoint a = from - move.centre, b = move.to - move.centre;
        const double angle = std::atan2(cross(a, b), dot(a, b)) * share, c = std::cos(angle), s = std::sin(angle);
        return move.centre + PlanePoint{a.first * c - a.second * s, a.first * s + a.second * c};
    }
};

/// Executes a cycle in one of the eight orientations in X and Z. `plan`, `contour` and `out` are in the orientation of
/// the cycle; `view` converts them.
std::string cut(const CuttingOrientation& view, LatheCycle plan, std::vector<ContourSegment> contour,
                std::vector<Moved>& out) {
    for (ContourSegment& piece : contour) {
        piece.from = view.out(piece.from);
        piece.to = view.out(piece.to);
        piece.centre = view.out(piece.centre);
        piece.turns = view.turns(piece.turns);
    }
    const PlanePoint start = plan.start;
    plan.start = view.out(start);
    if (view.swapped && plan.code != 700) plan.code = static_cast<std::int16_t>(plan.code + 10);
    std::vector<LatheMove> moves;
    std::string fault = make_lathe_moves(plan, contour, plan.start, moves);
    PlanePoint at = start;
    out.clear();
    for (LatheMove move : moves) {
        move.to = view.in(move.to);
        move.centre = view.in(move.centre);
        move.turns = view.turns(move.turns);
        out.push_back({at, move});
        at = move.to;
    }
    return fault;
}

CuttingOrientation random_view() {
    CuttingOrientation view;
    view.swapped = *rc::gen::arbitrary<bool>();
    view.along = *rc::gen::arbitrary<bool>() ? 1 : -1;
    view.away = *rc::gen::arbitrary<bool>() ? 1 : -1;
    return view;
}

/// Returns the remaining radius of a cylinder at a position, after some moves.
double left_at(const std::vector<Moved>& moves, std::size_t count, double along) {
    double height = top;
    for (std::size_t i = 0; i < count; ++i) {
        const Moved& one = moves[i];
        if (one.move.kind == MoveKind::rapid) continue;
        if (const auto here = height_at(one.from, one.move.to, one.move.turns, one.move.centre, along))
            height = std::min(height, *here);
    }
    return height;
}

}  // namespace

RC_GTEST_PROP(GcodeLathe, NeverCutsIntoTheAllowanceNorDeeperThanIAtOnceNorRapidsThroughThePiece, ()) {
    const auto contour = random_contour(true, 30);
    LatheCycle plan;
    plan.start = {-2, top};
    plan.distance = *rc::gen::inRange(0, 3) == 0 ? 0 : *rc::gen::inRange(1, 15) / 10.0;
    plan.depth = *rc::gen::inRange(5, 90) / 10.0;
    plan.retract = *rc::gen::inRange(0, 20) / 10.0;
    std::vector<Moved> moves;
    const std::string fault = cut(random_view(), plan, contour, moves);
    if (!fault.empty()) RC_DISCARD("no room");
    RC_ASSERT(!moves.empty());
    const double begin = contour.front().from.first + plan.distance, end = contour.back().to.first - plan.distance;
    // The levels begin on the line from the start to the start of the offset contour. If the contour descends at once,
    // that point is behind its first corner, and the line passes the corner at less than D.
    std::vector<ContourSegment> beside;
    RC_ASSERT(offset_contour(contour, plan.distance, beside) == "");
    ContourSegment way_in;
    way_in.from = plan.start, way_in.to = beside.front().from;
    const double over_corner = std::min(plan.distance, contour_distance_to(way_in, contour.front().from));
    for (std::size_t i = 0; i < moves.size(); ++i) {
        for (int k = 0; k <= 12; ++k) {
            const PlanePoint p = moves[i].at((k + 0.37) / 13);
            RC_ASSERT(contour_distance_to(contour, p) >=
                      (p.first < way_in.to.first ? over_corner : plan.distance) - rough);
            RC_ASSERT(is_above(contour, p));
            if (p.first <= begin + near || p.first >= end - near ||
                std::fabs(moves[i].move.to.first - moves[i].from.first) < near)
                continue;
            const double left = left_at(moves, i, p.first);
            if (moves[i].move.kind == MoveKind::rapid)
                RC_ASSERT(p.second >= left - rough);
            else
                RC_ASSERT(left - p.second <= plan.depth + rough);
        }
    }
}

RC_GTEST_PROP(GcodeLathe, LeavesNothingOnTheContourButD, ()) {
    const auto contour = random_contour(true, 30);
    LatheCycle plan;
    plan.start = {-2, top};
    plan.depth = *rc::gen::inRange(5, 90) / 10.0;
    const CuttingOrientation view = random_view();
    std::vector<Moved> moves;
    RC_ASSERT(cut(view, plan, contour, moves) == "");
    for (const ContourSegment& piece : contour)
        for (const double share : {0.21, 0.5, 0.83}) {
            const double along = piece.from.first + (piece.to.first - piece.from.first) * share;
            if (piece.to.first - piece.from.first < near) continue;
            RC_ASSERT(std::fabs(left_at(moves, moves.size(), along) - contour_at(contour, along)) < 1e-5);
        }
    RC_ASSERT(std::fabs(moves.back().move.to.first - contour.back().to.first) < near);
    RC_ASSERT(std::fabs(moves.back().move.to.second - top) < near);
    // G71.1 (without pockets) and then G71.2 (pockets only) cut the same contour as G71.
    std::vector<Moved> rest;
    plan.code = 711;
    RC_ASSERT(cut(view, plan, contour, moves) == "");
    plan.code = 712;
    RC_ASSERT(cut(view, plan, contour, rest) == "");
    moves.insert(moves.end(), rest.begin(), rest.end());
    for (int k = 1; k < 40; ++k) {
        const double along = contour.back().to.first * (k + 0.2928932) / 41;  // no vertical segment is there
        RC_ASSERT(std::fabs(left_at(moves, moves.size(), along) - contour_at(contour, along)) < 1e-5);
    }
}

RC_GTEST_PROP(GcodeLathe, FinishesAlongTheContourInPassesThatComeNearer, ()) {
    const auto contour = random_contour(true, 30);
    LatheCycle plan;
    plan.code = 700;
    plan.start = {-2, top};
    plan.distance = *rc::gen::inRange(0, 20) / 10.0;
    plan.end_distance = *rc::gen::inRange(0, 10) / 10.0;
    plan.passes = *rc::gen::inRange(1, 4);
    std::vector<Moved> moves;
    CuttingOrientation view;  // not transverse: a contour that is monotone along both axes is cut along Z
    view.along = *rc::gen::arbitrary<bool>() ? 1 : -1;
    view.away = *rc::gen::arbitrary<bool>() ? 1 : -1;
    if (!cut(view, plan, contour, moves).empty()) RC_DISCARD("no room");
    double nearest = 1e9;
    for (const Moved& one : moves)
        for (int k = 0; k <= 12; ++k) {
            const PlanePoint p = one.at(k / 12.0);
            nearest = std::min(nearest, contour_distance_to(contour, p));
            RC_ASSERT(is_above(contour, p));
        }
    const double last = plan.end_distance, first = last + (plan.distance - last) * (plan.passes - 1) / plan.passes;
    RC_ASSERT(std::fabs(nearest - std::min(first, last)) < rough);
}

RC_GTEST_PROP(GcodeLathe, LeadsThroughNothingThatIsToBeLeftFromWhereverItStarts, ()) {
    const auto contour = random_contour(true, 30);
    LatheCycle plan;
    plan.code = *rc::gen::element<std::int16_t>(700, 710, 711, 712);
    plan.start = {*rc::gen::inRange(-5, 60) * 1.0, contour.front().from.second + *rc::gen::inRange(1, 60)};
    plan.distance = *rc::gen::inRange(0, 20) / 10.0;
    plan.end_distance = *rc::gen::inRange(0, 10) / 10.0;
    plan.passes = *rc::gen::inRange(1, 4);
    plan.depth = *rc::gen::inRange(5, 90) / 10.0;
    plan.retract = *rc::gen::inRange(0, 20) / 10.0;
    CuttingOrientation view;
    view.along = *rc::gen::arbitrary<bool>() ? 1 : -1;
    view.away = *rc::gen::arbitrary<bool>() ? 1 : -1;
    std::vector<Moved> moves;
    if (!is_above(contour, plan.start) || !cut(view, plan, contour, moves).empty()) RC_DISCARD("no room");
    for (const Moved& one : moves)
        for (int k = 0; k <= 12; ++k) RC_ASSERT(is_above(contour, one.at(k / 12.0)));
}

/// Executes G70 in two passes along a contour; expects that no move is below the contour.
void expect_finished_above(const std::vector<ContourSegment>& contour, PlanePoint start, double distance,
                           double end_distance) {
    LatheCycle plan;
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

TEST(GcodeLathe, FinishingRetractsOverABulgeThatEndsAtItsStartDiameter) {
    expect_finished_above({{{0, 1}, {19.2, 1}, -1, {9.6, 1}, 0, false, 1}}, {-2, top}, 0, 0);
}

// In the offset contour, the arc of the groove is slightly longer than a half circle, because the bulge begins within
// the tolerance of its end.
TEST(GcodeLathe, FinishingRetractsOverABulgeBehindAGrooveThatItNearlyTouches) {
    expect_finished_above(
        {{{0, 0}, {12.9, 0}, 1, {6.45, 0}, 0, false, 1}, {{12.9, 0}, {27.6, 0}, -1, {20.25, -0.147}, 0, false, 2}},
        {-2, top}, 0, 0.2);
}

TEST(GcodeLathe, FinishingRetractsOverABulgeAboveTheStart) {
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

}  // namespace motionrack::control::gcode
