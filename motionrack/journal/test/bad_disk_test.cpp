// Journal on a disk whose nth writing call fails, is torn or is lost, and after a power loss at that call. Acknowledged
// entries exist, and no wrong value is accepted.
#include "bad_disk.hpp"

#include <gmock/gmock.h>

#include <tests/environment.hpp>
#include <thread>

#include "journal_file.hpp"

namespace motionrack::journal {
namespace {

using testing::HasSubstr;

/// State of its journal that the program knows when it ends.
struct Known {
    struct Acknowledged {
        std::int64_t number = 0;
        std::string text;
        std::int64_t calls = 0;  ///< number of disk calls at the acknowledgement
    };
    /// Number of disk calls when each step was done; -1: not done.
    struct Run {
        std::string kept;  ///< last kept value
        std::int64_t opening = -1, closing = -1, closed = -1;
    };
    std::vector<Acknowledged> entries;
    std::map<std::int64_t, Run> runs;  ///< by run number
};

/// A program with a journal: writes, waits for each answer, and closes.
class Program {
  public:
    Program(std::string path, const BadDisk& disk) : path_(std::move(path)), disk_(disk) {}

    bool open() {
        const std::int64_t opening = disk_.calls();
        auto opened = Journal::open(path_);
        if (!opened) return false;
        journal_ = std::move(*opened);
        run() = {"", opening, -1, -1};
        return true;
    }
    void entry(const std::string& text) {
        if (!journal_) return;
        std::promise<void> answered;
        journal_->write(Instant{5}, "audit", text, "{}", [&](const Result<std::int64_t>& number) {
            if (number) known.entries.push_back({*number, text, disk_.calls()});
            answered.set_value();
        });
        answered.get_future().wait();
    }
    /// Keeps a value, then writes an entry, whose acknowledgement shows that the value is written.
    void keep(const std::string& value) {
        if (!journal_) return;
        journal_->keep("machine", value);
        run().kept = value;
        entry("kept " + value);
    }
    void close() {
        if (!journal_) return;
        run().closing = disk_.calls();
        if (journal_->close()) run().closed = disk_.calls();
        journal_.reset();
    }

    Known known;

  private:
    Known::Run& run() { return known.runs[journal_->run()]; }

    std::string path_;
    const BadDisk& disk_;
    std::unique_ptr<Journal> journal_;
};

struct Scenario {
    const char* name;
    void (*run)(Program& program);
};

const Scenario scenarios[] = {
    {"an entry",
     [](Program& p) {
         p.open();
         p.entry("one");
         p.close();
     }},
    {"entries and where the machine stood",
     [](Program& p) {
         p.open();
         for (int i = 0; i < 5; ++i) {
             p.entry("entry " + std::to_string(i));
             p.keep("X " + std::to_string(i));
         }
         p.close();
     }},
    {"entries of several pages",
     [](Program& p) {
         p.open();
         p.keep("X 1");
         for (const char c : {'a', 'b', 'c'}) p.entry(std::string(30'000, c));
         p.keep("X 2");
         p.close();
     }},
    {"three runs",
     [](Program& p) {
         for (int run = 1; run <= 3; ++run) {
             if (!p.open()) continue;
             p.keep("X " + std::to_string(10 * run));
             p.entry("run " + std::to_string(run));
             p.keep("X " + std::to_string(10 * run + 1));
             p.close();
         }
     }},
    {"a log that goes around",
     [](Program& p) {
         p.open();
         for (int i = 0; i < 30; ++i) {
             p.entry(std::string(200'000, static_cast<char>('a' + i % 26)));
             p.keep("X " + std::to_string(i));
         }
         p.close();
     }},
};

class OnABadDisk : public JournalFile, public testing::WithParamInterface<Scenario> {
  protected:
    OnABadDisk() : state_(path_ + ".state") {}
    ~OnABadDisk() override {
        for (const char* end : {"", "-journal", "-wal", "-shm", ".lock"}) std::filesystem::remove(state_ + end);
    }
    /// Returns the numbers of all writing calls, or of a selection by the seed and of the last call.
    std::vector<std::int64_t> chosen(std::int64_t calls, std::uint64_t everyday) const {
        std::vector<std::int64_t> out = spread_by_seed(calls, trials("MOTIONRACK_JOURNAL_CALLS", everyday, 100));
        for (std::int64_t& one : out) ++one;
        if (!out.empty()) out.push_back(calls);
        return out;
    }
    std::int64_t all_calls() {
        remove();
        const BadDisk disk;
        Program program(path_, disk);
        GetParam().run(program);
        return disk.calls();
    }
    /// Checks the file at `path` against `known` after `calls` disk calls. `lies`: the disk reported success for lost
    /// writes.
    static void check(const std::string& path, const Known& known, std::int64_t calls, bool lies) {
        const Result<std::unique_ptr<Journal>> journal = Journal::open(path);
        if (!journal) {
            EXPECT_TRUE(lies) << journal.error().message;
            EXPECT_THAT(journal.error().message, HasSubstr(path));
            return;
        }
        const auto read = (*journal)->read({0, "", 10000});
        ASSERT_TRUE(read || lies) << read.error().message;
        std::map<std::int64_t, std::string> there;
        if (read)
            for (const Entry& entry : *read) there[entry.number] = entry.text;
        for (const Known::Acknowledged& one : known.entries) {
            if (one.calls > calls) continue;
            ASSERT_TRUE(lies || there.count(one.number) == 1) << "entry " << one.number << " was acknowledged";
            // A disk that loses confirmed writes may cause a number to be assigned twice.
            if (!lies) {
                ASSERT_EQ(there[one.number], one.text);
            }
        }
        check_trust((*journal)->before(), known, calls, lies);
    }
    /// Checks that an accepted value is the last one kept before closing began, and that a closed run is accepted.
    static void check_trust(const std::optional<LastRun>& before, const Known& known, std::int64_t calls, bool lies) {
        const bool trusted = before && before->clean && before->doubts.empty();
        if (trusted) {
            ASSERT_EQ(known.runs.count(before->run), 1u);
            const Known::Run& run = known.runs.at(before->run);
            ASSERT_EQ(before->kept.count("machine") == 1 ? before->kept.at("machine") : "", run.kept);
            ASSERT_TRUE(run.closing >= 0 && run.closing <= calls);
        }
        for (const auto& [number, run] : known.runs) {
            const auto next = known.runs.find(number + 1);
            if (lies || run.closed < 0 || run.closed > calls ||
                (next != known.runs.end() && next->second.opening < calls))
                continue;
            ASSERT_TRUE(before);
            if (before->run == number) {
                EXPECT_TRUE(trusted) << "run " << number << " was closed";
            }
        }
    }

    std::string state_;
};

TEST_P(OnABadDisk, WithAFailingWriteLosesNothingAcknowledgedAndValidatesNoWrongValue) {
    const std::int64_t calls = all_calls();
    for (const BadDisk::Fault fault :
         {BadDisk::Fault::fail, BadDisk::Fault::stay, BadDisk::Fault::tear, BadDisk::Fault::drop})
        for (const std::int64_t nth : chosen(calls, 3)) {
            SCOPED_TRACE("fault " + std::to_string(static_cast<int>(fault)) + " at call " + std::to_string(nth));
            remove();
            Known known;
            {
                const BadDisk disk({fault, nth});
                Program program(path_, disk);
                GetParam().run(program);
                known = program.known;
            }
            check(path_, known, std::numeric_limits<std::int64_t>::max(), fault == BadDisk::Fault::drop);
            if (HasFatalFailure()) return;
        }
}

TEST_P(OnABadDisk, WithAPowerLossAtAnyWriteLosesNothingAcknowledgedAndValidatesNoWrongValue) {
    const auto seed = static_cast<std::uint32_t>(seed_from_environment());
    std::mt19937 random(seed);
    remove();
    const BadDisk disk;
    Program program(path_, disk);
    GetParam().run(program);
    const std::int64_t calls = disk.calls();
    for (const std::int64_t after : chosen(calls, 8))
        for (int luck = 0; luck < 2; ++luck) {
            SCOPED_TRACE("power lost after call " + std::to_string(after) +
                         ", MOTIONRACK_SEED=" + std::to_string(seed));
            disk.write_state(after, random, path_, state_);
            check(state_, program.known, after, false);
            if (HasFatalFailure()) return;
        }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, OnABadDisk, testing::ValuesIn(scenarios), [](const auto& one) {
    std::string out = one.param.name;
    std::replace(out.begin(), out.end(), ' ', '_');
    return out;
});

}  // namespace
}  // namespace motionrack::journal
