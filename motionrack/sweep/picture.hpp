// Results of a sweep as one picture.
#pragma once

#include <motionrack/sweep/results.hpp>
#include <string>

namespace motionrack::sweep {

/// Returns an SVG. One varied number: time and deviation over it, one line per combination of the others. Two: maps of
/// both, a pair per combination. Otherwise: time and deviation over each varied parameter. Requires all rows.
std::string picture_of(const Sweep& sweep, const Results& results);

}  // namespace motionrack::sweep
