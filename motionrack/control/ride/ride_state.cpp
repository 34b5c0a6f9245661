#include <motionrack/control/ride/ride_state.hpp>

#include <algorithm>

namespace motionrack::control {

RideState state_on(const CurvePiece& piece, const FeedState& along) {
    const double x = std::clamp(along.place - piece.begin, 0.0, piece.length);
    RideState out;
    out.u = along.place;
    out.line = piece.line;
    out.place = position_on(piece, x);
    const Point tangent = tangent_on(piece, x), bend = bend_on(piece, x);
    const double v = along.speed, a = along.accel, j = along.jerk;
    for (std::size_t i = 0; i < out.place.size(); ++i) {
        out.speed[i] = tangent[i] * v;
        out.accel[i] = tangent[i] * a + bend[i] * v * v;
        out.jerk[i] = tangent[i] * j + 3 * bend[i] * v * a + piece.twist[i] * v * v * v;
    }
    return out;
}

void add_landing(RideState& state, const StretchEnd& end, double seconds) {
    const FeedPiece& landing = end.feed;
    const FeedState along = landing.at(landing.seconds - seconds);
    const double left = landing.begin + landing.length - along.place;
    for (std::size_t i = 0; i < state.place.size(); ++i) {
        const double tangent = end.curve.tangent[i];
        state.place[i] -= tangent * left;
        state.speed[i] += tangent * along.speed;
        state.accel[i] += tangent * along.accel;
        state.jerk[i] += tangent * along.jerk;
    }
}

}  // namespace motionrack::control
