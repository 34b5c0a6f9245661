// Contour of a lathe cycle, gathered from the moves of a sub.
#pragma once

#include <motionrack/control/gcode/interpreter.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::control::gcode {

class ContourReader {
  public:
    /// Adds the moves of the interpreter's last line, which is number `line`; the first move leads to the beginning of
    /// the contour. Returns the reason if a move cannot be part of a contour.
    std::optional<std::string> add(Interpreter& interpreter, std::int32_t line);
    std::vector<ContourSegment> take() { return std::move(contour_); }

  private:
    std::vector<ContourSegment> contour_;
    Point at_ = {};
    bool begun_ = false;
};

}  // namespace motionrack::control::gcode
