// A drawing longer than the field on a belt: its pieces, and the belt distance from which each is in the field.
//
//        field low                 high
//  ───────┼───────────────────────┼──────► movement      travel 0:  the drawing enters from the left
//  ==pp====pp==|==pp====pp==|                            at_mm:     the last point of the piece has entered
//              pieces, cut across the movement           until_mm:  its first point leaves
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <vector>

namespace motionrack::mark {

/// Strokes that share one wait.
struct WaitBatch {
    double at_mm = 0;     ///< belt distance from which all of it is in the field
    double until_mm = 0;  ///< belt distance until which all of it is in the field
    std::vector<Stroke> strokes;
};

/// Returns the drawing in the order in which it enters `field` (already reduced by its margin) while it moves along
/// `movement` (a unit vector). Cuts strokes longer than a quarter of the field across the movement.
/// Errors: refused, with the amount, for content that is never in the field or leaves it before the belt moves.
Result<std::vector<WaitBatch>> batches_of(const Drawing& drawing, const Box& field, Spot movement);

}  // namespace motionrack::mark
