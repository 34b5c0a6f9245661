// Queue of canonical calls that wait because the move before them may change: with cutter compensation the next move
// determines the end of a move.
//
//     lines read:   G1 X10   M8     G1 Z-1   G1 Y10
//     held:         [X10]    [X10   [X10     [Y10]         ready: X10 with its end, M8, Z-1, the corner arc
//                             M8]    M8 Z-1]
#pragma once

#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/control/gcode/cutter_geometry.hpp>
#include <vector>

namespace motionrack::control::gcode {

class CompensationQueue {
  public:
    /// Maximum number of calls that wait for one move.
    static constexpr std::size_t max_steps = 10'000;

    bool full() const { return steps_.size() >= max_steps; }
    void push(const CanonCall& step) { steps_.push_back(step); }

    /// Sets the ends of the waiting move (the first call) and of the moves behind it to the end of `path`. The axes of
    /// the plane are `first` and `second`. All calls become ready.
    void settle(std::size_t first, std::size_t second, const CutterPath& path);
    /// Makes all calls ready without changes.
    void settle() { ready_ = steps_.size(); }

    bool has_ready() const { return next_ < ready_; }
    /// Returns the next ready call, valid until push() is called; null if there is none.
    const CanonCall* next();
    /// Returns true if the last call from next() was queued before the current line.
    bool was_held() const { return next_ <= of_lines_before_; }
    /// Drops ready calls that next() has not returned.
    void begin_line() {
        if (!steps_.empty()) {
            next_ = ready_;
            next();
        }
        of_lines_before_ = steps_.size();
    }
    void clear();

  private:
    std::vector<CanonCall> steps_;
    std::size_t next_ = 0;   ///< number of calls that next() has returned
    std::size_t ready_ = 0;  ///< number of calls that are final
    std::size_t of_lines_before_ = 0;
};

}  // namespace motionrack::control::gcode
