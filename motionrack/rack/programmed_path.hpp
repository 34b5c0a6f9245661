// The path as the program has it, move by move: before short moves are merged, corners are cut and places are rounded
// to pulses. What the machine does is held against it.
//
//   ProgramExecutor, Stream --each move as it was read--> moves --where the machine is--> distance, tolerance there
//                                                      '-- before the one that is driven: dropped
#pragma once

#include <cstdint>
#include <deque>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::rack {

/// How far a place is from the program.
struct ProgramDistance {
    double mm = 0;  ///< from the nearest move
    /// From the move of which it is least beside its tolerance, and this tolerance: G64 P, 0 with G61.
    double judged_mm = 0, tolerance_mm = 0;
};

/// Moves of the program between which the machine must be.
struct ProgramPart {
    std::int64_t first = 0, last = 0;  ///< indices; some of the path in front of the first counts, too
    double reach_mm = 0;               ///< no farther than this along the path behind the first
};

class ProgrammedPath {
  public:
    /// The next move of the program, and where it starts. Dwells are left out.
    void add(const control::Move& move, const control::Point& start);
    /// The moves before are not asked for any more, but for some of the path in front of `first`.
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
    /// The one in front of the first on its path, or so much before.
    Moves::const_iterator begin_of(std::int64_t first) const;
    Moves::const_iterator skip(const Moves::const_iterator& move, double mm) const;

    Moves moves_;
    double max_tolerance_mm_ = 0;
};

}  // namespace motionrack::rack
