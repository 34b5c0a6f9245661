// Every command that writes, on a disk whose nth read or write fails, is torn or is lost. With exit code 0 all results
// equal those on a good disk. Otherwise an error message has the reason, and each result file is either unchanged or
// complete.
#include <gmock/gmock.h>

#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/sweep/results.hpp>
#include <motionrack/trace/diff.hpp>
#include <tests/environment.hpp>
#include <tests/ran.hpp>

namespace motionrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Scenario {
    const char* name;
    const char* command;
    std::vector<const char*> results;
};

const Scenario replay = {"replay", "replay given.h5 -q --record a.h5", {"a.h5"}};
const Scenario scenarios[] = {
    {"recording", "run part.ngc -q --no-report --record a.h5", {"a.h5"}},
    {"recording_with_faults", "run part.ngc -q --no-report --record a.h5 --at feed=0.5@0.1s", {"a.h5"}},
    {"recording_of_subprograms", "run call.ngc -q --no-report --record a.h5", {"a.h5"}},
    {"waves", "run part.ngc -q --no-report --vcd a.vcd --signals X.enc_?", {"a.vcd"}},
    {"samples", "run part.ngc -q --no-report --csv a.csv", {"a.csv"}},
    {"events", "run part.ngc -q --no-report --events a.csv", {"a.csv"}},
    {"page", "run part.ngc -q --report a.html", {"a.html"}},
    {"all_of_a_run",
     "run part.ngc -q --report a.html --csv a.csv --events b.csv --vcd a.vcd --record a.h5",
     {"a.html", "a.csv", "b.csv", "a.vcd", "a.h5"}},
    {"trace", "trace part.ngc a.vcd -q --signals X.step", {"a.vcd"}},
    {"page_of_a_recording", "report given.h5 --report a.html --csv a.csv --events b.csv", {"a.html", "a.csv", "b.csv"}},
    replay,
    {"sweep_to_csv", "sweep sweep.toml -q --jobs 1 --restart -o a.csv", {"a.csv"}},
    {"sweep_to_hdf5", "sweep sweep.toml -q --jobs 1 --restart -o a.h5", {"a.h5"}},
    {"sweep_with_a_picture", "sweep sweep.toml -q --jobs 1 --restart -o a.csv --picture a.svg", {"a.csv", "a.svg"}},
    {"plan", "plan part.ngc --picture a.svg", {"a.svg"}},
    {"homing", "home X --picture a.svg -q", {"a.svg"}},
    {"mark", "mark job.toml -q --picture a.svg --report a.html", {"a.svg", "a.html"}},
    {"mark_with_a_correction_file", "mark corrected.toml -q --picture a.svg", {"a.svg"}},
    {"mark_as_png", "mark job.toml -q --picture a.png", {"a.png"}},
    {"rack_file", "new router a.toml --force", {"a.toml"}},
    {"image", "image make part.ngc -o a.bin --axis 0=reversed", {"a.bin"}},
    {"image_as_c", "image make part.ngc -o a.h", {"a.h"}},
    {"image_as_pascal", "image make part.ngc -o a.pas", {"a.pas"}},
    {"check", "check part.ngc", {}},
    {"frames", "frames stage.toml -q --duration 0.002 --vcd a.vcd --picture a.svg", {"a.vcd", "a.svg"}},
};

class FaultyDisk : public InFolder, public testing::WithParamInterface<Scenario> {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("part.ngc", "G21 G90\nG1 X2 Y1 F1200\nX0 Y0\nM2\n");
        write("call.ngc", "o<side> call [1]\nM2\n");
        write("side.ngc", "o<side> sub\nG21 G1 X#1 F1200\no<side> endsub\n");
        write(
            "sweep.toml",
            "[sweep]\nprogram = \"part.ngc\"\n[vary]\naxis.X.max_accel_mm_s2 = { from = 500, to = 4000, steps = 3 }\n");
        write("job.toml", "[drawing]\ntext = 'A'\n");
        write("stage.toml", text_of(source_root / "examples/13_stage/machine.toml"));
        const std::string command = GetParam().command;
        if (command.find("corrected.toml") != std::string::npos) write_correction();
        if (command.find("given.h5") != std::string::npos) {
            ASSERT_EQ(motionrack("run part.ngc -q --no-report --record given.h5").code, 0);
        }
    }
    /// Writes a marking job whose optics have the correction file of a lens.
    void write_correction() const {
        const auto table = rtc5::correction_of({{255.059, -1.365, 1.493, -18.087}, 11.7, 5184}, 721);
        const std::vector<std::uint8_t> bytes = rtc5::written_ct5(*table);
        write("lens.ct5", std::string(bytes.begin(), bytes.end()));
        write("corrected.toml", "[drawing]\ntext = 'A'\n[optics]\nct5 = 'lens.ct5'\n");
    }
    /// Runs the command in a folder with the results of an earlier run. `plan`: fault of the disk, "fail 12".
    Ran run_on(const std::string& plan) {
        for (const char* result : GetParam().results) write(result, old_text(result));
        fs::remove(folder / "a.csv.part");
        fs::remove(folder / "a.h5.part");
        return shell("MOTIONRACK_BAD_FOLDER=\"$PWD/\" MOTIONRACK_BAD_CALL='" + plan +
                     "' MOTIONRACK_BAD_COUNT=/tmp/count_" + std::to_string(::getpid()) +
                     " LD_PRELOAD=" + MOTIONRACK_BAD_CALLS + " " MOTIONRACK_PROGRAM " " + GetParam().command);
    }
    std::int64_t calls() const {
        const fs::path path = "/tmp/count_" + std::to_string(::getpid());
        const std::int64_t count = std::atoll(text_of(path).c_str());
        fs::remove(path);
        return count;
    }
    /// Returns the earlier content of a result. A sweep overwrites only the table of a sweep, so its file starts empty.
    static std::string old_text(const std::string& result) {
        return std::string(GetParam().command).find("sweep") == 0 && result != "a.svg" ? "" : "old " + result;
    }
    /// Selects calls to fail, by the seed; all of them if MOTIONRACK_CALLS is large enough.
    static std::vector<std::int64_t> chosen(std::int64_t calls) {
        std::vector<std::int64_t> out = spread_by_seed(calls, trials("MOTIONRACK_CALLS", 2, 12));
        for (std::int64_t& one : out) one = calls - one;
        return out;
    }
    void check(const Ran& ran, const std::map<std::string, std::string>& good) const {
        // A recording that cannot be read completely is reported as damaged (exit code 2).
        const bool reads = std::string(GetParam().command).find("given.h5") != std::string::npos;
        EXPECT_TRUE(ran.code == 0 || ran.code == 5 || (reads && ran.code == 2)) << ran.code << ": " << ran.out;
        if (ran.code != 0) {
            EXPECT_THAT(ran.out, HasSubstr("error: "));
        }
        for (const auto& [result, text] : good) {
            const std::string now = text_of(folder / result);
            const bool whole = now == text || same_recording(result, text);
            EXPECT_TRUE(whole || (ran.code != 0 && now == old_text(result)))
                << result << " has " << now.size() << " bytes; on a good disk " << text.size() << ". Exit code "
                << ran.code << ": " << ran.out;
        }
    }
    /// Compares the contents of recordings: bytes that are never read may differ, and zeros need not be written.
    bool same_recording(const std::string& result, const std::string& text) const {
        if (!result.ends_with(".h5") || text_of(folder / result).size() < 100) return false;
        write("good.h5", text);
        if (std::string(GetParam().command).starts_with("sweep")) {
            const auto good = sweep::read_rows_hdf5((folder / "good.h5").string()),
                       now = sweep::read_rows_hdf5((folder / result).string());
            return good && now && !good->empty() && *good == *now;
        }
        const auto diff = trace::diff_files((folder / "good.h5").string(), (folder / result).string());
        return diff && diff->same();
    }
};

TEST_P(FaultyDisk, LeavesTheOldResultOrTheWholeNewOne) {
    const Ran first = run_on("fail 0");
    ASSERT_EQ(first.code, 0) << first.out;
    const std::int64_t count = calls();
    ASSERT_GT(count, 0);
    std::map<std::string, std::string> good;
    for (const char* result : GetParam().results) good[result] = text_of(folder / result);
    for (const std::int64_t nth : chosen(count))
        for (const char* fault : {"fail", "tear", "drop"}) {
            const std::string plan = fault + (" " + std::to_string(nth));
            SCOPED_TRACE(plan + " of " + std::to_string(count));
            check(run_on(plan), good);
        }
    calls();
}

INSTANTIATE_TEST_SUITE_P(Commands, FaultyDisk, testing::ValuesIn(scenarios),
                         [](const auto& one) { return std::string(one.param.name); });

class FirstReadsOfARecording : public FaultyDisk {};

TEST_P(FirstReadsOfARecording, AreErrorsWhereTheDiskFails) {
    ASSERT_EQ(run_on("fail 0").code, 0);
    std::map<std::string, std::string> good;
    for (const char* result : GetParam().results) good[result] = text_of(folder / result);
    for (int nth = 1; nth <= 40; ++nth) {
        SCOPED_TRACE(nth);
        check(run_on("fail " + std::to_string(nth)), good);
    }
    calls();
}

INSTANTIATE_TEST_SUITE_P(Commands, FirstReadsOfARecording, testing::Values(replay),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace motionrack
