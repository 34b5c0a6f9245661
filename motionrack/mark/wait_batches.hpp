// A drawing longer than the field, on a belt: pieces, and from which way of the belt on each of them is in the field.
//
//        field low                 high
//   ───────┼───────────────────────┼──────► movement      way = 0:   a drawing comes in from the left
//   ==pp====pp==|==pp====pp==|                            at(piece): its last point has come in
//               pieces, cut across the movement           until:     its first point goes out
#pragma once

#include <motionrack/mark/drawing.hpp>
#include <vector>

namespace motionrack::mark {

/// Strokes that one wait is for.
struct WaitBatch {
    double at_mm = 0;     ///< way of the belt from which on all of it is in the field
    double until_mm = 0;  ///< way of the belt until which all of it is
    std::vector<Stroke> strokes;
};

/// The drawing in the order in which it comes into `field` (already without its margin), moved by way * `movement` (a
/// unit vector). Strokes longer than a quarter of the field are cut across the movement.
/// Errors: refused: what is never in the field, or is past it before the belt moves; with how much.
Result<std::vector<WaitBatch>> batches_of(const Drawing& drawing, const Box& field, Spot movement);

}  // namespace motionrack::mark
