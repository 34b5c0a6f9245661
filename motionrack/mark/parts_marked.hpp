// What is on the belt becomes what is on each part.
#pragma once

#include <motionrack/mark/run.hpp>

namespace motionrack::mark {

/// Fills points, parts and deviation of `out`, and says of its overflows on which part they are.
/// `points`: of the whole run, in the coordinates of the belt.
void share_out(const MarkingJob& job, const Prepared& prepared, const std::vector<PartRun>& runs,
               const parts::Conveyor& track, std::span<const parts::MarkedPoint> points, Marked& out);

}  // namespace motionrack::mark
