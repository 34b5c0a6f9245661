// Laws of the look-ahead, for random programs: all limits are observed, and the window finds the result of a full pass.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/rest_profiles.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

constexpr double law_slack = 1 + 1e-9;

/// Random machines and programs from one seed.
class Maker {
  public:
    explicit Maker(std::uint64_t seed) : random_(seed) {}

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    int one_of(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

    MachineLimits machine() {
        MachineLimits limits;
        for (AxisLimits& axis : limits) {
            axis = {true, -1e9, 1e9, between(20, 200), between(100, 3000), one_of(2) * 1e4, one_of(3) * between(0, 5),
                    1000};
        }
        return limits;
    }

    std::vector<Move> program(int count) {
        std::vector<Move> moves;
        Point at{};
        double heading = 0;
        for (int i = 0; i < count; ++i) {
            Move move;
            move.kind = MoveKind::feed;
            move.path = static_cast<PathControl>(one_of(10) == 0 ? 1 : one_of(2) * 2);
            move.tolerance_mm = between(0, 0.2);
            move.feed = between(5, 150);
            heading += one_of(3) == 0 ? between(-3, 3) : between(-0.05, 0.05);
            shape(move, at, heading);
            at = move.kind == MoveKind::dwell ? at : move.end;
            moves.push_back(move);
        }
        return moves;
    }

  private:
    void shape(Move& move, const Point& at, double& heading) {
        move.end = at;
        const double step = one_of(2) == 0 ? between(0.01, 0.5) : between(0.5, 20);
        const int kind = one_of(24);
        const SinCos along = sin_cos(heading);
        if (kind == 0) {
            move.kind = MoveKind::dwell;
            move.seconds = between(0, 1);
        } else if (kind == 1) {
            move.end[3 + one_of(3)] += between(-90, 90);
        } else if (kind < 7) {
            arc(move, at, heading);
        } else {
            move.end[0] += step * along.cos;
            move.end[1] += step * along.sin;
            if (one_of(3) == 0) move.end[2] += between(-step, step);
            if (one_of(6) == 0) move.end[4] += between(-5, 5);
            if (one_of(8) == 0) move.kind = MoveKind::rapid;
            if (one_of(8) == 0) move.feed_mode = FeedMode::inverse_time;
        }
    }

    /// Makes `move` an arc that starts in the direction of `heading`, so that lines and arcs often meet tangentially.
    void arc(Move& move, const Point& at, double& heading) {
        move.kind = MoveKind::arc;
        const bool left = one_of(2) == 0;
        const double radius = between(0.05, 30);
        const double sweep = between(0.01, 6.2) * (left ? 1 : -1);
        const SinCos in = sin_cos(heading);
        const double side = left ? radius : -radius;
        move.centre_first = at[0] - side * in.sin;
        move.centre_second = at[1] + side * in.cos;
        heading += sweep;
        const SinCos out = sin_cos(heading);
        move.end[0] = move.centre_first + side * out.sin;
        move.end[1] = move.centre_second - side * out.cos;
        move.turns = (1 + (one_of(6) == 0)) * (left ? 1 : -1);
        if (one_of(3) == 0) move.end[2] += between(-3, 3);
        if (one_of(4) == 0) move.end[5] += between(-30, 30);
    }

    std::mt19937_64 random_;
};

std::vector<PlannedMove> plan(const MachineLimits& limits, const std::vector<Move>& moves, int window) {
    LookAheadPlanner planner(limits, Point{}, {window});
    std::vector<PlannedMove> out;
    PlannedMove planned;
    for (const Move& move : moves) {
        while (!planner.has_room() && planner.pull(planned)) out.push_back(planned);
        const Result<void> pushed = planner.push(move);
        RC_ASSERT(pushed.has_value());
    }
    planner.flush();
    while (planner.pull(planned)) out.push_back(planned);
    return out;
}

void keeps_the_limits_inside(const MachineLimits& limits, const PlannedMove& planned) {
    const Geometry path = geometry_of(planned.move, planned.start);
    RC_ASSERT(planned.length == path.length);
    RC_ASSERT(planned.entry_velocity <= planned.cruise_velocity);
    RC_ASSERT(planned.exit_velocity <= planned.cruise_velocity);
    if (planned.move.kind != MoveKind::rapid) {
        const bool inverse = planned.move.feed_mode == FeedMode::inverse_time;
        RC_ASSERT(planned.cruise_velocity <= planned.move.feed * (inverse ? path.length : 1) * law_slack);
    }
    const double change =
        std::fabs(planned.exit_velocity * planned.exit_velocity - planned.entry_velocity * planned.entry_velocity);
    RC_ASSERT(change <= 2 * planned.accel * planned.length * law_slack + 1e-12);
    const double h = path.length * 1e-5;
    for (int k = 0; k <= 16; ++k) {
        const double s = std::clamp(path.length * k / 16, h, path.length - h);
        const Point here = tangent_at(path, s);
        const Point before = tangent_at(path, s - h);
        const Point after = tangent_at(path, s + h);
        for (int i = 0; i < axis_count; ++i) {
            RC_ASSERT(std::fabs(here[i]) * planned.cruise_velocity <= limits[i].max_velocity * law_slack);
            const double pull = planned.cruise_velocity * planned.cruise_velocity * (after[i] - before[i]) / (2 * h);
            for (const double along : {planned.accel, 0.0, -planned.accel}) {
                RC_ASSERT(std::fabs(along * here[i] + pull) <= limits[i].max_accel * (1 + 1e-6));
            }
        }
    }
}

void keeps_the_limits_between(const MachineLimits& limits, const PlannedMove& before, const PlannedMove& after) {
    RC_ASSERT(before.exit_velocity == after.entry_velocity);
    RC_ASSERT(before.move.end == after.start);
    if (before.move.path == PathControl::exact_stop || before.length == 0 || after.length == 0)
        RC_ASSERT(before.exit_velocity == 0);
    if (before.exit_velocity == 0) return;
    const Point out = geometry_of(before.move, before.start).tangent_out;
    const Point in = geometry_of(after.move, after.start).tangent_in;
    double size = 1;
    for (int i = 3; i < axis_count; ++i) size += std::fabs(in[i]) + std::fabs(out[i]);
    for (int i = 0; i < axis_count; ++i) {
        const double unseen = tangent_angle_rad * (i < 3 ? 1 : size) * before.exit_velocity;
        const double allowed = before.move.path == PathControl::continuous ? limits[i].max_velocity_step : 0;
        RC_ASSERT(std::fabs(in[i] - out[i]) * before.exit_velocity <= std::max(allowed, unseen) * law_slack);
    }
}

void keeps_the_limits(const MachineLimits& limits, const std::vector<PlannedMove>& out) {
    if (out.empty()) return;
    RC_ASSERT(out.front().entry_velocity == 0);
    RC_ASSERT(out.back().exit_velocity == 0);
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (out[i].length > 0) keeps_the_limits_inside(limits, out[i]);
        if (i > 0) keeps_the_limits_between(limits, out[i - 1], out[i]);
    }
}

/// Returns the entry velocities of a whole program by a backward and a forward pass over all moves.
std::vector<double> entries_by_full_passes(const MachineLimits& machine, const std::vector<PlannedMove>& moves) {
    const PathLimits limits(machine);
    const std::size_t count = moves.size();
    std::vector<double> max_entry(count + 1, 0), reach(count, 0);
    Geometry last;
    double last_velocity = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Geometry path = geometry_of(moves[i].move, moves[i].start);
        if (path.shape != PathShape::nothing) {
            const AlongPathLimits along = limits.along(path, moves[i].move);
            reach[i] = 2 * along.accel * path.length;
            if (last.shape != PathShape::nothing) {
                const Move& before = moves[i - 1].move;
                max_entry[i] = limits.max_junction_velocity2(last, last_velocity, path, along.velocity, before.path,
                                                             before.tolerance_mm);
            }
            last_velocity = along.velocity;
        }
        last = path;
    }
    for (std::size_t i = count; i-- > 0;) max_entry[i] = std::min(max_entry[i], max_entry[i + 1] + reach[i]);
    for (std::size_t i = 0; i < count; ++i) max_entry[i + 1] = std::min(max_entry[i + 1], max_entry[i] + reach[i]);
    for (double& value : max_entry) value = std::sqrt(value);
    return max_entry;
}

RC_GTEST_PROP(PlannerLaws, EveryAxisKeepsItsLimitsAtEveryInstant, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    const int count = *rc::gen::inRange(1, 200);
    const int window = *rc::gen::element(1, 2, 7, 64, 1024);
    Maker maker(seed);
    const MachineLimits limits = maker.machine();
    keeps_the_limits(limits, plan(limits, maker.program(count), window));
}

RC_GTEST_PROP(PlannerLaws, AWindowThatHoldsTheProgramFindsWhatFullPassesFind, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    const int count = *rc::gen::inRange(1, 400);
    Maker maker(seed);
    const MachineLimits limits = maker.machine();
    const auto out = plan(limits, maker.program(count), 1024);
    const auto entries = entries_by_full_passes(limits, out);
    for (std::size_t i = 0; i < out.size(); ++i) RC_ASSERT(std::fabs(out[i].entry_velocity - entries[i]) <= 1e-9);
}

RC_GTEST_PROP(PlannerLaws, AShortWindowIsNeverFasterThanFullPasses, ()) {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    const int count = *rc::gen::inRange(1, 400);
    const int window = *rc::gen::inRange(1, 20);
    Maker maker(seed);
    const MachineLimits limits = maker.machine();
    const auto out = plan(limits, maker.program(count), window);
    const auto entries = entries_by_full_passes(limits, out);
    for (std::size_t i = 0; i < out.size(); ++i) RC_ASSERT(out[i].entry_velocity <= entries[i] + 1e-9);
}

/// Returns a smooth curve of short lines, as a CAM system writes it.
std::vector<Move> curve(int count, double step) {
    std::vector<Move> moves;
    double angle = 0;
    Point at{};
    for (int i = 0; i < count; ++i) {
        angle += 0.02 * sin_cos(i * 0.05).sin;
        const SinCos along = sin_cos(angle);
        at[0] += step * along.cos;
        at[1] += step * along.sin;
        Move move;
        move.kind = MoveKind::feed;
        move.path = PathControl::continuous;
        move.tolerance_mm = 0.01;
        move.feed = 90;
        move.end = at;
        moves.push_back(move);
    }
    return moves;
}

TEST(PlannerLaws, AWindowBeyondTheStoppingDistanceGivesThePlanOfTheWholeProgram) {
    MachineLimits limits;
    for (AxisLimits& axis : limits) axis = {true, -1e9, 1e9, 100, 1000, 0, 1, 1000};
    // stopping from 90 mm/s takes 4.05 mm: 41 lines of 0.1 mm
    const auto out = plan(limits, curve(5000, 0.1), 64);
    ASSERT_EQ(out.size(), 5000u);
    const auto entries = entries_by_full_passes(limits, out);
    double peak_velocity = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        ASSERT_NEAR(out[i].entry_velocity, entries[i], 1e-9) << i;
        peak_velocity = std::max(peak_velocity, out[i].cruise_velocity);
    }
    EXPECT_GT(peak_velocity, 85);
}

/// Hashes the bits of velocities, lengths and times; the number was the same with g++ and clang++ at -O0, -O2 and -O3.
TEST(PlannerLaws, BitsAreTheSameOnEveryCompilerAndCpu) {
    MachineLimits limits;
    for (AxisLimits& axis : limits) axis = {true, -1e9, 1e9, 100, 1000, 30'000, 1, 1000};
    auto moves = curve(3000, 0.37);
    for (std::size_t i = 5; i < moves.size(); i += 10) {
        Move& move = moves[i];
        move.kind = MoveKind::arc;
        move.turns = i % 20 == 5 ? 1 : -1;
        move.centre_first = 0.5 * (moves[i - 1].end[0] + move.end[0]);
        move.centre_second = 0.5 * (moves[i - 1].end[1] + move.end[1]);
        move.end[2] += 0.1;
        moves[i - 2].path = PathControl::exact_stop;
    }
    std::uint64_t fold = 0;
    const auto mix = [&fold](double value) {
        fold = (fold ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u;
    };
    for (const PlannedMove& planned : plan(limits, moves, 100)) {
        for (const double value : {planned.length, planned.entry_velocity, planned.cruise_velocity,
                                   planned.exit_velocity, planned.accel, planned.jerk}) {
            mix(value);
        }
        mix(seconds_of(planned));
        for (const double value : position_at(geometry_of(planned.move, planned.start), planned.length * 0.3))
            mix(value);
        mix(SCurveProfile(planned.length, planned.cruise_velocity, planned.accel, 1e4).sample(0.01).position);
    }
    EXPECT_EQ(fold, 9284701413993860843u);
}

}  // namespace
}  // namespace motionrack::control
