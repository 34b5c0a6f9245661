// G-code as a drawing: marks G1, G2 and G3 in the XY plane; G0 is a jump; Z, F, S and dwells are ignored.
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <string>
#include <string_view>

namespace motionrack::mark {

/// Reads a G-code program as a drawing. Errors: invalid_input with line and column for an invalid program, or an arc in
/// another plane.
Result<Drawing> read_gcode(std::string_view text, const std::string& file);

}  // namespace motionrack::mark
