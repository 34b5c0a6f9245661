// Text and number formatting for the output files of this folder: escapes all text, never writes NaN.
#pragma once

#include <string>
#include <string_view>

namespace motionrack::trace {

/// Escapes `text` for elements and quoted attributes of HTML and SVG: & < > " '. Invalid UTF-8 becomes U+FFFD, control
/// characters become spaces.
std::string escaped(std::string_view text);

/// Returns `text` as a quoted ASCII JSON string that cannot end the enclosing script element.
std::string json_string(std::string_view text);

/// Formats `value` for display: up to `decimals` (0 .. 9) places without trailing zeros, "-0" as "0", a dash for NaN
/// and infinities.
std::string number(double value, int decimals);

/// Formats `value` for display: decimals according to magnitude (12345.7, 123.46, 1.235, 0.0123).
std::string number(double value);

/// Formats an SVG coordinate: two decimals; 0 for NaN and infinities.
std::string coordinate(double value);

/// Formats an integer in groups of three, "12 345 678", with no-break spaces.
std::string grouped(long long value);

}  // namespace motionrack::trace
