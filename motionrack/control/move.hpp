// The canonical move: what a part program means, in machine coordinates, whatever dialect it was written in.
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::control {

/// X Y Z in mm, A B C in degrees, always in this order.
inline constexpr int axis_count = 6;
inline constexpr std::array<char, axis_count> axis_letters = {'X', 'Y', 'Z', 'A', 'B', 'C'};
using Point = std::array<double, axis_count>;

enum class MoveKind : std::uint8_t {
    rapid,  ///< straight, as fast as the axes allow (G0)
    feed,   ///< straight at the feed (G1)
    arc,    ///< arc or helix at the feed (G2, G3)
    dwell   ///< nothing moves for `seconds` (G4)
};

/// What the path does between this move and the next (G61, G61.1, G64).
enum class PathControl : std::uint8_t {
    exact_path,  ///< G61: never leaves the path; stands still where the direction changes, passes tangent joints
    exact_stop,  ///< G61.1: stands still at the end of every move
    continuous   ///< G64 P: within `tolerance_mm` of the path
};

enum class FeedMode : std::uint8_t {
    units_per_second,  ///< G94: `feed` is mm/s along XYZ (deg/s along ABC where no XYZ moves)
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
    std::int32_t line = 0;      ///< line of the source, from 1
    std::int64_t index = -1;    ///< of the program's moves, as they were read, from 0; its parts keep it; -1: of none
    double feed = 0;            ///< see FeedMode; not used by traverse and dwell
    double rapid_override = 1;  ///< traverse: part of the axes' greatest speed, above 0 to 1
    double tolerance_mm = 0;    ///< for PathControl::continuous
    double centre_first = 0;    ///< mm
    double centre_second = 0;   ///< mm
    double seconds = 0;         ///< dwell only
    Point end = {};             ///< where the move ends
};

}  // namespace motionrack::control
