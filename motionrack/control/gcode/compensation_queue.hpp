// Steps that wait because the move before them may still change: with cutter compensation the end of a move is known
// when the next one is read.
//
//     lines read:   G1 X10   M8     G1 Z-1   G1 Y10
//     held:         [X10]    [X10   [X10     [Y10]         ready: X10 with its end, M8, Z-1, what joins the two
//                             M8]    M8 Z-1]
#pragma once

#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/control/gcode/cutter_geometry.hpp>
#include <vector>

namespace motionrack::control::gcode {

class CompensationQueue {
  public:
    /// Steps that may wait for one move.
    static constexpr std::size_t most = 10'000;

    bool full() const { return steps_.size() >= most; }
    void push(const CanonCall& step) { steps_.push_back(step); }

    /// The first of the steps is the move along `path`, in the plane of the axes `first` and `second`: it and what is
    /// behind it end where the path does, and nothing waits any longer.
    void settle(std::size_t first, std::size_t second, const CutterPath& path);
    /// Nothing of these changes any more.
    void settle() { ready_ = steps_.size(); }

    bool has_ready() const { return next_ < ready_; }
    /// The next step that is ready, valid until push() is called; null: none.
    const CanonCall* next();
    /// The last step that next() gave was there before this line.
    bool was_held() const { return next_ <= of_lines_before_; }
    /// Drops the steps that were ready and not taken.
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
    std::size_t next_ = 0;   ///< pulled
    std::size_t ready_ = 0;  ///< final
    std::size_t of_lines_before_ = 0;
};

}  // namespace motionrack::control::gcode
