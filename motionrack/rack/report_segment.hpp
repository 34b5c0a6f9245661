// A move's path as the reports' pictures draw it.
#pragma once

#include <motionrack/control/move.hpp>
#include <motionrack/trace/report.hpp>

namespace motionrack::rack {

/// A line as it is, an arc in chords that no picture shows as such. `start`: where the move begins.
trace::ReportSegment path_segment(const control::Move& move, const control::Point& start);

}  // namespace motionrack::rack
