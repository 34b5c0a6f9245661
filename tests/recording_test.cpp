// Recordings of whole runs: every pulse with its tick, the same page again, the same run again bit for bit, whatever
// the external inputs were.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/wave_sink.hpp>
#include <motionrack/trace/changes.hpp>
#include <motionrack/trace/diff.hpp>
#include <tests/ran.hpp>

namespace motionrack::rack {
namespace {

using testing::HasSubstr;

const char* const program =
    "G21 G90 G64 P0.05 F1800\nG1 X12 Y8 Z78 A10\nG2 X16 Y12 I4 J0\nG1 X30\nG4 P0.05\nG0 X0 Y0 Z80 A0\nM2\n";

JobRequest request_for(const std::string& text, const std::vector<std::string>& faults = {},
                       const std::vector<std::string>& orders = {}, const std::string& profile = "trapezoid") {
    JobRequest request;
    request.rack_text = *rack_template("router");
    const std::string usual = "profile = \"trapezoid\"";
    if (const std::size_t at = request.rack_text.find(usual); at != std::string::npos)
        request.rack_text.replace(at, usual.size(), "profile = \"" + profile + "\"");
    request.rack_file = "router.toml";
    request.config = *read_rack_text(request.rack_text, request.rack_file).config;
    EXPECT_EQ(request.config.controller.profile, profile);
    request.program = text;
    request.program_name = "part.ngc";
    request.faults = *read_faults(faults);
    request.commands = *read_commands(orders);
    request.version = "0.0.0";
    return request;
}

class RecordedRun : public InFolder {
  protected:
    std::string at(const std::string& name) const { return (folder / name).string(); }

    /// Runs a job and records it; from `stop_s` of simulated time on, stops it as Ctrl-C does (-1: not at all).
    JobOutcome record(const JobRequest& request, const std::string& name, double stop_s = -1) const {
        auto job = RecordedJob::create(request, {name.empty() ? std::string() : at(name), {}});
        EXPECT_TRUE(job) << job.error().text();
        std::atomic<bool> stop{false};
        const JobOutcome outcome =
            (*job)->run(&stop, [&](const JobProgress& progress) { stop = stop_s >= 0 && progress.seconds >= stop_s; });
        const Result<void> done = (*job)->finish();
        EXPECT_TRUE(done) << done.error().text();
        return outcome;
    }
    trace::Diff replay(const std::string& name) const {
        const auto recording = trace::RecordingReader::open(at(name));
        EXPECT_TRUE(recording) << recording.error().text();
        const auto request = request_of(*recording);
        EXPECT_TRUE(request) << request.error().text();
        record(*request, "again.h5");
        const auto diff = trace::diff_files(at(name), at("again.h5"));
        EXPECT_TRUE(diff) << diff.error().text();
        return *diff;
    }
    void expect_same_again(const std::string& name) const {
        const trace::Diff diff = replay(name);
        EXPECT_TRUE(diff.same()) << trace::diff_text(diff, name, "again");
        EXPECT_GT(diff.compared, 10'000u);
    }
};

/// Times and values of a series.
template <class T>
std::vector<std::pair<std::int64_t, T>> read(const trace::RecordingReader& reader, const std::string& name) {
    const auto columns = reader.columns(*reader.find(name));
    EXPECT_TRUE(columns) << name;
    std::vector<std::int64_t> times(columns->size);
    std::vector<T> values(columns->size);
    EXPECT_TRUE(columns->time.read(0, columns->size, times.data()));
    EXPECT_TRUE(columns->value.read(0, columns->size, values.data()));
    std::vector<std::pair<std::int64_t, T>> out;
    for (std::size_t i = 0; i < times.size(); ++i) out.emplace_back(times[i], values[i]);
    return out;
}

TEST_F(RecordedRun, HasEveryPulseAndCountThatWasCounted) {
    const JobOutcome outcome = record(request_for(program), "a.h5");
    ASSERT_TRUE(outcome.ended) << outcome.ended.error().text();
    const auto reader = trace::RecordingReader::open(at("a.h5"));
    ASSERT_TRUE(reader) << reader.error().text();
    ASSERT_TRUE(reader->whole());
    for (const AxisOutcome& axis : outcome.axes) {
        const std::string name(1, control::axis_letters[static_cast<std::size_t>(axis.index)]);
        std::int64_t net = 0, last = -1;
        const auto steps = read<std::int64_t>(*reader, name + ".steps");
        for (const auto& [when, direction] : steps) {
            EXPECT_GE(when, last);
            last = when;
            net += direction;
        }
        EXPECT_EQ(static_cast<std::int64_t>(steps.size()), axis.pulses_sent) << name;
        EXPECT_EQ(net, axis.pulses_net) << name;
        const auto counts = read<std::int64_t>(*reader, name + ".encoder");
        for (std::size_t i = 1; i < counts.size(); ++i) EXPECT_EQ(std::abs(counts[i].second - counts[i - 1].second), 1);
        EXPECT_EQ(counts.empty() ? 0 : counts.back().second, axis.expected_counts) << name;
        EXPECT_EQ(read<double>(*reader, name + ".position").back().second, axis.actual_end) << name;
    }
}

TEST_F(RecordedRun, HasThePulsesOfTheWavesTickForTick) {
    const JobRequest request = request_for(program);
    RecorderSettings waves;
    waves.sink = wave_sink({at("a.vcd"), WaveFormat::vcd, Duration{1}});
    auto job = RecordedJob::create(request, {at("a.h5"), waves});
    ASSERT_TRUE(job);
    ASSERT_TRUE((*job)->run(nullptr, {}).ended);
    ASSERT_TRUE((*job)->finish());
    const auto reader = trace::RecordingReader::open(at("a.h5"));
    ASSERT_TRUE(reader);
    trace::SignalNames names;
    const auto changes = trace::open_vcd_changes(at("a.vcd"), names);
    ASSERT_TRUE(changes) << changes.error().text();
    const std::size_t wire = names.number("X.X_step");
    std::vector<std::int64_t> edges;
    for (trace::SignalChange change; *(*changes)->next(change);)
        if (change.signal == wire && change.value == "1") edges.push_back(change.at_ps / 100);
    std::vector<std::int64_t> steps;
    for (const auto& [when, direction] : read<std::int64_t>(*reader, "X.steps")) steps.push_back(when);
    EXPECT_GT(steps.size(), 1000u);
    EXPECT_EQ(steps, edges);
}

TEST_F(RecordedRun, IsTheSameWithAndWithoutItsRecording) {
    const JobOutcome seen = record(request_for(program), "a.h5"), unseen = record(request_for(program), "");
    EXPECT_EQ(seen.time, unseen.time);
    EXPECT_EQ(seen.max_deviation.mm, unseen.max_deviation.mm);
    for (std::size_t i = 0; i < seen.axes.size(); ++i) {
        EXPECT_EQ(seen.axes[i].pulses_sent, unseen.axes[i].pulses_sent);
        EXPECT_EQ(seen.axes[i].actual_end, unseen.axes[i].actual_end);
        EXPECT_EQ(seen.axes[i].top.peak_accel, unseen.axes[i].top.peak_accel);
    }
}

TEST_F(RecordedRun, IsIdenticalWhenReplayed) {
    record(request_for(program), "a.h5");
    expect_same_again("a.h5");
}

TEST_F(RecordedRun, IsIdenticalWhenReplayedWithHoldsOverridesAndFaults) {
    for (const char* profile : {"trapezoid", "jerk_limited"}) {
        const JobRequest request =
            request_for(program, {"X.motor.push=64@0.9s", "Y.encoder.broken_a@1.1s", "Y.encoder.broken_a=0@1.105s"},
                        {"feed=0.5@0.2s", "hold@0.45s", "resume@0.8s", "rapid=0.3@0.85s", "feed=1.7@1s", "hold@1.2s",
                         "resume@1.25s"},
                        profile);
        const JobOutcome outcome = record(request, "a.h5"),
                         plain = record(request_for(program, {}, {}, profile), "plain.h5");
        ASSERT_TRUE(outcome.ended) << outcome.ended.error().text();
        const auto reader = trace::RecordingReader::open(at("a.h5"));
        for (const auto& [when, velocity] : read<double>(*reader, "X.velocity"))
            if (Instant{when} > milliseconds(700) && Instant{when} < milliseconds(800)) {
                EXPECT_EQ(velocity, 0) << "held, at " << when;
            }
        for (std::size_t i = 0; i < plain.axes.size(); ++i)
            EXPECT_EQ(outcome.axes[i].pulse_position, plain.axes[i].pulse_position) << i;
        expect_same_again("a.h5");
        EXPECT_FALSE(trace::diff_files(at("a.h5"), at("plain.h5"))->same());
    }
}

TEST_F(RecordedRun, IsIdenticalWhenReplayedAfterAStopByTheMachine) {
    const JobOutcome outcome = record(request_for(program, {"X.limit_plus=0@0.7s"}), "a.h5");
    ASSERT_FALSE(outcome.ended);
    EXPECT_EQ(outcome.ended.error().kind, ErrorKind::machine);
    expect_same_again("a.h5");
}

TEST_F(RecordedRun, IsIdenticalWhenReplayedAfterAStopCommand) {
    for (const double stop_s : {0.2, 0.63}) {
        for (const bool live : {false, true}) {
            const JobRequest request =
                request_for(program, {}, live ? std::vector<std::string>{"feed=0.8@0.1s"} : std::vector<std::string>{});
            const JobOutcome outcome = record(request, "a.h5", stop_s);
            ASSERT_FALSE(outcome.ended);
            EXPECT_EQ(outcome.ended.error().kind, ErrorKind::stopped);
            expect_same_again("a.h5");
            const auto reader = trace::RecordingReader::open(at("a.h5"));
            ASSERT_EQ(reader->inputs().size(), live ? 2u : 1u);
            EXPECT_EQ(reader->inputs().back().text, "stop");
        }
    }
}

TEST_F(RecordedRun, OfAKilledProgramIsCompleteUpToAnInstant) {
    std::string longer = "G21 G90 F1200\n";
    for (int i = 0; i < 20; ++i) longer += "G1 X30 Y10\nG1 X1 Y1\n";
    const JobRequest request = request_for(longer + "M2\n");
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        auto job = RecordedJob::create(request, {at("cut.h5"), {}});
        if (job)
            (*job)->run(nullptr, [](const JobProgress& progress) {
                if (progress.seconds > 5) ::kill(::getpid(), SIGKILL);
            });
        ::_exit(1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    record(request, "whole.h5");
    EXPECT_FALSE(std::filesystem::exists(at("cut.h5"))) << "it has its name when it is whole";
    const auto diff = trace::diff_files(at("cut.h5.incomplete"), at("whole.h5"));
    ASSERT_TRUE(diff) << diff.error().text();
    EXPECT_TRUE(diff->same()) << trace::diff_text(*diff, "cut", "whole");
    EXPECT_GE(*diff->until, whole_seconds(4)) << "a flush every second of a short job";
    EXPECT_GT(diff->compared, 100'000u);
    const auto cut = trace::RecordingReader::open(at("cut.h5.incomplete"));
    EXPECT_FALSE(cut->whole());
    const auto data = cut->report();
    ASSERT_TRUE(data) << data.error().text();
    EXPECT_GT(data->seconds.size(), 4000u);
    EXPECT_THAT(data->verdict.text, HasSubstr("was cut off"));
}

TEST_F(RecordedRun, RejectsUnknownCommands) {
    Rack rack(request_for(program).config);
    const auto refused = [&](const std::string& order) {
        const auto orders = read_commands({order});
        if (!orders) return orders.error().message;
        const auto plan = CommandSchedule::create(rack, *orders);
        return plan ? std::string() : plan.error().message;
    };
    for (const char* order : {"hold", "hold@", "hold@-1s", "hold@1", "hold=1@1s", "feed@1s", "feed=0@1s", "feed=2.1@1s",
                              "rapid=1.1@1s", "feed=nan@1s", "go@1s", "hold@1s"})
        EXPECT_THAT(refused(order), HasSubstr("Nothing was moved")) << order;
    EXPECT_THAT(refused("hold@1s"), HasSubstr("never end"));
}

// ---- the program

class Recordings : public InFolder {};

TEST_F(Recordings, GiveTheReportOfTheRun) {
    const Ran ran = motionrack(
        "run examples/02_part/part.ngc -q --record a.h5 --report run.html --csv run.csv --events run_events.csv");
    ASSERT_EQ(ran.code, 0) << ran.out;
    ASSERT_EQ(motionrack("report a.h5 --report again.html --csv again.csv --events again_events.csv").code, 0);
    EXPECT_EQ(text_of(folder / "run.html"), text_of(folder / "again.html"));
    EXPECT_EQ(text_of(folder / "run.csv"), text_of(folder / "again.csv"));
    EXPECT_EQ(text_of(folder / "run_events.csv"), text_of(folder / "again_events.csv"));
    const Ran from_csv = motionrack("report run.csv --report csv.html --csv csv.csv");
    ASSERT_EQ(from_csv.code, 0) << from_csv.out;
    EXPECT_EQ(text_of(folder / "run.csv"), text_of(folder / "csv.csv"));
    EXPECT_THAT(text_of(folder / "csv.html"), HasSubstr("does not have the end of the run"));
}

TEST_F(Recordings, AreComparedAndRunAgainWithTheirExitCodes) {
    ASSERT_EQ(motionrack("run examples/01_first_move/first_move.ngc -q --no-report --record a.h5 --vcd a.vcd").code, 0);
    ASSERT_EQ(
        motionrack(
            "run examples/01_first_move/first_move.ngc -q --no-report --record b.h5 --vcd b.vcd --at feed=0.9@0.2s")
            .code,
        0);
    const Ran same = motionrack("replay a.h5"), differ = motionrack("diff a.h5 b.h5"),
              waves = motionrack("diff a.vcd b.vcd"), json = motionrack("diff a.h5 b.h5 --json");
    EXPECT_EQ(same.code, 0);
    EXPECT_THAT(same.out, HasSubstr("the same bit for bit"));
    EXPECT_EQ(motionrack("diff a.h5 a.h5").code, 0);
    EXPECT_EQ(motionrack("diff a.vcd a.vcd").code, 0);
    EXPECT_EQ(differ.code, 6);
    EXPECT_THAT(differ.out, HasSubstr("X.steps, step, at 0.6"));
    EXPECT_EQ(waves.code, 6);
    EXPECT_EQ(json.code, 6);
    EXPECT_THAT(json.out, HasSubstr("\"ticks\": "));
    EXPECT_EQ(motionrack("diff a.h5 a.vcd").code, 2);
    EXPECT_EQ(motionrack("diff a.h5 nowhere.h5").code, 5);
    EXPECT_EQ(motionrack("report a.vcd").code, 2);
    EXPECT_EQ(motionrack("replay a.vcd").code, 2);
    EXPECT_EQ(motionrack("replay a.h5 --record a.h5").code, 3);
    EXPECT_EQ(motionrack("run --record /nowhere/a.h5 -q").code, 5);
}

TEST_F(Recordings, NeverOverwriteAnInputFile) {
    write("a.ngc", "G1 X1 F600\n");
    write("r.toml", *rack::rack_template("router"));
    write("a.ngc.incomplete", "G1 X2 F600\n");
    write("call.ngc", "o<side> call\nM2\n");
    write("side.ngc", "o<side> sub\nG1 X1 F600\no<side> endsub\n");
    write("page.html", "mine");
    std::filesystem::create_symlink("page.html", folder / "link.html");
    ASSERT_EQ(motionrack("run a.ngc -q --no-report --record a.h5").code, 0);
    for (const char* command :
         {"run a.ngc --record a.ngc", "run a.ngc --report ./a.ngc", "run a.ngc --rack r.toml --csv r.toml",
          "run a.ngc --record x.h5 --vcd x.h5", "report a.h5 --report a.h5", "run call.ngc --report side.ngc",
          "run call.ngc --csv ./side.ngc", "plan call.ngc --picture side.ngc", "plan a.ngc --picture a.ngc",
          "plan a.ngc --rack r.toml --picture r.toml", "home --rack r.toml --picture r.toml",
          "run a.ngc --report link.html", "run a.ngc --record link.html", "new router link.html --force",
          "replay a.h5 --record a.h5", "run a.ngc --csv x.csv --events x.csv", "run a.ngc.incomplete --report a.ngc"}) {
        const Ran refused = motionrack(command);
        EXPECT_EQ(refused.code, 3) << command;
        EXPECT_THAT(refused.out, HasSubstr("Nothing was done")) << command;
    }
    EXPECT_EQ(text_of(folder / "a.ngc"), "G1 X1 F600\n");
    EXPECT_THAT(text_of(folder / "side.ngc"), HasSubstr("endsub"));
    EXPECT_EQ(text_of(folder / "page.html"), "mine");
    EXPECT_EQ(text_of(folder / "a.ngc.incomplete"), "G1 X2 F600\n");
    EXPECT_EQ(motionrack("replay a.h5").code, 0);
}

TEST_F(Recordings, AreMadeOfProgramsWithLoopsToolsAndCommands) {
    write("part.ngc", "o1 repeat [3]\no<side> call [4]\no1 endrepeat\nT1 M6 G43 H1\nG0 Z50\nM2\n");
    write("side.ngc", "o<side> sub\nG91 G1 X#1 F1200\nG90\no<side> endsub\n");
    write("tools.tbl", "T1 P1 Z0.00005 D3\n");
    ASSERT_EQ(motionrack("run part.ngc --tools tools.tbl -q --no-report --record a.h5 --at feed=0.5@0.3s").code, 0);
    std::filesystem::remove(folder / "side.ngc");
    std::filesystem::remove(folder / "tools.tbl");
    EXPECT_EQ(motionrack("replay a.h5").code, 0) << "it has all with it";
}

TEST_F(Recordings, GiveTheOutputOfTheirPage) {
    write("part.ngc", text_of(source_root / "examples/01_first_move/first_move.ngc"));
    motionrack("run part.ngc -q --no-report --record before.h5 --at feed=1@0.2s");
    motionrack("run part.ngc -q --no-report --record after.h5 --at feed=0.9@0.2s");
    motionrack(
        "run part.ngc -q --no-report --record held.h5 --at hold@0.3s --at resume@0.5s --fault "
        "Y.motor.lose_steps=64@0.6s");
    std::map<std::string, int> codes = run_page("docs/howto/recordings.md");
    EXPECT_EQ(codes.size(), 4u);
    EXPECT_EQ(codes["diff before.h5 after.h5"], 6);
    EXPECT_EQ(codes["replay held.h5"], 0);
}

TEST_F(Recordings, OpenInPython) {
    if (shell("/usr/bin/python3 -c 'import h5py'").code != 0) GTEST_SKIP() << "python3-h5py is not installed";
    ASSERT_EQ(motionrack("run examples/01_first_move/first_move.ngc -q --no-report --record a.h5").code, 0);
    write("look.py",
          "import h5py, numpy\n"
          "f = h5py.File('a.h5')\n"
          "t, d = f['axes/x/steps/time'], f['axes/x/steps/direction']\n"
          "assert f.attrs['format'].decode() == 'motionrack recording'\n"
          "assert t.attrs['unit'].decode() == 's' and t.attrs['scale'] == 1e-10\n"
          "assert len(t) == len(d) > 1000 and (numpy.diff(t[:]) > 0).all()\n"
          "last = f['samples/x/commanded'][-1] - f['axes/x'].attrs['origin']\n"
          "assert abs(d[:].sum() / f['axes/x'].attrs['pulses_per_unit'] - last) < 1e-9\n"
          "assert f['samples/x/position'].attrs['unit'].decode() == 'mm'\n"
          "assert b'G' in f['run/program'][0] and b'[axis.X]' in f['run/rack'][0]\n"
          "assert f['outcome'].attrs['ended'].decode() == 'yes'\n"
          "print('good')\n");
    EXPECT_EQ(shell("/usr/bin/python3 look.py").out, "good\n");
}

TEST_F(Recordings, OpenInOctave) {
    if (shell("octave-cli --version").code != 0) GTEST_SKIP() << "Octave is not installed";
    ASSERT_EQ(motionrack("run examples/01_first_move/first_move.ngc -q --no-report --record a.h5").code, 0);
    const Ran ran = shell(
        "octave-cli -q --no-window-system --eval \"f = load('a.h5'); t = f.axes.x.steps.time; assert(numel(t) > 1000); "
        "assert(all(diff(double(t(:))) > 0)); "
        "assert(abs(f.samples.x.position(end)) < 1e4); printf('good\\n');\"");
    EXPECT_THAT(ran.out, HasSubstr("good\n"));
}

}  // namespace
}  // namespace motionrack::rack
