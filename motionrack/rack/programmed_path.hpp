// The path as programmed, move by move: before short moves are merged, corners are blended and positions are rounded to
// pulses. It is the reference for the machine's deviation.
//
//   ProgramExecutor, StreamExecutor --each move as read--> moves --machine position--> distance, tolerance there
//                                                            '-- moves before the current one: dropped
#pragma once

#include <cstdint>
#include <deque>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::rack {

/// Distance of a position from the program.
struct ProgramDistance {
    double mm = 0;  ///< distance to the nearest move
    /// Distance and tolerance at the move with the smallest distance beyond its tolerance: G64 P, 0 with G61.
    double judged_mm = 0, tolerance_mm = 0;
};

/// Moves of the program on which the machine must be.
struct ProgramPart {
    std::int64_t first = 0, last = 0;  ///< indices; part of the path before the first counts, too
    std::int64_t furthest = 0;         ///< move that the machine has certainly reached
    double reach_mm = 0;               ///< limit along the path after the end of that move
};

class ProgrammedPath {
  public:
    /// Appends a move of the program and its start. Dwells are left out.
    void add(const control::Move& move, const control::Point& start);
    /// Drops the moves that are no longer needed. Part of the path before `first` is kept.
    void drop_before(std::int64_t first);
    ProgramDistance distance(const ProgramPart& part, double x, double y, double z) const;

  private:
    struct Programmed {
        std::int64_t index = 0;
        double tolerance_mm = 0;
        double begins_mm = 0, length_mm = 0;  ///< along the XYZ path
        control::Geometry path;
    };
    using Moves = std::deque<Programmed>;
    /// Returns the move that is `overlap_mm` before the start of `first`, or the first stored one.
    Moves::const_iterator begin_of(std::int64_t first) const;
    Moves::const_iterator skip(const Moves::const_iterator& move, double mm) const;

    Moves moves_;
    double max_tolerance_mm_ = 0;
};

}  // namespace motionrack::rack
