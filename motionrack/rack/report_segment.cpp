#include <algorithm>
#include <cmath>
#include <motionrack/control/geometry.hpp>
#include <motionrack/rack/report_segment.hpp>

namespace motionrack::rack {

trace::ReportSegment path_segment(const control::Move& move, const control::Point& start) {
    trace::ReportSegment segment;
    segment.line = move.line;
    segment.rapid = move.kind == control::MoveKind::rapid;
    const control::Geometry path = control::geometry_of(move, start);
    const double pieces =
        path.shape == control::PathShape::arc ? std::clamp(std::ceil(std::fabs(path.sweep) / 0.06), 2.0, 2000.0) : 1;
    for (double i = 0; i <= pieces; ++i) {
        const control::Point at = control::position_at(path, path.length * i / pieces);
        segment.points.push_back({at[0], at[1], at[2]});
    }
    return segment;
}

}  // namespace motionrack::rack
