// What must hold of marking jobs and drawings, whatever bytes they are made of.
//
//   drawing   it is refused with a place that is in the text, or every coordinate is a number and it has some lines
//   job       it is read or has errors with places, never both; what is read runs, or is refused, or is stopped;
//             the part's picture, table and page are made of any outcome
#pragma once

#include <string>
#include <string_view>

namespace motionrack::mark::fuzz {

/// The first byte says what the others are: SVG, G-code or a text. "" or what does not hold.
std::string check_drawing(std::string_view bytes);

std::string check_job(std::string_view text);

}  // namespace motionrack::mark::fuzz
