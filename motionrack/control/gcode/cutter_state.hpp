// State of cutter compensation: the move that waits for the next one, and the effect of the current line on it.
#pragma once

#include <motionrack/control/gcode/compensation_queue.hpp>

namespace motionrack::control::gcode {

/// Effect of a line on the move that waits before it, and the move that waits after it.
struct CompensationPlan {
    bool joins = false;   ///< the waiting move is completed, along the path `last`
    bool around = false;  ///< the inserted `arc` follows the waiting move
    bool begins = false;  ///< a move starts at `from` and waits along `path`
    CutterPath last;
    CutterPath path;
    PlanePoint from;
    Move arc;

    void clear() { joins = around = begins = false; }
};

/// State of cutter compensation between lines; only CutterCompensation changes it.
class CutterState {
  public:
    void begin_line() { held_.begin_line(); }
    void begin_interpretation() { plan_.clear(); }

    /// Returns true from the first compensated move to G40: a move waits.
    bool is_compensating() const { return compensating_; }
    /// Returns true if the machine is at at(), not at the programmed position.
    bool is_off_path() const { return off_path_; }
    const Point& at() const { return at_; }
    bool is_full() const { return held_.full(); }
    /// Returns the queue from which calls are pulled.
    CompensationQueue& held() { return held_; }

  private:
    friend class CutterCompensation;

    CompensationQueue held_;
    bool compensating_ = false;
    bool off_path_ = false;
    Point at_ = {};
    CutterPath path_;  ///< path of the waiting move, which starts at `from_`
    PlanePoint from_;
    std::int32_t line_ = 0;  ///< line of the waiting move
    CompensationPlan plan_;
};

}  // namespace motionrack::control::gcode
