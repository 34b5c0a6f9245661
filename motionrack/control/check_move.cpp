// Checks that reject invalid moves before planning.
#include <fmt/format.h>

#include <motionrack/control/path_limits.hpp>
#include <motionrack/control/trajectory_planner.hpp>

namespace motionrack::control {
namespace {

bool all_finite(const Move& move) {
    double sum = move.centre_first * 0 + move.centre_second * 0 + move.seconds * 0;
    for (const double value : move.end) sum += value * 0;
    return sum == 0;
}

}  // namespace

Result<Geometry> checked_path(const Move& move, const Point& start, const PathLimits& limits) {
    if (move.kind == MoveKind::arc &&
        (move.first > 2 || move.second > 2 || move.first == move.second || move.turns == 0)) {
        return fail(
            ErrorKind::refused,
            fmt::format(
                "the arc of line {} turns {} times in the plane of axes {} and {}; it needs two of the axes 0, 1, 2 "
                "and at least one turn. It was not planned.",
                move.line, move.turns, move.first, move.second),
            {move.line, 0});
    }
    const Geometry path = geometry_of(move, start);
    if (!all_finite(move) || !(path.length < 1e15)) {
        return fail(
            ErrorKind::refused,
            fmt::format("the move of line {} has a number that is not finite or a path longer than 1e15; it was not "
                        "planned. Correct the coordinates of that line.",
                        move.line),
            {move.line, 0});
    }
    if (move.kind == MoveKind::dwell) {
        if (move.seconds >= 0) return path;
        return fail(ErrorKind::refused,
                    fmt::format("the dwell of line {} lasts {} s; it must be 0 s or longer. It was not planned.",
                                move.line, move.seconds),
                    {move.line, 0});
    }
    if (move.kind != MoveKind::rapid && !(move.feed > 0 && move.feed < 1e15)) {
        return fail(
            ErrorKind::refused,
            fmt::format("the feed of line {} is {}; it must be above 0 and below 1e15. The move was not planned. Set F "
                        "before it.",
                        move.line, move.feed),
            {move.line, 0});
    }
    if (const int axis = limits.missing_axis(path); axis >= 0) {
        return fail(
            ErrorKind::refused,
            fmt::format("line {} moves axis {} by {}, but this machine has no such axis; the move was not planned. "
                        "Remove {} from the program or add the axis to the rack.",
                        move.line, axis_letters[axis], path.end[axis] - path.start[axis], axis_letters[axis]),
            {move.line, 0});
    }
    return path;
}

}  // namespace motionrack::control
