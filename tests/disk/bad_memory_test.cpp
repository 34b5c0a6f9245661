// Commands on a computer whose nth allocation fails: with exit code 0 the results are as ever; else a sentence says
// what is missing, and under each name stands what stood there before, or the whole result.
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

const Task tasks[] = {
    {"check", "check part.ngc", {}},
    {"run", "run part.ngc -q --no-report", {}},
    {"run_with_results", "run part.ngc -q --report a.html --record a.h5 --csv a.csv", {"a.html", "a.h5", "a.csv"}},
    {"mark", "mark job.toml -q --picture a.svg", {"a.svg"}},
    {"report", "report given.h5 --report a.html", {"a.html"}},
    {"plan", "plan part.ngc --picture a.svg", {"a.svg"}},
};

class WithoutMemory : public InFolder, public testing::WithParamInterface<Task> {
  protected:
    void SetUp() override {
        InFolder::SetUp();
        write("part.ngc", "G21 G90\nG1 X2 Y1 F1200\nX0 Y0\nM2\n");
        write("job.toml", "[drawing]\ntext = 'A'\n");
        if (std::string(GetParam().command).find("given.h5") != std::string::npos) {
            ASSERT_EQ(motionrack("run part.ngc -q --no-report --record given.h5").code, 0);
        }
    }
    Ran run_on(const std::string& plan) {
        for (const char* result : GetParam().results) write(result, std::string("old ") + result);
        return shell("MOTIONRACK_BAD_NEW='" + plan +
                     "' MOTIONRACK_BAD_NEW_COUNT=count LD_PRELOAD=" MOTIONRACK_BAD_MEMORY " " MOTIONRACK_PROGRAM " " +
                     GetParam().command);
    }
    /// Some of the allocations, the last one too; MOTIONRACK_ALLOCATIONS=1000000: all.
    static std::vector<std::int64_t> chosen(std::int64_t calls) {
        const auto count = static_cast<std::int64_t>(trials("MOTIONRACK_ALLOCATIONS", 6, 100));
        std::vector<std::int64_t> out;
        for (std::int64_t i = 0; i < std::min(calls, count); ++i)
            out.push_back(calls - i * calls / std::min(calls, count));
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
            EXPECT_TRUE(now == text || same_recording(result, text) || (ran.code != 0 && now == "old " + result))
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

TEST_P(WithoutMemory, ACommandSaysSoAndLeavesNothingBroken) {
    const Ran first = run_on("0");
    ASSERT_EQ(first.code, 0) << first.out;
    const std::int64_t count = std::atoll(text_of(folder / "count").c_str());
    ASSERT_GT(count, 100);
    std::map<std::string, std::string> good;
    for (const char* result : GetParam().results) good[result] = text_of(folder / result);
    for (const std::int64_t nth : chosen(count))
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
