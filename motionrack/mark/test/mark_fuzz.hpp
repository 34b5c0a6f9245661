// Invariants of marking jobs and drawings for any input bytes.
//
//  drawing   it is rejected with a position inside the text, or has some lines and only finite coordinates
//  job       it is read or has errors with positions, never both; a valid job runs, is refused, or is stopped;
//            picture, table and page can be made of any outcome
#pragma once

#include <string>
#include <string_view>

namespace motionrack::mark::fuzz {

/// The first byte selects the kind: SVG, G-code or text. Returns the violated invariant, or "".
std::string check_drawing(std::string_view bytes);

std::string check_job(std::string_view text);

}  // namespace motionrack::mark::fuzz
