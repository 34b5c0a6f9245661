// G40, G41, G42, G41.1, G42.1: converts the moves of a line to moves of the cutter centre; checks for conflicts.
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class CutterCompensation : public MoveReader {
  public:
    using MoveReader::MoveReader;

    /// Executes G40 .. G42.1.
    bool select();
    /// Refuses a line that changes what must not change while compensation is on.
    bool allows();
    /// Converts the programmed move to a move of the cutter centre, which waits until the next move is known.
    bool compensate();
    /// Handles the end of the program on this line.
    bool end_program();
    /// Refuses a line whose calls would have to wait as well: it has no compensated move and does not end compensation.
    bool may_wait();
    /// Applies a valid line: final calls become ready, its own calls wait behind them.
    void commit();
    /// Completes the waiting move at the end of the program; see Interpreter::finish().
    Outcome<void> finish();
    /// Continues from a position after other motion of the machine, without compensation.
    void resync_position(const Point& position);

  private:
    bool diameter_of_words(double& diameter);
    bool path_beside(PlanePoint from, PlanePoint to, CutterPath& path);
    bool join(PlanePoint corner);
    bool end_waiting_path();
    bool gouges(std::int32_t line);
    bool off_limits();
    void hold_steps();
    void settle_junction();
    CutterState& state() const { return in_.cutter; }
};

}  // namespace motionrack::control::gcode
