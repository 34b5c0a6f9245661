// A journal on a failing disk: it reports the failure permanently and never ends regularly.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <atomic>
#include <csignal>
#include <fstream>

#include "bad_disk.hpp"
#include "journal_file.hpp"

namespace motionrack::journal {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;

class JournalOnABadDisk : public JournalFile {
  protected:
    /// Waits until the journal reports a failure; the time limit of the test applies.
    static std::string failure_of(const Journal& journal) {
        while (journal.failure().empty()) std::this_thread::yield();
        return journal.failure();
    }
    /// Checks that the next run sees no regular end.
    void expect_no_clean_end(std::unique_ptr<Journal> journal) const {
        const Result<void> closed = journal->close();
        ASSERT_FALSE(closed);
        EXPECT_THAT(closed.error().message, HasSubstr("no position is valid at the next start"));
        journal.reset();
        const auto next = open();
        ASSERT_TRUE(next);
        ASSERT_TRUE(next->before());
        EXPECT_FALSE(next->before()->clean);
    }
};

TEST_F(JournalOnABadDisk, ReportsAFullDiskAndHasNoCleanEnd) {
    auto journal = open();
    journal->keep("machine", "X 7");
    EXPECT_EQ(write(*journal, "state", "fits"), 1);
    EXPECT_THAT(journal->failure(), IsEmpty());
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto old = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{8192, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    journal->keep("machine", "X 62");
    EXPECT_EQ(write(*journal, "state", std::string(100'000, 'x')), -1);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    ::signal(SIGXFSZ, old);
    EXPECT_THAT(journal->failure(), HasSubstr("could not be written"));
    EXPECT_GT(write(*journal, "state", "the disk takes it again"), 1);
    EXPECT_THAT(journal->failure(), HasSubstr("could not be written")) << "it stays known";
    expect_no_clean_end(std::move(journal));
    EXPECT_EQ(all_entries().size(), 2u);
}

TEST_F(JournalOnABadDisk, IsRefusedIfItsStartCannotBeWritten) {
    EXPECT_TRUE(open()->close());
    {
        const BadDisk disk({BadDisk::Fault::stay, 1});
        const auto refused = Journal::open(path_);
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message, AllOf(HasSubstr("cannot be written"), HasSubstr("Free the disk")));
    }
    EXPECT_TRUE(open()->before()->clean) << "the refused start has left nothing";
}

/// One reading call fails after another, until none is left to fail.
TEST_F(JournalOnABadDisk, IsRefusedIfItsStructureCannotBeRead) {
    std::string said;
    bool is_read = false;
    for (int nth = 1; !is_read; ++nth) {
        SCOPED_TRACE(nth);
        remove();
        EXPECT_TRUE(open()->close());
        change("PRAGMA journal_mode = DELETE");  // without a log each statement begins with a reading call
        const BadDisk disk({BadDisk::Fault::none, 0, nth});
        const auto opened = Journal::open(path_);
        is_read = disk.reads() < nth;
        if (opened) {
            ASSERT_TRUE((*opened)->before());
            EXPECT_TRUE((*opened)->before()->clean);
            EXPECT_THAT((*opened)->before()->damage, IsEmpty());
            EXPECT_THAT((*opened)->before()->doubts, IsEmpty());
            continue;
        }
        EXPECT_THAT(opened.error().message,
                    AllOf(HasSubstr(path_), AnyOf(HasSubstr("disk I/O error"), HasSubstr("unable to get the page"))));
        said += opened.error().message;
    }
    EXPECT_THAT(said, HasSubstr("is damaged: disk I/O error. Nothing was started."));
}

TEST_F(JournalOnABadDisk, DetectsThatOneOfItsFilesWasDeletedReplacedOrTruncated) {
    const auto copy_over = [this](const char* end) {
        fs::copy_file(path_ + end, path_ + ".copy");
        fs::rename(path_ + ".copy", path_ + end);
    };
    const std::pair<std::function<void()>, const char*> changes[] = {
        {[&] { fs::remove(path_); }, "was deleted"},           {[&] { fs::remove(path_ + "-wal"); }, "was deleted"},
        {[&] { fs::remove(path_ + ".lock"); }, "was deleted"}, {[&] { copy_over(""); }, "was replaced"},
        {[&] { copy_over("-wal"); }, "was replaced"},          {[&] { fs::resize_file(path_, 0); }, "was cut"},
    };
    for (const auto& [change_it, reported] : changes) {
        remove();
        auto journal = open();
        EXPECT_EQ(write(*journal, "state", "there"), 1);
        change_it();
        EXPECT_THAT(failure_of(*journal), HasSubstr(reported));
        EXPECT_EQ(write(*journal, "state", "not there"), -1) << reported << ": nothing is acknowledged that is lost";
        EXPECT_FALSE(journal->close()) << reported;
    }
}

TEST_F(JournalOnABadDisk, WithWritesThatTakeSecondsDelaysNoWritingThread) {
    BadDisk disk;
    auto journal = open();
    disk.hold(true);
    std::atomic<int> acknowledged = 0;
    for (int i = 0; i < 1000; ++i) {
        journal->keep("machine", std::to_string(i));
        journal->write(Instant{i}, "state", "moves on", "{}",
                       [&](const Result<std::int64_t>& number) { acknowledged += number.has_value(); });
    }
    EXPECT_EQ(acknowledged, 0) << "the thread that moves came here while nothing was written";
    disk.hold(false);
    EXPECT_TRUE(journal->close());
    EXPECT_EQ(acknowledged, 1000);
    journal.reset();
    const auto next = open();
    ASSERT_TRUE(next->before());
    EXPECT_TRUE(next->before()->clean);
    EXPECT_EQ(next->before()->kept.at("machine"), "999");
}

TEST_F(JournalOnABadDisk, FailsIfTooManyEntriesArePending) {
    auto journal = open();
    sqlite3* other = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
    for (std::size_t i = 0; journal->failure().empty() && i < 3 * Journal::max_waiting; ++i)
        journal->write(Instant{}, "state", "waits");
    EXPECT_THAT(journal->failure(), HasSubstr("100000 entries wait for the disk"));
    sqlite3_close(other);
    expect_no_clean_end(std::move(journal));
}

}  // namespace
}  // namespace motionrack::journal
