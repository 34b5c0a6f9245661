// Speed of profiles and look-ahead, each compared with a naive implementation.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/rest_profiles.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

struct Task {
    double distance, velocity, accel, jerk, entry, exit;
};

/// Number of tasks; the branch predictor cannot learn so many.
constexpr std::size_t task_count = 1 << 14;

/// Returns moves of all cases: with and without reaching the velocity and acceleration limits.
std::vector<Task> tasks() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    std::vector<Task> out(task_count);
    for (Task& task : out) {
        task.velocity = 20 + 180 * part(random);
        task.accel = 200 + 2000 * part(random);
        task.jerk = 5'000 + 50'000 * part(random);
        task.distance = 100 * part(random) * part(random) * part(random);
        task.entry = task.velocity * part(random) * 0.2;
        task.exit = task.velocity * part(random) * 0.2;
    }
    return out;
}

void trapezoid_plan(benchmark::State& state) {
    const auto work = tasks();
    std::size_t i = 0;
    for (auto _ : state) {
        const Task& t = work[i++ & (task_count - 1)];
        const TrapezoidalProfile p(t.distance, t.velocity, t.accel);
        benchmark::DoNotOptimize(p);
    }
}
BENCHMARK(trapezoid_plan);

void trapezoid_plan_between_velocities(benchmark::State& state) {
    const auto work = tasks();
    std::size_t i = 0;
    for (auto _ : state) {
        const Task& t = work[i++ & (task_count - 1)];
        const TrapezoidalProfile p(t.distance, t.entry, t.exit, t.velocity, t.accel);
        benchmark::DoNotOptimize(p);
    }
}
BENCHMARK(trapezoid_plan_between_velocities);

/// Naive: steps through the motion at 1 kHz and decelerates when the remaining distance requires it.
void trapezoid_plan_by_steps_of_1_ms(benchmark::State& state) {
    const auto work = tasks();
    std::size_t i = 0;
    for (auto _ : state) {
        const Task& t = work[i++ & (task_count - 1)];
        double position = 0;
        double velocity = 0;
        int steps = 0;
        while (position < t.distance && steps < 1'000'000) {
            const bool brake = velocity * velocity >= 2 * t.accel * (t.distance - position);
            velocity = std::clamp(velocity + (brake ? -t.accel : t.accel) * 1e-3, t.accel * 1e-4, t.velocity);
            position += velocity * 1e-3;
            ++steps;
        }
        benchmark::DoNotOptimize(steps);
    }
}
BENCHMARK(trapezoid_plan_by_steps_of_1_ms);

void s_curve_plan(benchmark::State& state) {
    const auto work = tasks();
    std::size_t i = 0;
    for (auto _ : state) {
        const Task& t = work[i++ & (task_count - 1)];
        const SCurveProfile p(t.distance, t.velocity, t.accel, t.jerk);
        benchmark::DoNotOptimize(p);
    }
}
BENCHMARK(s_curve_plan);

/// Naive: bisection for the peak velocity.
void s_curve_plan_by_bisection(benchmark::State& state) {
    const auto work = tasks();
    std::size_t i = 0;
    for (auto _ : state) {
        const Task& t = work[i++ & (task_count - 1)];
        const auto accel_duration = [&t](double v) {
            return v * t.jerk >= t.accel * t.accel ? v / t.accel + t.accel / t.jerk : 2 * std::sqrt(v / t.jerk);
        };
        double low = 0;
        double high = t.velocity;
        for (int k = 0; k < 52; ++k) {
            const double v = 0.5 * (low + high);
            (v * accel_duration(v) <= t.distance ? low : high) = v;
        }
        benchmark::DoNotOptimize(accel_duration(low) + t.distance / low);
    }
}
BENCHMARK(s_curve_plan_by_bisection);

template <class Profile>
void sample_four_axes(benchmark::State& state, const std::array<Profile, 4>& axes) {
    double t = 0;
    for (auto _ : state) {
        std::array<ProfileSample, 4> samples;
        for (std::size_t i = 0; i < 4; ++i) samples[i] = axes[i].sample(t);
        benchmark::DoNotOptimize(samples);
        t += 1e-4;
        if (t > axes[0].duration()) t = 0;
    }
    state.counters["per_axis"] = benchmark::Counter(4 * static_cast<double>(state.iterations()),
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void sample_s_curve(benchmark::State& state) {
    sample_four_axes<SCurveProfile>(state, {SCurveProfile(20, 100, 1000, 2e4), SCurveProfile(15, 80, 800, 2e4),
                                            SCurveProfile(12, 90, 900, 1e4), SCurveProfile(30, 120, 1500, 3e4)});
}
BENCHMARK(sample_s_curve);

void sample_trapezoid(benchmark::State& state) {
    sample_four_axes<TrapezoidalProfile>(state, {TrapezoidalProfile(20, 100, 1000), TrapezoidalProfile(15, 80, 800),
                                                 TrapezoidalProfile(12, 90, 900), TrapezoidalProfile(30, 120, 1500)});
}
BENCHMARK(sample_trapezoid);

/// Naive: iterates over the phases from the start for every sample.
void sample_s_curve_through_all_phases(benchmark::State& state) {
    const SCurveProfile p(20, 100, 1000, 2e4);
    const auto ends = p.phase_ends();
    const double jerks[7] = {2e4, 0, -2e4, 0, -2e4, 0, 2e4};
    double t = 0;
    for (auto _ : state) {
        double position = 0, velocity = 0, accel = 0, begin = 0;
        for (int k = 0; k < 7 && begin < t; ++k) {
            const double dt = std::min(t, ends[static_cast<std::size_t>(k)]) - begin;
            position += dt * (velocity + dt * (0.5 * accel + dt * jerks[k] / 6));
            velocity += dt * (accel + 0.5 * jerks[k] * dt);
            accel += jerks[k] * dt;
            begin += dt;
        }
        benchmark::DoNotOptimize(position + velocity + accel);
        t += 1e-4;
        if (t > p.duration()) t = 0;
    }
}
BENCHMARK(sample_s_curve_through_all_phases);

MachineLimits machine() {
    MachineLimits limits;
    for (AxisLimits& axis : limits) axis = {true, -1e9, 1e9, 200, 2000, 0, 2, 1000};
    return limits;
}

/// Returns a smooth curve of short lines, as a CAM system writes it.
std::vector<Move> curve(int count, double step) {
    std::vector<Move> moves;
    Point at{};
    double heading = 0;
    for (int i = 0; i < count; ++i) {
        heading += 0.1 * step * sin_cos(i * step * 0.05).sin;
        const SinCos along = sin_cos(heading);
        at[0] += step * along.cos;
        at[1] += step * along.sin;
        Move move;
        move.kind = MoveKind::feed;
        move.path = PathControl::continuous;
        move.tolerance_mm = 0.02;
        move.feed = 100;
        move.end = at;
        moves.push_back(move);
    }
    return moves;
}

void look_ahead(benchmark::State& state, double step) {
    const auto moves = curve(100'000, step);
    LookAheadPlanner planner(machine(), Point{}, {1024});
    PlannedMove planned;
    std::size_t i = 0;
    double top = 0;
    for (auto _ : state) {
        while (!planner.has_room() && planner.pull(planned)) top = std::max(top, planned.cruise_velocity);
        if (!planner.push(moves[i])) state.SkipWithError("refused");
        if (++i == moves.size()) {
            planner.flush();
            while (planner.pull(planned)) top = std::max(top, planned.cruise_velocity);
            planner = LookAheadPlanner(machine(), Point{}, {1024});
            i = 0;
        }
    }
    benchmark::DoNotOptimize(top);
    state.SetItemsProcessed(state.iterations());
}
void look_ahead_0_1_mm(benchmark::State& state) {
    look_ahead(state, 0.1);
}
BENCHMARK(look_ahead_0_1_mm);
/// Stopping needs more moves than the window holds, so that every pass covers the whole window.
void look_ahead_2_um(benchmark::State& state) {
    look_ahead(state, 0.002);
}
BENCHMARK(look_ahead_2_um);

/// Naive: both passes over the whole window at every push.
void look_ahead_with_full_passes(benchmark::State& state) {
    const auto moves = curve(20'000, 0.1);
    const PathLimits limits(machine());
    struct Node {
        double junction, reach, cruise, entry;
    };
    std::vector<Node> window;
    Geometry last;
    AlongPathLimits last_along;
    Point at{};
    std::size_t i = 0;
    double committed = 0;
    for (auto _ : state) {
        const Move& move = moves[i];
        const Geometry path = geometry_of(move, at);
        const AlongPathLimits along = limits.along(path, move);
        const double junction = window.empty()
                                    ? 0
                                    : limits.max_junction_velocity2(last, last_along.velocity, path, along.velocity,
                                                                    move.path, move.tolerance_mm);
        if (window.size() == 1024) {
            committed = window[1].entry;
            window.erase(window.begin());
        }
        window.push_back({junction, 2 * along.accel * path.length, along.velocity * along.velocity, 0});
        double entry = 0;
        for (std::size_t k = window.size(); k-- > 0;) {
            entry = std::min(window[k].junction, entry + window[k].reach);
            window[k].entry = entry;
        }
        entry = committed;
        for (Node& node : window) {
            node.entry = std::min(node.entry, entry);
            entry = node.entry + node.reach;
        }
        benchmark::DoNotOptimize(window.data());
        last = path;
        last_along = along;
        at = move.end;
        if (++i == moves.size()) {
            i = 0;
            at = {};
            window.clear();
            committed = 0;
        }
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(look_ahead_with_full_passes);

void geometry_of_a_line(benchmark::State& state) {
    const auto moves = curve(1024, 0.1);
    std::size_t i = 0;
    for (auto _ : state) {
        const Geometry path = geometry_of(moves[i & 1023], moves[(i + 1) & 1023].end);
        benchmark::DoNotOptimize(path);
        ++i;
    }
}
BENCHMARK(geometry_of_a_line);

void sine_and_cosine(benchmark::State& state) {
    double x = 0.1;
    for (auto _ : state) {
        benchmark::DoNotOptimize(sin_cos(x));
        x = x > 100 ? 0.1 : x + 0.37;
    }
}
BENCHMARK(sine_and_cosine);

void sine_and_cosine_of_the_c_library(benchmark::State& state) {
    double x = 0.1;
    for (auto _ : state) {
        benchmark::DoNotOptimize(std::sin(x));
        benchmark::DoNotOptimize(std::cos(x));
        x = x > 100 ? 0.1 : x + 0.37;
    }
}
BENCHMARK(sine_and_cosine_of_the_c_library);

}  // namespace
}  // namespace motionrack::control

BENCHMARK_MAIN();
