// State of a journal after its end, and its size before.
#include <gmock/gmock.h>

#include <fstream>
#include <motionrack/journal/file_watch.hpp>

#include "journal_file.hpp"

namespace motionrack::journal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

std::ptrdiff_t open_descriptors() {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

TEST_F(JournalFile, LeavesNeitherADescriptorNorALogBehind) {
    open();
    const std::ptrdiff_t before = open_descriptors();
    for (int i = 0; i < 5; ++i) {
        const auto journal = open();
        write(*journal, "state", "moving");
        EXPECT_TRUE(fs::exists(path_ + "-wal"));
        EXPECT_TRUE(journal->close());
    }
    EXPECT_EQ(open_descriptors(), before);
    EXPECT_FALSE(fs::exists(path_ + "-wal")) << "all of it is in the file";
}

TEST_F(JournalFile, OfAStartThatFailsIsLeftAsThePreviousRunEnded) {
    {
        const auto journal = open();
        journal->keep("machine", "X 7");
        write(*journal, "state", "moving");
        EXPECT_TRUE(journal->close());
    }
    {
        const auto prepared = Journal::prepare(path_);
        ASSERT_TRUE(prepared) << prepared.error().message;
        (*prepared)->keep("machine", "X 8");
        (*prepared)->write(Instant{}, "audit", "a stranger came");
        EXPECT_TRUE((*prepared)->close()) << "no run is open";
    }
    const auto next = open();
    ASSERT_TRUE(next && next->before());
    EXPECT_TRUE(next->before()->clean);
    EXPECT_THAT(next->before()->doubts, IsEmpty());
    EXPECT_EQ(next->before()->kept.at("machine"), "X 7");
    EXPECT_EQ(next->run(), 2);
    EXPECT_EQ(all_entries().size(), 1u);
}

/// The log cannot be merged into the file then, and the file alone would still show the previous run's end.
TEST_F(JournalFile, ThatAnotherProgramReadsIsRefusedAndKeepsTheEndOfItsLastRun) {
    {
        const auto journal = open();
        journal->keep("machine", "X 7");
        EXPECT_TRUE(journal->close());
    }
    sqlite3* other = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(other, "BEGIN; SELECT count(*) FROM run", nullptr, nullptr, nullptr), SQLITE_OK);
    const auto refused = Journal::open(path_);
    sqlite3_close(other);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                testing::AllOf(HasSubstr("was read by another program for more than 5 s. Nothing was started"),
                               HasSubstr("close that program, then start again")));
    const auto next = open();
    ASSERT_TRUE(next && next->before());
    EXPECT_TRUE(next->before()->clean);
    EXPECT_EQ(next->before()->kept.at("machine"), "X 7");
    EXPECT_EQ(next->run(), 2);
}

TEST_F(JournalFile, WritesTheEntriesThatWaitedForItsRun) {
    {
        const auto journal = Journal::prepare(path_);
        ASSERT_TRUE(journal) << journal.error().message;
        (*journal)->write(Instant{}, "audit", "a stranger came");
        (*journal)->keep("machine", "X 8");
        EXPECT_THAT(all_entries(), IsEmpty());
        ASSERT_TRUE((*journal)->begin());
        EXPECT_TRUE((*journal)->close());
    }
    EXPECT_EQ(all_entries().at(1), "a stranger came");
    EXPECT_EQ(open()->before()->kept.at("machine"), "X 8");
}

TEST_F(JournalFile, ThatIsClosedRefusesAnEntryAtOnce) {
    const auto journal = open();
    EXPECT_TRUE(journal->close());
    std::string refused;
    journal->write(Instant{}, "state", "too late", "{}",
                   [&](const Result<std::int64_t>& number) { refused = number ? "written" : number.error().message; });
    EXPECT_EQ(refused, "It was not written to the journal, which is closed.");
    EXPECT_THAT(journal->failure(), IsEmpty());
    remove();
    EXPECT_TRUE(journal->close()) << "it has ended already";
}

TEST_F(JournalFile, AcceptsPendingEntriesUpToItsLimit) {
    const auto journal = open();
    std::promise<void> busy, go_on;
    journal->write(Instant{}, "state", "first", "{}", [&](const Result<std::int64_t>&) {
        busy.set_value();
        go_on.get_future().wait();
    });
    busy.get_future().wait();
    for (std::size_t i = 0; i < Journal::max_waiting; ++i) journal->write(Instant{}, "state", "waits");
    EXPECT_THAT(journal->failure(), IsEmpty());
    journal->write(Instant{}, "state", "one too many");
    EXPECT_THAT(journal->failure(), HasSubstr("100000 entries wait for the disk"));
    std::string refused;
    journal->write(Instant{}, "state", "another one", "{}",
                   [&](const Result<std::int64_t>& number) { refused = number ? "written" : number.error().message; });
    EXPECT_EQ(refused, "It was not written to the journal: 100000 entries wait for the disk, which is the limit.");
    go_on.set_value();
    EXPECT_FALSE(journal->close());
    EXPECT_EQ(all_entries().size(), Journal::max_waiting + 1);
}

TEST_F(JournalFile, RemovesEntriesBeyondTheNewestMillionAtItsStart) {
    open()->close();
    change(
        "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 1000005) "
        "INSERT INTO entry (number, run, utc_ms, at, kind, text, data, link) "
        "SELECT i, 1, 0, 0, 'state', '', '', '' FROM n");
    open()->close();
    const std::map<std::int64_t, std::string> left = all_entries();
    EXPECT_EQ(left.size(), static_cast<std::size_t>(Journal::max_entries));
    EXPECT_EQ(left.begin()->first, 6);
}

TEST(FileWatch, DetectsThatAFileAddedSinceItsStartIsGone) {
    const std::string path = testing::TempDir() + "file_watch_" + std::to_string(::getpid());
    std::ofstream(path) << "begun";
    FileWatch watch;
    ASSERT_TRUE(watch.add(path));
    EXPECT_TRUE(watch.check());
    std::ofstream(path, std::ios::app) << " and gone on";
    EXPECT_TRUE(watch.check());
    fs::resize_file(path, 8);
    const Result<void> cut = watch.check();
    ASSERT_FALSE(cut);
    EXPECT_THAT(cut.error().message, HasSubstr("was cut from 17 to 8 bytes"));
    fs::remove(path);
    FileWatch without;
    const Result<void> added = without.add(path);
    ASSERT_FALSE(added);
    EXPECT_THAT(added.error().message, HasSubstr("cannot be watched: the file '" + path + "'"));
    EXPECT_TRUE(without.check()) << "a file that was missing is not watched";
}

TEST(FileWatch, DetectsThatALinkHasTakenThePlaceOfAFile) {
    const std::string path = testing::TempDir() + "file_watch_link_" + std::to_string(::getpid());
    std::ofstream(path) << "begun";
    FileWatch watch;
    ASSERT_TRUE(watch.add(path));
    const auto link_to = [&](const fs::path& to) {
        fs::remove(path);
        fs::create_symlink(to, path);
        const Result<void> checked = watch.check();
        return checked ? std::string() : checked.error().message;
    };
    EXPECT_THAT(link_to("/proc/self/status"), HasSubstr("was replaced while it was in use")) << "by one elsewhere";
    EXPECT_THAT(link_to(path), HasSubstr("cannot be checked: Too many levels of symbolic links"));
    fs::remove(path);
}

}  // namespace
}  // namespace motionrack::journal
