// Assigns the marks on the belt to the individual parts.
#pragma once

#include <motionrack/mark/run.hpp>

namespace motionrack::mark {

/// Assigns the marks to the parts: fills points, parts and deviation of `out`, and the part of each overflow. `points`:
/// marks of the whole run, in belt coordinates.
void share_out(const MarkingJob& job, const Prepared& prepared, const std::vector<PartRun>& runs,
               const parts::Conveyor& track, std::span<const parts::MarkedPoint> points, Marked& out);

}  // namespace motionrack::mark
