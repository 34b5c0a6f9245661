// Lines of G-code per second and core: full interpretation with checks, compared with naive tokenising.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <motionrack/control/gcode/program_reader.hpp>
#include <sstream>
#include <string>

namespace {

using namespace motionrack::control;

gcode::Settings machine() {
    gcode::Settings settings;
    for (AxisLimits& limits : settings.limits) {
        limits.present = true;
        limits.min_position = -1000;
        limits.max_position = 1000;
    }
    return settings;
}

/// A program of 200,000 lines, with numbers from a fixed linear congruential generator.
struct Program {
    std::string text;
    std::int64_t lines = 0;
};

enum class Kind { full_lines, short_lines, arcs };

Program make(Kind kind) {
    Program program;
    std::uint64_t state = 12345;
    const auto random = [&state](int range) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<int>((state >> 33) % static_cast<std::uint64_t>(range));
    };
    program.text = "G1 X0 Y0 F1000\n";
    char line[100];
    for (program.lines = 1; program.lines < 200'000; ++program.lines) {
        if (kind == Kind::full_lines) {
            std::snprintf(line, sizeof line, "G1 X%d.%03d Y-%d.%03d F%d\n", random(100), random(1000), random(100),
                          random(1000), 500 + random(1000));
        } else if (kind == Kind::short_lines) {
            std::snprintf(line, sizeof line, "X%d.%03d Y%d.%03d\n", random(100), random(1000), random(100),
                          random(1000));
        } else {
            std::snprintf(line, sizeof line, "%s X%d Y0 I%d.%d J0\n", program.lines % 2 != 0 ? "G2" : "G3",
                          program.lines % 2 != 0 ? 25 : 0, program.lines % 2 != 0 ? 12 : -12, 5);
        }
        program.text += line;
    }
    return program;
}

void read_with_meaning(benchmark::State& state, Kind kind) {
    const Program program = make(kind);
    const gcode::Settings settings = machine();
    for (auto _ : state) {
        gcode::ProgramReader reader(program.text, settings);
        double sum = 0;
        std::int64_t moves = 0;
        for (;;) {
            const auto step = reader.next();
            if (!step) {
                state.SkipWithError(step.error().text().c_str());
                return;
            }
            if (*step == nullptr) break;
            sum += (*step)->move.end[0];
            ++moves;
        }
        benchmark::DoNotOptimize(sum);
        if (moves != program.lines) state.SkipWithError("lines were lost");
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * program.lines);
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * program.text.size()));
}

/// Naive baseline: getline from a stream, then strtod word by word; no interpretation, no checks.
void tokenise_naively(benchmark::State& state, Kind kind) {
    const Program program = make(kind);
    for (auto _ : state) {
        std::istringstream stream(program.text);
        double sum = 0;
        std::int64_t lines = 0;
        for (std::string line; std::getline(stream, line); ++lines) {
            const char* p = line.c_str();
            while (*p != 0) {
                if (*p == ' ') {
                    ++p;
                    continue;
                }
                char* end = nullptr;
                sum += *p * std::strtod(p + 1, &end);
                p = end;
            }
        }
        benchmark::DoNotOptimize(sum);
        if (lines != program.lines) state.SkipWithError("lines were lost");
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * program.lines);
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * program.text.size()));
}

BENCHMARK_CAPTURE(read_with_meaning, G1_X_Y_F, Kind::full_lines);
BENCHMARK_CAPTURE(tokenise_naively, G1_X_Y_F, Kind::full_lines);
BENCHMARK_CAPTURE(read_with_meaning, X_Y, Kind::short_lines);
BENCHMARK_CAPTURE(tokenise_naively, X_Y, Kind::short_lines);
BENCHMARK_CAPTURE(read_with_meaning, arcs, Kind::arcs);
BENCHMARK_CAPTURE(tokenise_naively, arcs, Kind::arcs);

}  // namespace

BENCHMARK_MAIN();
