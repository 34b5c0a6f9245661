// Text in a single-stroke font of the house: each line of a letter is marked once.
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <string>
#include <string_view>

namespace motionrack::mark {

/// The text's lines ('\n') from the top down, the first one's base line at y = 0, from x = 0 to the right; capitals are `height_mm`
/// high. Letters: A-Z, a-z, 0-9, blank and . , : ; ! ? - + = / * ( ) # % & _ ' ". Errors: another character, with its number in the text.
Result<Drawing> text_drawing(std::string_view text, double height_mm);

}  // namespace motionrack::mark
