// The look-ahead and the path builder allocate at construction and not for a move; an axis profile never allocates.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <motionrack/control/axis_profile/axis_profile.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/sim/test/allocation_count.hpp>

namespace motionrack::control {
namespace {

using sim::allocations;

TEST(LookAheadPlanner, AllocatesNothingForAMove) {
    MachineLimits limits;
    for (AxisLimits& axis : limits) axis = {true, -1e6, 1e6, 100, 1000, 1e5, 1, 1000};
    LookAheadPlanner planner(limits, Point{});
    PlannedMove planned;
    Move move;
    move.kind = MoveKind::feed;
    move.feed = 50;
    move.path = PathControl::continuous;
    move.tolerance_mm = 0.01;
    double seconds = 0;
    const std::uint64_t before = allocations();
    for (int i = 0; i < 5000; ++i) {
        move.kind = i % 700 == 699 ? MoveKind::dwell : MoveKind::feed;
        move.end[0] += 0.1;
        move.end[1] += i % 50 == 0 ? 0.5 : 0.001;
        while (!planner.has_room() && planner.pull(planned)) seconds += seconds_of(planned);
        if (!planner.push(move)) std::abort();
    }
    planner.flush();
    while (planner.pull(planned)) seconds += seconds_of(planned);
    EXPECT_EQ(allocations(), before);
    EXPECT_GT(seconds, 5);
}

TEST(PathBuilderTest, AllocatesNothingForAMove) {
    MachineLimits limits;
    for (AxisLimits& axis : limits) axis = {true, -1e6, 1e6, 100, 1000, 1e5, 1, 1000};
    PathBuilder builder(limits, Point{});
    PathElement item;
    Move move;
    move.feed = 50;
    move.path = PathControl::continuous;
    move.tolerance_mm = 0.01;
    double length = 0;
    const auto pull = [&] {
        while (builder.pull(item)) length += item.rest ? 0 : item.piece.length;
    };
    const std::uint64_t before = allocations();
    for (int i = 0; i < 5000; ++i) {
        move.kind = i % 700 == 699 ? MoveKind::dwell : i % 50 == 25 ? MoveKind::arc : MoveKind::feed;
        move.turns = 1;
        move.centre_first = move.end[0] + 1;
        move.centre_second = move.end[1];
        move.end[0] += move.kind == MoveKind::arc ? 2 : 0.1;
        move.end[1] += move.kind == MoveKind::arc ? 0 : i % 50 == 0 ? 0.5 : 0.001;
        if (!builder.has_room()) pull();
        builder.push(move);
    }
    if (!builder.has_room()) pull();
    builder.flush();
    pull();
    EXPECT_EQ(allocations(), before);
    EXPECT_GT(length, 500);
}

TEST(AxisProfile, AllocatesNothing) {
    const KinematicLimits limits = {100, 1000, 20'000};
    double seconds = 0;
    const std::uint64_t before = allocations();
    for (int i = 0; i < 5000; ++i) {
        const KinematicState from = {0, 30.0 - i % 61, 0.1 * (i % 997)};
        if (const auto out = time_optimal_profile(from, {0.01 * (i - 2500), 0.02 * (i % 1000), 0}, limits))
            seconds += out->duration();
        if (const auto out = stop_profile(from, limits)) seconds += out->sample(0.01).position;
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_GT(seconds, 5);
}

}  // namespace
}  // namespace motionrack::control
