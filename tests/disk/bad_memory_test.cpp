// Commands on a computer whose nth allocation fails. With exit code 0 the results equal those of a normal run.
// Otherwise an error message has the reason, and each result file is either unchanged or complete.
#include <gmock/gmock.h>

#include <motionrack/trace/diff.hpp>
#include <tests/environment.hpp>
#include <tests/ran.hpp>

namespace motionrack {
namespace {

using testing::HasSubstr;

struct Task {
    const char* name;
    const char* command;
    std::vector<const char*> results;
};

/// Command with only the allocations that every command makes before it begins.
const char* const no_command = "--version";

const Task tasks[] = {
    {"start", no_command, {}},
    {"check", "check part.ngc", {}},
    {"run", "run part.ngc -q --no-report", {}},
    {"run_with_results", "run part.ngc -q --report a.html --record a.h5 --csv a.csv", {"a.html", "a.h5", "a.csv"}},
    {"mark", "mark job.toml -q --picture a.svg", {"a.svg"}},
    {"report", "report given.h5 --report a.html", {"a.html"}},
    {"plan", "plan part.ngc --picture a.svg", {"a.svg"}},
    {"homing", "home X --picture a.svg -q", {"a.svg"}},
    {"sweep", "sweep sweep.toml -q --jobs 1 --restart -o a.csv", {"a.csv"}},
    {"rack_file", "new router a.toml --force", {"a.toml"}},
    {"image", "image make part.ngc -o a.bin", {"a.bin"}},
};

class WithoutMemory : public InFolder, public testing::WithParamInterface<Task> {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("part.ngc", "G21 G90\nG1 X2 Y1 F1200\nX0 Y0\nM2\n");
        write("job.toml", "[drawing]\ntext = 'A'\n");
        write("sweep.toml",
              "[sweep]\nprogram = \"part.ngc\"\n"
              "[vary]\naxis.X.max_accel_mm_s2 = { from = 500, to = 900, steps = 2 }\n");
        if (std::string(GetParam().command).find("given.h5") != std::string::npos) {
            ASSERT_EQ(motionrack("run part.ngc -q --no-report --record given.h5").code, 0);
        }
    }
    Ran run_on(const std::string& plan, const std::string& command = GetParam().command) {
        for (const char* result : GetParam().results) write(result, old_text(result));
        std::filesystem::remove(folder / "a.csv.part");
        return shell("MOTIONRACK_BAD_NEW='" + plan +
                     "' MOTIONRACK_BAD_NEW_COUNT=count LD_PRELOAD=" MOTIONRACK_BAD_MEMORY " " MOTIONRACK_PROGRAM " " +
                     command);
    }
    /// Returns the earlier content of a result. A sweep overwrites only the table of a sweep, so its file starts empty.
    static std::string old_text(const std::string& result) {
        return std::string(GetParam().command).starts_with("sweep") ? "" : "old " + result;
    }
    std::int64_t allocations_of(const char* command) {
        const Ran ran = run_on("0", command);
        EXPECT_EQ(ran.code, 0) << ran.out;
        return std::atoll(text_of(folder / "count").c_str());
    }
    /// Selects allocations after number `first` to fail, by the seed; all of them if MOTIONRACK_ALLOCATIONS is large
    /// enough.
    static std::vector<std::int64_t> chosen(std::int64_t first, std::int64_t calls) {
        std::vector<std::int64_t> out = spread_by_seed(calls - first, trials("MOTIONRACK_ALLOCATIONS", 6, 100));
        for (std::int64_t& one : out) one = calls - one;
        return out;
    }
    void check(const Ran& ran, const Ran& good, const std::map<std::string, std::string>& results) const {
        EXPECT_TRUE(ran.code == 0 || ran.code == 5) << ran.code << ": " << ran.out;
        if (ran.code == 0) {
            EXPECT_EQ(ran.out, good.out);
        } else {
            EXPECT_THAT(ran.out, HasSubstr("error: "));
        }
        for (const auto& [result, text] : results) {
            const std::string now = text_of(folder / result);
            EXPECT_TRUE(now == text || same_recording(result, text) || (ran.code != 0 && now == old_text(result)))
                << result << " has " << now.size() << " bytes instead of " << text.size() << ". Exit code " << ran.code
                << ": " << ran.out;
        }
    }
    bool same_recording(const std::string& result, const std::string& text) const {
        if (!result.ends_with(".h5") || text_of(folder / result).size() < 100) return false;
        write("good.h5", text);
        const auto diff = trace::diff_files((folder / "good.h5").string(), (folder / result).string());
        return diff && diff->same();
    }
};

TEST_P(WithoutMemory, ACommandReportsItAndLeavesNothingBroken) {
    const Ran first = run_on("0");
    ASSERT_EQ(first.code, 0) << first.out;
    const std::int64_t count = std::atoll(text_of(folder / "count").c_str());
    ASSERT_GT(count, 100);
    std::map<std::string, std::string> good;
    for (const char* result : GetParam().results) good[result] = text_of(folder / result);
    // Skips nine tenths of the common allocations; reading the arguments is in the last tenth.
    const std::int64_t before = GetParam().command == no_command ? 0 : allocations_of(no_command) * 9 / 10;
    ASSERT_LT(before, count);
    for (const std::int64_t nth : chosen(before, count))
        for (const char* more : {"", " on"}) {
            const std::string plan = std::to_string(nth) + more;
            SCOPED_TRACE(plan + " of " + std::to_string(count));
            check(run_on(plan), first, good);
        }
}

INSTANTIATE_TEST_SUITE_P(Tasks, WithoutMemory, testing::ValuesIn(tasks),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace motionrack
