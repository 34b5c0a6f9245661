#include <motionrack/control/ride/ride_moves.hpp>

#include <algorithm>
#include <cmath>

namespace motionrack::control {

namespace {

/// No move of fewer pulses of its fastest axis, or its direction would be a guess.
constexpr double least_pulses = 16;
/// Of what an axis may jump by at a corner, so much at the joint of two moves.
constexpr double jump_share = 0.7;
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
        rider_.pass_dwell();
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

/// The longest that is even enough, but at least so many pulses.
double RideMoves::seconds_of_next() const {
    const RideState begin = rider_.at(0);
    double seconds = std::min({settings_.most_seconds, rider_.left(), 4 * last_seconds_});
    while (seconds > least_seconds) {
        const RideState end = rider_.at(seconds);
        double pulses = 0;
        for (std::size_t i = 0; i < limits_.size(); ++i)
            pulses = std::max(pulses, std::fabs(end.place[i] - begin.place[i]) * limits_[i].pulses_per_unit);
        if (is_even(begin, end, seconds) || pulses < 2 * least_pulses) break;
        seconds *= 0.5;
    }
    // No crumb before the end.
    if (rider_.left() - seconds < 0.5 * seconds) seconds = rider_.left();
    return seconds;
}

bool RideMoves::is_even(const RideState& begin, const RideState& end, double seconds) const {
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
    if (!(square > 0)) return true;
    for (std::size_t i = 0; i < way.size(); ++i) {
        if (!limits_[i].present) continue;
        const double most = off_pulses / limits_[i].pulses_per_unit;
        if (std::fabs(gone[i] - along / square * way[i]) > most || std::fabs((along - even) / square * way[i]) > most) return false;
        for (const RideState* state : {&begin, &middle, &end})
            if (turning(*state, i) * seconds > jump_share * limits_[i].start_speed) return false;
    }
    return true;
}

}  // namespace motionrack::control
