// Text in a single-stroke font of the house: each line of a letter is marked once.
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <string>
#include <string_view>

namespace motionrack::mark {

/// The text's lines ('\n') from the top down, the first one's base line at y = 0, from x = 0 to the right; capitals are
/// `height_mm` high. Letters: A-Z, a-z, 0-9, blank and . , : ; ! ? - + = / * ( ) # % & _ ' ". Errors: another
/// character, with its number in the text.
Result<Drawing> text_drawing(std::string_view text, double height_mm);

/// {n} in a text becomes the number, {n:05} with zeros in front until it has so many digits (1 to 18). Errors: another
/// use of braces, with its place in the text; a number that has more digits than that.
Result<std::string> numbered(std::string_view text, std::int64_t number);

}  // namespace motionrack::mark
