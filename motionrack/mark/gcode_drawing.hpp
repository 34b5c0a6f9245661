// G-code as a drawing: G1, G2 and G3 in the XY plane are marked, G0 is a jump; Z, F, S and dwells are not looked at.
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <string>
#include <string_view>

namespace motionrack::mark {

/// Errors: invalid_input with line and column, of the program or of an arc in another plane.
Result<Drawing> read_gcode(std::string_view text, const std::string& file);

}  // namespace motionrack::mark
