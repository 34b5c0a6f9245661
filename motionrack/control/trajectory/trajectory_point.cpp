#include <algorithm>
#include <motionrack/control/trajectory/trajectory_point.hpp>

namespace motionrack::control {

TrajectoryPoint trajectory_point(const CubicSegment& piece, const PathMotion& along) {
    const double x = std::clamp(along.u - piece.begin, 0.0, piece.length);
    TrajectoryPoint out;
    out.u = along.u;
    out.line = piece.line;
    out.position = position_on(piece, x);
    const Point tangent = tangent_on(piece, x), curvature = curvature_on(piece, x);
    const double v = along.velocity, a = along.accel, j = along.jerk;
    for (std::size_t i = 0; i < out.position.size(); ++i) {
        out.velocity[i] = tangent[i] * v;
        out.accel[i] = tangent[i] * a + curvature[i] * v * v;
        out.jerk[i] = tangent[i] * j + 3 * curvature[i] * v * a + piece.curvature_rate[i] * v * v * v;
    }
    return out;
}

void add_overlap(TrajectoryPoint& state, const SectionRamp& end, double seconds) {
    std::size_t i = end.feed.size() - 1;
    while (i > 0 && seconds > end.feed[i].seconds) seconds -= end.feed[i--].seconds;
    const ProfileSegment& piece = end.feed[i];
    const PathMotion along = piece.at(std::max(0.0, piece.seconds - seconds));
    const double left = end.feed.back().begin + end.feed.back().length - along.u;
    for (std::size_t k = 0; k < state.position.size(); ++k) {
        const double tangent = end.curve.tangent[k];
        state.position[k] -= tangent * left;
        state.velocity[k] += tangent * along.velocity;
        state.accel[k] += tangent * along.accel;
        state.jerk[k] += tangent * along.jerk;
    }
}

}  // namespace motionrack::control
