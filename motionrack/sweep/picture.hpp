// What came of a sweep, as one picture.
#pragma once

#include <motionrack/sweep/results.hpp>
#include <string>

namespace motionrack::sweep {

/// SVG. One number is varied: time and deviation over it, a line for each combination of the rest; two: maps of both, a
/// pair for each combination; else time and deviation over each thing that is varied. All rows must be there.
std::string picture_of(const Sweep& sweep, const Results& results);

}  // namespace motionrack::sweep
