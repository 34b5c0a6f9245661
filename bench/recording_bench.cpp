// Cost of a recording: writing and reading one event and one sample, and a whole job with and without it.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/wave_sink.hpp>
#include <motionrack/trace/diff.hpp>
#include <string>

namespace motionrack {
namespace {

using benchmark::Counter;

std::string scratch(const std::string& name) {
    return (std::filesystem::temp_directory_path() / ("motionrack_bench_" + std::to_string(::getpid()) + "_" + name))
        .string();
}

trace::RecordingHead head() {
    trace::RecordingHead out;
    out.sample_period = milliseconds(1);
    out.axes.push_back({"X", "mm", false, 640, 800, 0, 0, 300, 50, 1000});
    out.signals = {{"X.steps", "axes/x/steps", trace::SignalKind::steps, "step", 0},
                   {"X.encoder", "axes/x/encoder", trace::SignalKind::counts, "count", 0}};
    return out;
}

constexpr std::int64_t events = 1'000'000;

/// Writes pulses and counts of an axis with varying velocity, as in a job.
Result<void> write(const std::string& path) {
    MOTIONRACK_TRY(trace::RecordingWriter writer, trace::RecordingWriter::create(path, head(), Instant{0}));
    std::int64_t at = 0, apart = 100'000;
    for (std::int64_t i = 0; i < events / 2; ++i) {
        apart += (i / 5000 % 2 == 0 ? -7 : 7) + i % 3;
        at += apart;
        writer.event(0, Instant{at}, 1);
        writer.event(1, Instant{at + 13}, i);
    }
    trace::RecordingEnd end;
    end.at = Instant{at + 100};
    end.report.axes.resize(1);
    return writer.close(end);
}

void write_events(benchmark::State& state) {
    const std::string path = scratch("w.h5");
    for (auto _ : state)
        if (!write(path)) return state.SkipWithError("the recording cannot be written");
    state.counters["each"] =
        Counter(static_cast<double>(events), Counter::kIsIterationInvariantRate | Counter::kInvert);
    state.counters["bytes/event"] = static_cast<double>(std::filesystem::file_size(path)) / static_cast<double>(events);
    std::filesystem::remove(path);
}
BENCHMARK(write_events)->Unit(benchmark::kMillisecond);

void compare_events(benchmark::State& state) {
    const std::string path = scratch("c.h5");
    if (!write(path)) return state.SkipWithError("the recording cannot be written");
    for (auto _ : state) {
        const auto diff = trace::diff_files(path, path);
        if (!diff || !diff->same()) return state.SkipWithError("a recording differs from itself");
    }
    state.counters["each"] =
        Counter(static_cast<double>(events), Counter::kIsIterationInvariantRate | Counter::kInvert);
    std::filesystem::remove(path);
}
BENCHMARK(compare_events)->Unit(benchmark::kMillisecond);

/// Runs the example part on the router; 0: no recording, 1: VCD, 2: HDF5.
void run_example_part(benchmark::State& state) {
    std::ifstream file(std::string(MOTIONRACK_SOURCE_DIR) + "/examples/02_part/part.ngc", std::ios::binary);
    rack::JobRequest request;
    request.rack_text = *rack::rack_template("router");
    request.config = *rack::read_rack_text(request.rack_text).config;
    request.program = {std::istreambuf_iterator<char>(file), {}};
    rack::JobObservers watchers;
    const std::string path = scratch("run");
    if (state.range(0) == 1)
        watchers.waves.emplace().sink = rack::wave_sink({path, rack::WaveFormat::vcd, Duration{1}});
    if (state.range(0) == 2) watchers.recording = path;
    double written = 0;
    for (auto _ : state) {
        auto job = rack::RecordedJob::create(request, watchers);
        if (!job || !(*job)->run(nullptr, {}).ended || !(*job)->finish())
            return state.SkipWithError("the example cannot be run");
        written = static_cast<double>((*job)->events());
    }
    if (written > 0) state.counters["events"] = written;
    if (state.range(0) > 0) state.counters["bytes"] = static_cast<double>(std::filesystem::file_size(path));
    std::filesystem::remove(path);
}
BENCHMARK(run_example_part)->Arg(0)->Arg(1)->Arg(2)->ArgName("watched_by")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace motionrack

BENCHMARK_MAIN();
