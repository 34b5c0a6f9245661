// Speed of the time-optimal profile of one axis between two states, compared with the S-curve from standstill
// to standstill.

#include <benchmark/benchmark.h>

#include <cmath>
#include <motionrack/control/axis_profile/axis_profile.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

constexpr std::size_t task_count = 8192;

struct Task {
    KinematicState from, to;
    KinematicLimits limits;
};

/// Returns random tasks: limits within an order of magnitude, velocities up to `moving` of the limit.
std::vector<Task> tasks(double moving) {
    std::mt19937_64 random(20261122);
    const auto between = [&](double min, double max) {
        return min + (max - min) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    std::vector<Task> out(task_count);
    for (Task& t : out) {
        t.limits.velocity = between(20, 200);
        t.limits.accel = between(200, 2000);
        t.limits.jerk = between(4e3, 4e4);
        for (KinematicState* state : {&t.from, &t.to}) {
            state->position = between(-100, 100);
            // bounds the acceleration so that bringing it to 0 changes the velocity by at most half of its limit
            const double max_accel = std::fmin(t.limits.accel, std::sqrt(t.limits.velocity * t.limits.jerk));
            state->accel = moving * between(-max_accel, max_accel);
            const double room = t.limits.velocity - 0.5 * state->accel * state->accel / t.limits.jerk;
            state->velocity = moving * between(-room, room);
        }
    }
    return out;
}

template <class Solve>
void solve_all(benchmark::State& state, const std::vector<Task>& work, Solve solve) {
    std::size_t i = 0;
    for (auto _ : state) {
        auto out = solve(work[i++ & (task_count - 1)]);
        benchmark::DoNotOptimize(out);
    }
}

auto travel_of(const Task& t) {
    return time_optimal_profile(t.from, t.to, t.limits);
}

void s_curve_from_rest_to_rest(benchmark::State& state) {
    solve_all(state, tasks(0), [](const Task& t) {
        return SCurveProfile(std::fabs(t.to.position - t.from.position), t.limits.velocity, t.limits.accel,
                             t.limits.jerk);
    });
}
BENCHMARK(s_curve_from_rest_to_rest);

void travel_from_rest_to_rest(benchmark::State& state) {
    solve_all(state, tasks(0), travel_of);
}
BENCHMARK(travel_from_rest_to_rest);

void travel_between_any_states(benchmark::State& state) {
    solve_all(state, tasks(1), travel_of);
}
BENCHMARK(travel_between_any_states);

/// Solves tasks with near targets: nearly every profile has no cruise phase and requires solving an equation.
void travel_between_any_states_near(benchmark::State& state) {
    auto work = tasks(1);
    for (Task& t : work) t.to.position = t.from.position + 0.02 * (t.to.position - t.from.position);
    solve_all(state, work, travel_of);
}
BENCHMARK(travel_between_any_states_near);

/// Solves tasks whose initial velocity and acceleration are up to twice their limits.
void travel_from_outside(benchmark::State& state) {
    auto work = tasks(1);
    for (Task& t : work) t.from = {t.from.position, 2 * t.from.velocity, 2 * t.from.accel};
    solve_all(state, work, travel_of);
}
BENCHMARK(travel_from_outside);

void change_of_velocity(benchmark::State& state) {
    solve_all(state, tasks(1),
              [](const Task& t) { return velocity_change_profile(t.from, t.to.velocity, t.to.accel, t.limits); });
}
BENCHMARK(change_of_velocity);

void stop_of_any_motion(benchmark::State& state) {
    solve_all(state, tasks(1), [](const Task& t) { return stop_profile(t.from, t.limits); });
}
BENCHMARK(stop_of_any_motion);

void sample_of_a_travel(benchmark::State& state) {
    std::vector<AxisProfile> out;
    for (const Task& t : tasks(1)) out.push_back(travel_of(t).value());
    std::size_t i = 0;
    double part = 0;
    for (auto _ : state) {
        const AxisProfile& one = out[i++ & (task_count - 1)];
        part += 0.37;
        if (part > 1) part -= 1;
        benchmark::DoNotOptimize(one.sample(part * one.duration()));
    }
}
BENCHMARK(sample_of_a_travel);

}  // namespace
}  // namespace motionrack::control

BENCHMARK_MAIN();
