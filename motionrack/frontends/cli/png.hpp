// Converts an SVG to a PNG of the same drawing.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>

namespace motionrack::cli {

/// Returns the bytes of a PNG with `scale` pixels per SVG px. Errors: io, if the library cannot draw it.
Result<std::string> png_of(std::string_view svg, double scale = 2);

}  // namespace motionrack::cli
