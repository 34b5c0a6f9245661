// Text in a single-stroke font: each line of a letter is marked once.
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <string>
#include <string_view>

namespace motionrack::mark {

/// Draws a text, whose lines are separated by a line feed, from x = 0 to the right with capitals `height_mm` high: the
/// first baseline is at y = 0, the others below it. Letters: A-Z, a-z, 0-9, blank and . , : ; ! ? - + = / * ( ) # % & _
/// ' ". Errors: an unsupported character, with its index in the text.
Result<Drawing> text_drawing(std::string_view text, double height_mm);

/// Replaces {n} in a text by the number, {n:05} by the number zero-padded to 5 digits (1 to 18). Errors: another use of
/// braces, with its index in the text; a number with more digits.
Result<std::string> numbered(std::string_view text, std::int64_t number);

}  // namespace motionrack::mark
