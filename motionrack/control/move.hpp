// The canonical move: the motion that a part program requests, in machine coordinates, independent of the dialect.
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::control {

/// Number and letters of the axes: X Y Z in mm, A B C in degrees, always in this order.
inline constexpr int axis_count = 6;
inline constexpr std::array<char, axis_count> axis_letters = {'X', 'Y', 'Z', 'A', 'B', 'C'};
using Point = std::array<double, axis_count>;

enum class MoveKind : std::uint8_t {
    rapid,  ///< straight, as fast as the axes allow (G0)
    feed,   ///< straight at the feed rate (G1)
    arc,    ///< arc or helix at the feed rate (G2, G3)
    dwell   ///< no motion for `seconds` (G4)
};

/// Path control between this move and the next (G61, G61.1, G64).
enum class PathControl : std::uint8_t {
    exact_path,  ///< G61: never leaves the path; stops where the direction changes, passes tangent junctions
    exact_stop,  ///< G61.1: stops at the end of every move
    continuous   ///< G64 P: within `tolerance_mm` of the path
};

enum class FeedMode : std::uint8_t {
    units_per_second,  ///< G94: `feed` is mm/s along XYZ (deg/s along ABC if XYZ do not move)
    inverse_time       ///< G93: `feed` is 1/s; the move takes 1/feed seconds
};

/// One move, absolute machine coordinates. An arc turns in the plane of axes `first` and `second` (0 X, 1 Y, 2 Z; G17 =
/// 0,1; G18 = 2,0; G19 = 1,2) about (centre_first, centre_second), `turns` > 0 counter-clockwise seen from the positive
/// third axis, < 0 clockwise; |turns| is the number of full or partial turns; the other axes move linearly with the
/// angle.
struct Move {
    MoveKind kind = MoveKind::rapid;
    PathControl path = PathControl::exact_path;
    FeedMode feed_mode = FeedMode::units_per_second;
    std::uint8_t first = 0;
    std::uint8_t second = 1;
    std::int32_t turns = 0;
    std::int32_t line = 0;  ///< source line, from 1
    std::int64_t index =
        -1;  ///< number among the moves of the program, as read, from 0; kept by its parts; -1: not from a program
    double feed = 0;            ///< see FeedMode; ignored by rapids and dwells
    double rapid_override = 1;  ///< rapids: share of the axes' maximum velocities, above 0 to 1
    double tolerance_mm = 0;    ///< largest deviation from the path with PathControl::continuous
    double centre_first = 0;    ///< arc: centre on axis `first`, mm
    double centre_second = 0;   ///< arc: centre on axis `second`, mm
    double seconds = 0;         ///< dwell: its duration, s
    Point end = {};             ///< target position
};

}  // namespace motionrack::control
