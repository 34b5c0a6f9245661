// Speed of path building and of velocity planning along the path, per block.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/trajectory/offline_trajectory.hpp>
#include <motionrack/control/trajectory/trajectory_generator.hpp>
#include <vector>

namespace motionrack::control {
namespace {

MachineLimits machine() {
    MachineLimits limits;
    for (AxisLimits& axis : limits) axis = {true, -1e9, 1e9, 200, 2000, 40'000, 2, 1000};
    return limits;
}

Move feed_to(const Point& end) {
    Move move;
    move.kind = MoveKind::feed;
    move.path = PathControl::continuous;
    move.tolerance_mm = 0.02;
    move.feed = 100;
    move.end = end;
    return move;
}

/// Returns short lines on a smooth curve, as a CAM system writes them; rounded to `grid` mm.
std::vector<Move> chords(double step, double grid) {
    std::vector<Move> moves;
    Point at = {};
    double heading = 0;
    for (int i = 0; i < 20'000; ++i) {
        heading += 0.1 * step * sin_cos(i * step * 0.05).sin;
        const SinCos along = sin_cos(heading);
        at[0] += step * along.cos;
        at[1] += step * along.sin;
        Point end = at;
        if (grid > 0)
            for (double& x : end) x = grid * std::floor(x / grid + 0.5);
        moves.push_back(feed_to(end));
    }
    return moves;
}

std::vector<Move> long_lines() {
    std::vector<Move> moves;
    for (int i = 0; i < 20'000; ++i) moves.push_back(feed_to({20.0 * i, i % 2 * 15.0, 0}));
    return moves;
}

/// Returns quarter circles, left and right, tangent to each other.
std::vector<Move> arcs(double radius) {
    std::vector<Move> moves;
    for (int i = 0; i < 20'000; ++i) {
        const double x = i * radius, y = i * radius;
        Move move = feed_to({x + radius, y + radius, 0});
        move.kind = MoveKind::arc;
        const bool left = i % 2 == 0;
        move.turns = left ? 1 : -1;
        move.centre_first = left ? x : x + radius;
        move.centre_second = left ? y + radius : y;
        moves.push_back(move);
    }
    return moves;
}

/// Returns blocks with different feed rates, so that the path builder merges none.
std::vector<Move> inverse_time(double step) {
    std::vector<Move> moves = chords(step, 0);
    for (std::size_t i = 0; i < moves.size(); ++i) {
        moves[i].feed_mode = FeedMode::inverse_time;
        moves[i].feed = 100 / step + static_cast<double>(i % 5);
        moves[i].end[4] = 0.01 * static_cast<double>(i);
    }
    return moves;
}

void curve(benchmark::State& state, const std::vector<Move>& moves) {
    PathBuilder builder(machine(), Point{});
    PathElement item;
    std::size_t i = 0;
    double pieces = 0;
    for (auto _ : state) {
        while (!builder.has_room() && builder.pull(item)) ++pieces;
        builder.push(moves[i]);
        while (builder.pull(item)) ++pieces;
        if (++i == moves.size()) {
            builder.flush();
            while (builder.pull(item)) ++pieces;
            builder = PathBuilder(machine(), Point{});
            i = 0;
        }
    }
    benchmark::DoNotOptimize(item);
    state.SetItemsProcessed(state.iterations());
    state.counters["pieces_a_block"] = pieces / static_cast<double>(state.iterations());
}

BENCHMARK_CAPTURE(curve, chords_of_0_1_mm, chords(0.1, 0));
BENCHMARK_CAPTURE(curve, chords_of_0_1_mm_rounded, chords(0.1, 0.001));
BENCHMARK_CAPTURE(curve, chords_of_2_um, chords(0.002, 0));
BENCHMARK_CAPTURE(curve, chords_in_inverse_time, inverse_time(0.1));
BENCHMARK_CAPTURE(curve, long_lines, long_lines());
BENCHMARK_CAPTURE(curve, arcs_of_1_mm, arcs(1));
BENCHMARK_CAPTURE(curve, arcs_of_20_mm, arcs(20));

/// Plans path and velocity of the whole program, repeatedly.
void trajectory(benchmark::State& state, const std::vector<Move>& moves) {
    double cells = 0;
    for (auto _ : state) {
        OfflineTrajectory trajectory(
            machine(), Point{}, [&](const PathSection& section) { cells += static_cast<double>(section.feed.size()); });
        for (const Move& move : moves) trajectory.push(move);
        trajectory.flush();
    }
    const double blocks = static_cast<double>(state.iterations()) * static_cast<double>(moves.size());
    state.SetItemsProcessed(static_cast<std::int64_t>(blocks));
    state.counters["cells_a_block"] = cells / blocks;
    state.counters["each"] = benchmark::Counter(blocks, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(trajectory, chords_of_0_1_mm, chords(0.1, 0));
BENCHMARK_CAPTURE(trajectory, chords_of_0_1_mm_rounded, chords(0.1, 0.001));
BENCHMARK_CAPTURE(trajectory, long_lines, long_lines());
BENCHMARK_CAPTURE(trajectory, arcs_of_1_mm, arcs(1));

/// Pushes block by block into a limited window and executes motion while it is full. The slowest pushes plan thousands
/// of blocks.
void generator(benchmark::State& state, const std::vector<Move>& moves) {
    using Clock = std::chrono::steady_clock;
    std::vector<double> seconds;
    TrajectoryGenerator generator(machine(), Point{});
    std::size_t i = 0;
    for (auto _ : state) {
        const Clock::time_point begin = Clock::now();
        while (!generator.has_room() && generator.next(false) == NextMotion::motion)
            generator.advance(std::min(0.05, generator.left()));
        generator.push({moves[i]});
        seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
        if (++i < moves.size()) continue;
        state.PauseTiming();
        generator = TrajectoryGenerator(machine(), Point{});
        i = 0;
        state.ResumeTiming();
    }
    std::sort(seconds.begin(), seconds.end());
    state.SetItemsProcessed(state.iterations());
    state.counters["p99.9_us"] = 1e6 * seconds[seconds.size() * 999 / 1000];
    state.counters["peak_us"] = 1e6 * seconds.back();
}

BENCHMARK_CAPTURE(generator, chords_of_0_1_mm, chords(0.1, 0));
BENCHMARK_CAPTURE(generator, chords_of_0_1_mm_rounded, chords(0.1, 0.001));
BENCHMARK_CAPTURE(generator, long_lines, long_lines());
BENCHMARK_CAPTURE(generator, arcs_of_1_mm, arcs(1));

}  // namespace
}  // namespace motionrack::control

BENCHMARK_MAIN();
