// An SVG as a PNG: the same drawing in another form.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>

namespace motionrack::cli {

/// The bytes of a PNG with `scale` pixels to an SVG's px. Errors: io, if the library cannot draw it.
Result<std::string> png_of(std::string_view svg, double scale = 2);

}  // namespace motionrack::cli
