// The moves of a trajectory generator that are not fully executed, by their numbers in the order of push, from 0.
#pragma once

#include <cstdint>
#include <deque>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// A move with data for the caller.
struct TrajectoryMove {
    Move move;
    bool overridable = true;  ///< false: ignores the feed override
    std::uint8_t axes = 0;    ///< axes that move, one bit each
};

/// Segments carry the tag of their move instead of a line: its number modulo a power of two.
class PendingMoves {
  public:
    /// Adds a move and returns its tag.
    std::int32_t push(const TrajectoryMove& move);
    /// Marks all pushed moves as known to their end.
    void flush() { flushed_ = pushed_; }
    /// Notes that the path builder has returned an element of the move with this tag.
    void report(std::int32_t tag) { reported_ = number_of(tag); }
    /// Removes the moves before number `number`.
    void forget_before(std::int64_t number);

    std::int64_t number_of(std::int32_t tag) const;
    /// Returns the number of pushed moves.
    std::int64_t pushed() const { return pushed_; }
    /// Returns the first move of which the path builder may keep a part; pushed() if it keeps nothing.
    std::int64_t first_in_builder() const;
    const TrajectoryMove& move(std::int64_t number) const { return moves_[static_cast<std::size_t>(number - first_)]; }

  private:
    std::deque<TrajectoryMove> moves_;
    std::int64_t pushed_ = 0, first_ = 0;  ///< number of pushed moves, and number of the first one in moves_
    std::int64_t flushed_ = 0;             ///< all moves before this one are known to their end
    std::int64_t reported_ = 0;            ///< move of the last element that the builder has returned
};

}  // namespace motionrack::control
