#include <motionrack/control/ride/ride_moves.hpp>

#include <algorithm>
#include <cmath>

namespace motionrack::control {

namespace {

/// No move of fewer pulses of its fastest axis.
constexpr double least_pulses = 4;
/// Of what an axis may jump by at a corner, so much at the joint of two moves; and so much by rounding to pulses is nothing.
constexpr double jump_share = 0.7, least_noise = 0.2;
/// Pulses by which a place may be early or late on a move because its speed changes evenly, and by which it may be beside its path.
constexpr double off_pulses = 0.4;
constexpr double least_seconds = 0.0005;
constexpr double least_accel = 1e-6;

/// Along the path: of XYZ, or of the fastest rotary axis where only these move.
double size_of(const Point& way) {
    const double linear = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    return linear > smallest_length ? linear : std::max({std::fabs(way[3]), std::fabs(way[4]), std::fabs(way[5])});
}

/// An axis' acceleration that makes no faster: what turns the path.
double turning(const RideState& state, std::size_t axis) {
    double along = 0, square = 0;
    for (std::size_t i = 0; i < state.speed.size(); ++i) {
        along += state.accel[i] * state.speed[i];
        square += state.speed[i] * state.speed[i];
    }
    return square > 0 ? std::fabs(state.accel[axis] - along / square * state.speed[axis]) : 0;
}

}  // namespace

RideMoves::RideMoves(const MachineLimits& limits, const Point& start, RideMovesSettings settings)
    : limits_(limits), path_limits_(limits), settings_(settings), rider_(limits, start, settings.rider), position_(start), place_(start) {}

Result<void> RideMoves::push(const Move& move, bool overridable) {
    MOTIONRACK_TRY(const Geometry path, checked_path(move, position_, path_limits_));
    if (path.shape == PathShape::nothing && move.kind != MoveKind::dwell) return {};
    // Where the card has to stand between two moves the path ends.
    const bool both = path.shape != PathShape::nothing && last_.shape != PathShape::nothing;
    if (both && settings_.drive && settings_.drive->joint_speed(last_, path) <= 0) rider_.flush();
    rider_.push(move, overridable);
    last_ = path;
    if (path.shape != PathShape::nothing) position_ = move.end;
    return {};
}

bool RideMoves::pull(PlannedMove& planned, bool early) {
    planned = {};
    const RideNext next = rider_.next(early);
    if (next == RideNext::nothing) return false;
    planned.start = place_;
    if (next == RideNext::dwell) {
        planned.number = rider_.move_of_rest();
        planned.move = rider_.move(planned.number);
        planned.move.end = place_;
        planned.move.seconds = settings_.cut_dwells ? std::min(settings_.most_seconds, rider_.dwell_seconds()) : rider_.dwell_seconds();
        rider_.pass_dwell(planned.move.seconds);
        return true;
    }
    const RideState begin = rider_.at(0);
    const double seconds = last_seconds_ = seconds_of_next();
    const RideState end = rider_.at(seconds);
    planned.number = rider_.move_of(begin);
    planned.move = rider_.move(planned.number);
    if (planned.move.kind != MoveKind::traverse) planned.move.kind = MoveKind::feed;
    planned.move.end = end.place;
    Point way;
    for (std::size_t i = 0; i < way.size(); ++i) way[i] = end.place[i] - place_[i];
    const double speed_in = size_of(begin.speed), speed_out = size_of(end.speed);
    planned.length = size_of(way);
    planned.entry = speed_in;
    planned.cruise = std::max(speed_in, speed_out);
    planned.exit = speed_out;
    planned.accel = std::max(std::fabs(speed_out * speed_out - speed_in * speed_in) / (2 * planned.length), least_accel);
    planned.even = true;
    planned.move.feed = planned.cruise;
    place_ = end.place;
    rider_.pass(seconds);
    return true;
}

/// The longest that is even enough. Its ends are on whole pulses, so that its speeds are wrong by half a pulse a move: no shorter than this
/// matters.
double RideMoves::seconds_of_next() const {
    const RideState begin = rider_.at(0);
    double seconds = std::min({settings_.most_seconds, rider_.left(), 4 * last_seconds_});
    for (; seconds > least_seconds; seconds *= 0.5) {
        const RideState end = rider_.at(seconds);
        const Roughness is = roughness_of(begin, end, seconds);
        if (is.turn <= jump_share && is.off <= off_pulses) break;
        if (is.pulses < 2 * least_pulses || is.half_pulse * 2 > std::max(is.turn, least_noise)) break;
    }
    // No crumb before the end.
    if (rider_.left() - seconds < 0.5 * seconds) seconds = rider_.left();
    return seconds;
}

RideMoves::Roughness RideMoves::roughness_of(const RideState& begin, const RideState& end, double seconds) const {
    const RideState middle = rider_.at(0.5 * seconds);
    Point way, gone;
    double square = 0, along = 0, even = 0;
    for (std::size_t i = 0; i < way.size(); ++i) {
        way[i] = end.place[i] - begin.place[i];
        gone[i] = middle.place[i] - begin.place[i];
        square += way[i] * way[i];
        along += way[i] * gone[i];
        even += way[i] * seconds * (0.375 * begin.speed[i] + 0.125 * end.speed[i]);  // with an even change of the speed
    }
    Roughness out;
    if (!(square > 0)) return out;
    for (std::size_t i = 0; i < way.size(); ++i) {
        if (!limits_[i].present) continue;
        const double pulses = limits_[i].pulses_per_unit, jump = limits_[i].start_speed;
        const double beside = std::fabs(gone[i] - along / square * way[i]), ahead = std::fabs((along - even) / square * way[i]);
        out.off = std::max({out.off, beside * pulses, ahead * pulses});
        out.pulses = std::max(out.pulses, std::fabs(way[i]) * pulses);
        for (const RideState* state : {&begin, &middle, &end}) out.turn = std::max(out.turn, turning(*state, i) * seconds / jump);
        if (way[i] != 0) out.half_pulse = std::max(out.half_pulse, 0.5 / (pulses * seconds * jump));
    }
    return out;
}

}  // namespace motionrack::control
