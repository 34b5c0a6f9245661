// Path of a move, as the report's pictures draw it.
#pragma once

#include <motionrack/control/move.hpp>
#include <motionrack/trace/report.hpp>

namespace motionrack::rack {

/// Returns a line unchanged and an arc as chords too short to see. `start`: start of the move.
trace::ReportSegment path_segment(const control::Move& move, const control::Point& start);

}  // namespace motionrack::rack
