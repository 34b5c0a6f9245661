// The same program gives the same event trace: with every compiler and optimisation level, next to other racks, and
// while it is observed.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/recorder.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/wave_sink.hpp>
#include <string>
#include <tests/determinism/histories.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>
#include <thread>
#include <vector>

namespace motionrack::rack {
namespace {

namespace fs = std::filesystem;
struct History {
    JobOutcome outcome;
    std::uint64_t state_hash = 0;
};

History run(const std::string& program, const std::string& vcd = {}) {
    Rack rack(*read_rack_text(*rack_template("router")).config);
    std::unique_ptr<Recorder> recorder;
    if (!vcd.empty()) {
        RecorderSettings waves;
        waves.sink = wave_sink({vcd});
        recorder = std::move(*Recorder::create(rack, waves));
    }
    JobSettings settings;
    settings.program = program;
    if (recorder) settings.on_slice = [&recorder] { recorder->drain(); };
    Job job(rack, settings);
    rack.start();
    if (recorder) recorder->begin();
    History history;
    history.outcome = job.run();
    EXPECT_TRUE(!recorder || recorder->finish());
    history.state_hash = rack.kernel().state_hash();
    return history;
}

// tests/determinism/matrix checks the same with other compilers, levels and CPUs.
TEST(Determinism, ExamplesHaveTheEventTraceOfEveryOtherBuild) {
    EXPECT_EQ(example_histories(source_root), text_of(source_root / "tests/golden/trace/examples.txt"))
        << "If the machine was meant to do something else than before, put the new lines into "
           "tests/golden/trace/examples.txt.";
}

TEST(Determinism, RacksHaveTheEventTraceOfEveryOtherBuild) {
    EXPECT_EQ(rack_histories(source_root), text_of(source_root / "tests/golden/trace/racks.txt"))
        << "If the machine was meant to do something else than before, put the new lines into "
           "tests/golden/trace/racks.txt.";
}

TEST(Determinism, RunsRacksOfOneProcessIndependently) {
    const std::array<std::string, 3> programs = {"G21 G90 F2400\nG1 X20 Y10\nG3 X30 Y20 I0 J10\nG0 X0 Y0\nM2\n",
                                                 "G21 G90 F600\nG1 X4 Y3 Z75\nG1 X0 A20\nG0 Y0 A0\nM2\n",
                                                 "G21 G90\nG0 X200\nG4 P0.1\nG0 X1\nM2\n"};
    std::array<History, 3> alone, together;
    for (std::size_t i = 0; i < programs.size(); ++i) alone[i] = run(programs[i]);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < programs.size(); ++i) threads.emplace_back([&, i] { together[i] = run(programs[i]); });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < programs.size(); ++i) {
        EXPECT_TRUE(alone[i].outcome.ended);
        EXPECT_EQ(alone[i].outcome.trace_hash, together[i].outcome.trace_hash) << i;
        EXPECT_EQ(alone[i].outcome.events, together[i].outcome.events) << i;
        EXPECT_EQ(alone[i].state_hash, together[i].state_hash) << i;
    }
    EXPECT_NE(alone[0].outcome.trace_hash, alone[1].outcome.trace_hash);
}

TEST(Determinism, WatchingEveryWireDoesNotChangeTheEventTrace) {
    const std::string program = "G21 G90 F1800\nG1 X6 Y4 Z78 A10\nG2 X8 Y6 I2 J0\nG0 X0 Y0 Z80 A0\nM2\n";
    const fs::path file = fs::temp_directory_path() / fmt::format("motionrack_determinism_{}.vcd", ::getpid());
    const History unseen = run(program), watched = run(program, file.string());
    EXPECT_GT(fs::file_size(file), 100'000u) << "every pulse is in it";
    fs::remove(file);
    EXPECT_TRUE(watched.outcome.ended);
    EXPECT_EQ(unseen.outcome.time, watched.outcome.time);
    EXPECT_EQ(unseen.outcome.chip_segments, watched.outcome.chip_segments);
    EXPECT_EQ(unseen.outcome.max_deviation.mm, watched.outcome.max_deviation.mm);
    for (std::size_t i = 0; i < unseen.outcome.axes.size(); ++i) {
        const AxisOutcome &a = unseen.outcome.axes[i], &b = watched.outcome.axes[i];
        EXPECT_EQ(a.pulses_sent, b.pulses_sent) << i;
        EXPECT_EQ(a.encoder_counts, b.encoder_counts) << i;
        EXPECT_EQ(a.actual_end, b.actual_end) << i;
        EXPECT_EQ(a.top.peak_velocity, b.top.peak_velocity) << i;
        EXPECT_EQ(a.top.peak_accel, b.top.peak_accel) << i;
    }
}

}  // namespace
}  // namespace motionrack::rack
