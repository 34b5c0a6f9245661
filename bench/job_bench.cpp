// Complete jobs: G-code interpreted, planned and run on the rack of the examples, observed as by `motionrack run`.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <motionrack/base/trig.hpp>
#include <motionrack/rack/job.hpp>
#include <string>

namespace motionrack {
namespace {

using benchmark::Counter;

std::string text_of(const std::string& path) {
    std::ifstream file(std::string(MOTIONRACK_SOURCE_DIR) + '/' + path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns 20,000 lines of 0.3 mm in continuous path mode, along a spiral of varying radius.
std::string short_lines() {
    std::string text = "G21 G90 G64 P0.02\nG0 X150 Y100\nG1 F3000\n";
    char line[64];
    double angle = 0;
    for (int i = 1; i <= 20'000; ++i) {
        const double radius = 50 + 40 * sin_cos(i * 0.001).sin;
        angle += 0.3 / radius;
        const SinCos at = sin_cos(angle);
        std::snprintf(line, sizeof line, "X%.4f Y%.4f\n", 150 + radius * at.cos, 100 + radius * at.sin);
        text += line;
    }
    return text + "M2\n";
}

/// Interprets, plans and runs the program; excludes building the rack.
void run(benchmark::State& state, const std::string& program) {
    const rack::RackReading reading = rack::read_rack_text(text_of("examples/racks/router.toml"), "router.toml");
    if (!reading.config || program.empty()) return state.SkipWithError("the example cannot be read");
    const auto lines = static_cast<double>(std::count(program.begin(), program.end(), '\n'));
    double seconds = 0, events = 0, segments = 0;
    for (auto _ : state) {
        state.PauseTiming();
        {
            rack::Rack rack(*reading.config);
            rack::JobSettings settings;
            settings.program = program;
            rack::Job job(rack, settings);
            rack.start();
            state.ResumeTiming();
            const rack::JobOutcome outcome = job.run();
            state.PauseTiming();
            if (!outcome.ended) {
                state.SkipWithError(outcome.ended.error().text().c_str());
                return;
            }
            seconds += to_seconds(outcome.time);
            events += static_cast<double>(outcome.events);
            segments += static_cast<double>(outcome.chip_segments);
        }
        state.ResumeTiming();
    }
    state.counters["lines/s"] = Counter(lines * static_cast<double>(state.iterations()), Counter::kIsRate);
    state.counters["sim_s/s"] = Counter(seconds, Counter::kIsRate);
    state.counters["events/s"] = Counter(events, Counter::kIsRate);
    state.counters["segments/s"] = Counter(segments, Counter::kIsRate);
}

void run_example_part(benchmark::State& state) {
    run(state, text_of("examples/02_part/part.ngc"));
}
void run_20000_short_lines(benchmark::State& state) {
    run(state, short_lines());
}
BENCHMARK(run_example_part)->Unit(benchmark::kMillisecond);
BENCHMARK(run_20000_short_lines)->Unit(benchmark::kMillisecond);

/// Saves the whole rack to a snapshot, or restores it.
void rewind(benchmark::State& state, bool back) {
    const rack::RackReading reading = rack::read_rack_text(text_of("examples/racks/router.toml"), "router.toml");
    if (!reading.config) return state.SkipWithError("the rack cannot be read");
    rack::Rack rack(*reading.config);
    rack.start();
    sim::Snapshot taken = rack.kernel().snapshot();
    for (auto _ : state) {
        if (back)
            rack.kernel().restore(taken);
        else
            taken = rack.kernel().snapshot();
    }
    state.counters["bytes"] = static_cast<double>(taken.bytes.size());
}
void snapshot_of_a_rack(benchmark::State& state) {
    rewind(state, false);
}
void restore_of_a_rack(benchmark::State& state) {
    rewind(state, true);
}
BENCHMARK(snapshot_of_a_rack);
BENCHMARK(restore_of_a_rack);

}  // namespace
}  // namespace motionrack

BENCHMARK_MAIN();
