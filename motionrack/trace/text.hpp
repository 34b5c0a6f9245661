// Texts and numbers as they go into the files of this room: nothing in them can break out, no NaN is ever written.
#pragma once

#include <string>
#include <string_view>

namespace motionrack::trace {

/// `text` for HTML and SVG, in elements and in quoted attributes: & < > " ' escaped, bytes that are no UTF-8 become
/// U+FFFD, control characters become spaces.
std::string escaped(std::string_view text);

/// `text` as a JSON string with its quotes, in ASCII, that cannot end the script element it stands in.
std::string json_string(std::string_view text);

/// For people: up to `decimals` (0 .. 9) places without trailing zeros, "-0" as "0", a dash for NaN and infinities.
std::string number(double value, int decimals);

/// For people: the places that a value of this size is worth (12345.7, 123.46, 1.235, 0.0123).
std::string number(double value);

/// For SVG coordinates: two places; 0 for NaN and infinities.
std::string coordinate(double value);

/// Whole numbers in groups of three, "12 345 678", with no-break spaces.
std::string grouped(long long value);

}  // namespace motionrack::trace
