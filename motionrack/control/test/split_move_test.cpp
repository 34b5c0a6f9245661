// Parts of a move: together they equal the move, and a remaining move ends where the whole move ends.
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/control/split_move.hpp>

namespace motionrack::control {
namespace {

Move straight_to(double x, double y, double a = 0) {
    Move move;
    move.kind = MoveKind::feed;
    move.feed = 10;
    move.end = {x, y, 0, a, 0, 0};
    return move;
}

/// Makes a helix from (10, 0) about (0, 0), `turn` of a circle long.
Move helix(double turn, double z, bool counter_clockwise = true) {
    Move move;
    move.kind = MoveKind::arc;
    move.feed = 10;
    move.turns = counter_clockwise ? 1 : -1;
    const double angle = (counter_clockwise ? 1 : -1) * turn * 2 * 3.14159265358979;
    move.end = {10 * std::cos(angle), 10 * std::sin(angle), z, 0, 0, 0};
    return move;
}

constexpr Point at_ten = {10, 0, 0, 0, 0, 0};

TEST(SubMoves, CoverItsPathContiguouslyToItsEnd) {
    for (const Move& whole : {straight_to(3, -4, 77), helix(0.6, 5), helix(0.6, 5, false), helix(1, 0)}) {
        const Geometry path = geometry_of(whole, at_ten);
        Point at = at_ten;
        double length = 0;
        for (int i = 0; i < 7; ++i) {
            const Move part =
                sub_move(whole, path, path.length * i / 7, i == 6 ? path.length : path.length * (i + 1) / 7);
            const Geometry piece = geometry_of(part, at);
            EXPECT_NEAR(piece.length, path.length / 7, 1e-9);
            for (double s = 0; s <= 1; s += 0.25) {
                const Point position = position_at(piece, s * piece.length);
                EXPECT_LT(distance_to(path, position[0], position[1], position[2]), 1e-9);
            }
            length += piece.length;
            at = part.end;
        }
        EXPECT_NEAR(length, path.length, 1e-9);
        EXPECT_EQ(at, whole.end);
    }
}

TEST(SubMoves, InInverseTimeTakeTheirShareOfTheTime) {
    Move whole = straight_to(0, 0);
    whole.feed_mode = FeedMode::inverse_time;
    whole.feed = 0.5;  // 2 s
    const Geometry path = geometry_of(whole, at_ten);
    EXPECT_DOUBLE_EQ(sub_move(whole, path, 2, 4).feed, 2.5);  // 0.4 s
    EXPECT_DOUBLE_EQ(remaining_move(whole, path, {2.5, 0, 0, 0, 0, 0}).feed, 2);
}

TEST(RemainingMove, ContinuesFromAPositionBesideThePath) {
    for (const Move& whole : {helix(0.3, 0), helix(0.3, 0, false), helix(0.3, 2)}) {
        const Geometry path = geometry_of(whole, at_ten);
        for (double part = 0; part < 0.999; part += 0.1) {
            Point position = position_at(path, part * path.length);
            position[0] += 0.001;
            EXPECT_NEAR(nearest_point(path, position).length, part * path.length, 0.002);
            const Geometry rest = geometry_of(remaining_move(whole, path, position), position);
            EXPECT_EQ(rest.shape, PathShape::arc);
            EXPECT_NEAR(rest.length, (1 - part) * path.length, 0.002);
            EXPECT_EQ(rest.end, whole.end);
        }
    }
}

TEST(RemainingMove, OnASteepHelixIsFoundByItsHeight) {
    const PulsesPerUnit pulses = {2560, 2560, 2560, 0, 0, 0};
    for (const double turn : {0.00001, 0.001, 0.99}) {
        const Move whole = helix(turn, 1);
        const Geometry path = geometry_of(whole, at_ten);
        for (const double part : {0.0, 0.001, 0.078, 0.5, 0.99, 1.0}) {
            SCOPED_TRACE(testing::Message() << turn << " turns, at " << part);
            Point position = position_at(path, part * path.length);
            for (const double off : {-0.0004, 0.0004}) {  // about a pulse
                position[1] += off;
                const NearestPoint nearest = nearest_point(path, position, pulses);
                EXPECT_NEAR(nearest.length, part * path.length, 0.001);
                EXPECT_LT(nearest.distance, 2.1);
                const Geometry rest = geometry_of(remaining_move(whole, path, position, pulses), position);
                EXPECT_NEAR(rest.length, (1 - part) * path.length, 0.001);
                position[1] -= off;
            }
        }
    }
}

TEST(RemainingMove, OnAFlatHelixIsFoundByItsAngle) {
    const PulsesPerUnit pulses = {640, 640, 640, 0, 0, 0};
    for (const double turn : {0.3, 0.99, 1.0}) {
        const Move whole = helix(turn, 0.002);  // rises by about a pulse
        const Geometry path = geometry_of(whole, at_ten);
        for (const double part : {0.1, 0.4, 0.6, 0.9}) {
            SCOPED_TRACE(testing::Message() << turn << " turns, at " << part);
            for (const double height : {0.0, 0.002}) {
                Point position = position_at(path, part * path.length);
                position[2] = height;
                EXPECT_NEAR(nearest_point(path, position, pulses).length, part * path.length, 0.001);
            }
        }
    }
}

TEST(RemainingMove, PastItsEndIsAStraightLineBackInsteadOfAFullTurn) {
    const Move whole = helix(0.25, 0);
    const Geometry path = geometry_of(whole, at_ten);
    const Geometry rest = geometry_of(remaining_move(whole, path, {-0.001, 10, 0, 0, 0, 0}), {-0.001, 10, 0, 0, 0, 0});
    EXPECT_EQ(rest.shape, PathShape::line);
    EXPECT_LT(rest.length, 0.0011);
}

TEST(NearestPointOnPath, OfRotaryAxesAloneIsFound) {
    Move whole = straight_to(10, 0, 90);
    const Geometry path = geometry_of(whole, at_ten);
    EXPECT_EQ(path.shape, PathShape::rotary);
    EXPECT_NEAR(nearest_point(path, {10, 0, 0, 30, 0, 0}).length, 30, 1e-9);
    EXPECT_NEAR(nearest_point(path, {10, 0, 0, 100, 0, 0}).distance, 10, 1e-9);
    EXPECT_NEAR(nearest_point(path, {9.5, 0, 0, 30, 0, 0}).distance, 0.5, 1e-9);
}

TEST(NearestPointOnPath, WeighsEachAxisInItsPulses) {
    const Geometry path = geometry_of(straight_to(20, 0, 90), at_ten);
    const PulsesPerUnit pulses = {640, 640, 640, 10, 0, 0};
    const Point half_way = {15, 0, 0, 45, 0, 0}, turned_wrong = {15, 0, 0, 47, 0, 0}, beside = {15, 0, 0.5, 45, 7, 0};
    EXPECT_NEAR(nearest_point(path, half_way, pulses).distance, 0, 1e-9);
    EXPECT_NEAR(nearest_point(path, turned_wrong, pulses).distance, 20, 1);
    EXPECT_NEAR(nearest_point(path, beside, pulses).distance, 320, 1e-9);
}

}  // namespace
}  // namespace motionrack::control
