// Guarantees of a journal: in order, on disk when acknowledged, complete after any end of the program.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <motionrack/journal/journal.hpp>
#include <random>
#include <tests/environment.hpp>
#include <thread>

#include "journal_file.hpp"

namespace motionrack::journal {
namespace {

namespace fs = std::filesystem;

TEST_F(JournalFile, KeepsEntriesInOrderAndGivesTheNewest) {
    auto journal = open();
    for (int i = 1; i <= 50; ++i)
        journal->write(Instant{i}, i % 2 == 0 ? "command" : "state", "entry " + std::to_string(i));
    EXPECT_EQ(write(*journal, "job", "the last"), 51);
    const auto newest = journal->read({0, "", 3});
    ASSERT_TRUE(newest);
    ASSERT_EQ(newest->size(), 3u);
    EXPECT_EQ((*newest)[0].text, "entry 49");
    EXPECT_EQ((*newest)[2].text, "the last");
    EXPECT_EQ((*newest)[2].at, Instant{7});
    EXPECT_EQ((*newest)[2].run, 1);
    EXPECT_EQ(journal->read({0, "command", 100})->size(), 25u);
    EXPECT_EQ(journal->read({48, "", 100})->front().number, 49);
    EXPECT_FALSE(journal->read({0, "", 0}));
    EXPECT_FALSE(journal->read({0, "", 10001}));
}

TEST_F(JournalFile, ReportsWhetherThePreviousRunEndedCleanly) {
    {
        auto journal = open();
        EXPECT_FALSE(journal->before());
        journal->keep("positions", "1");
        journal->keep("positions", "2");
        journal->keep("job", "part.ngc");
        ASSERT_TRUE(journal->close());
    }
    {
        auto journal = open();
        ASSERT_TRUE(journal->before());
        EXPECT_TRUE(journal->before()->clean);
        EXPECT_EQ(journal->before()->run, 1);
        EXPECT_EQ(journal->before()->kept,
                  (std::map<std::string, std::string>{{"positions", "2"}, {"job", "part.ngc"}}));
        EXPECT_EQ(journal->run(), 2);
        write(*journal, "state", "moving");
    }
    auto journal = open();
    EXPECT_FALSE(journal->before()->clean);
    EXPECT_GT(journal->before()->last_ms, 1'700'000'000'000);
    EXPECT_EQ(journal->read({})->front().run, 2);
}

TEST_F(JournalFile, BelongsToOneProgramAtATime) {
    auto journal = open();
    const auto second = Journal::open(path_);
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message.find("belongs to another program"), std::string::npos) << second.error().message;
    write(*journal, "state", "still mine");
}

TEST_F(JournalFile, BehindALinkIsLockedAndWatchedWhereItIs) {
    const std::string link = path_ + ".link";
    fs::remove(link);
    fs::create_symlink(fs::path(path_).filename(), link);
    for (const bool there : {false, true}) {
        SCOPED_TRACE(there);
        ASSERT_EQ(fs::exists(path_), there);
        const auto journal = Journal::open(link);
        ASSERT_TRUE(journal) << journal.error().message;
        write(**journal, "state", "moving");
        const auto second = Journal::open(path_);
        ASSERT_FALSE(second);
        EXPECT_NE(second.error().message.find("belongs to another program"), std::string::npos);
        EXPECT_FALSE(fs::exists(link + ".lock"));
        if (!there) continue;
        fs::remove(path_ + "-wal");
        while ((*journal)->failure().empty()) std::this_thread::yield();
        EXPECT_NE((*journal)->failure().find("was deleted"), std::string::npos) << (*journal)->failure();
    }
    fs::remove(link);
}

TEST_F(JournalFile, DoesNotChangeFilesThatAreNotAJournal) {
    std::ofstream(path_)
        << "these are my notes, not a database, and they are long enough to be seen as a damaged one................";
    const auto refused = Journal::open(path_);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("was not changed"), std::string::npos) << refused.error().message;
    std::ifstream file(path_);
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line.substr(0, 18), "these are my notes");
    fs::remove(path_);

    sqlite3* other = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
    sqlite3_exec(other, "CREATE TABLE customer (name TEXT)", nullptr, nullptr, nullptr);
    sqlite3_close(other);
    EXPECT_NE(Journal::open(path_).error().message.find("not a journal"), std::string::npos);
    EXPECT_NE(Journal::open("/proc/nowhere/journal.db").error().message.find("cannot be created"), std::string::npos);
}

TEST_F(JournalFile, IsReadableByItsOwnerOnly) {
    const auto rights = [this](const char* end) { return fs::status(path_ + end).permissions(); };
    const mode_t before = ::umask(0);
    auto journal = open();
    write(*journal, "state", "moving");
    for (const char* end : {"", "-wal", "-shm", ".lock"})
        EXPECT_EQ(rights(end), fs::perms::owner_read | fs::perms::owner_write) << end;
    journal.reset();
    fs::permissions(path_, fs::perms::others_read | fs::perms::group_read, fs::perm_options::add);
    open();
    EXPECT_EQ(rights(""), fs::perms::owner_read | fs::perms::owner_write) << "made by a version before this one";
    ::umask(before);
}

TEST_F(JournalFile, OfAnotherUserKeepsItsRights) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
    open();
    ASSERT_EQ(::chown(path_.c_str(), 65534, 65534), 0);
    ASSERT_EQ(::chmod(path_.c_str(), 0644), 0);
    open();
    EXPECT_EQ(fs::status(path_).permissions(),
              fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read | fs::perms::others_read);
}

/// SQLite accepts paths of 512 bytes at most.
TEST_F(JournalFile, WithAPathThatIsTooLongIsRefused) {
    const fs::path top = path_ + ".folder";
    const fs::path folder = top / std::string(250, 'a') / std::string(250, 'b');
    fs::create_directories(folder);
    const auto refused = Journal::open((folder / "journal.db").string());
    const std::string said = refused ? "opened" : refused.error().message;
    fs::remove_all(top);
    EXPECT_NE(said.find("cannot be opened: unable to open database file"), std::string::npos) << said;
}

TEST_F(JournalFile, IsAFile) {
    fs::create_directory(path_);
    EXPECT_NE(Journal::open(path_).error().message.find("Is a directory"), std::string::npos);
    fs::remove(path_);
    ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    EXPECT_NE(Journal::open(path_).error().message.find("is not a file"), std::string::npos);
}

TEST_F(JournalFile, RefusesAVersionThatItDoesNotKnow) {
    open()->close();
    sqlite3* file = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &file), SQLITE_OK);
    sqlite3_exec(file, "PRAGMA user_version = 9", nullptr, nullptr, nullptr);
    sqlite3_close(file);
    const auto refused = Journal::open(path_);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("version 9"), std::string::npos) << refused.error().message;
    change("PRAGMA user_version = 0");
    const auto before_all = Journal::open(path_);
    ASSERT_FALSE(before_all);
    EXPECT_NE(before_all.error().message.find("version 0"), std::string::npos) << before_all.error().message;
}

TEST_F(JournalFile, ReportsADiskThatRefusesIt) {
    auto journal = open();
    EXPECT_EQ(write(*journal, "state", "fits"), 1);
    sqlite3* other = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
    sqlite3_exec(other, "DROP TABLE entry", nullptr, nullptr, nullptr);
    sqlite3_close(other);
    EXPECT_EQ(write(*journal, "state", "does not"), -1);
    EXPECT_FALSE(journal->read({}));
}

TEST_F(JournalFile, AcceptsEntriesOfManyThreads) {
    auto journal = open();
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&journal, t] {
            for (int i = 0; i < 200; ++i) {
                if (i % 20 == 0)
                    EXPECT_GT(write(*journal, "command", std::to_string(t) + "/" + std::to_string(i)), 0);
                else
                    journal->write(Instant{i}, "command", std::to_string(t) + "/" + std::to_string(i));
                if (i % 10 == 0) {
                    EXPECT_TRUE(journal->read({0, "command", 5}));
                }
            }
        });
    for (std::thread& one : threads) one.join();
    write(*journal, "state", "end");
    EXPECT_EQ(journal->read({0, "command", 1000})->size(), 800u);
}

/// Writes at maximum rate and sends each number through the pipe once it is acknowledged.
[[noreturn]] void write_until_killed(const std::string& path, int pipe_in) {
    auto journal = Journal::open(path);
    if (!journal) ::_exit(1);
    for (int i = 0;; ++i) {
        (*journal)->write(Instant{i}, "command", "order " + std::to_string(i), {},
                          [pipe_in, i](const Result<std::int64_t>& number) {
                              if (!number) return;  // queue full: refused, not acknowledged
                              const std::int64_t reported[2] = {*number, i};
                              if (::write(pipe_in, reported, sizeof reported) != sizeof reported) ::_exit(2);
                          });
        (*journal)->keep("line", std::to_string(i));
        if (i % 16 == 15) std::this_thread::yield();
        if (i % 4096 == 4095) ::usleep(1000);  // allows the queue to empty
    }
}

TEST_F(JournalFile, LosesNothingThatWasAcknowledgedInAHundredKills) {
    const auto seed = static_cast<std::uint32_t>(seed_from_environment());
    SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed));
    std::mt19937 random(seed);
    std::vector<std::pair<std::int64_t, std::int64_t>> reported;
    for (int kill_count = 0; kill_count < 100; ++kill_count) {
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        const pid_t child = ::fork();
        if (child == 0) write_until_killed(path_, ends[1]);
        ::close(ends[1]);
        const auto wanted = std::uniform_int_distribution<int>(0, 400)(random);
        std::int64_t one[2];
        for (int i = 0; i < wanted && ::read(ends[0], one, sizeof one) == sizeof one; ++i)
            reported.emplace_back(one[0], one[1]);
        ::kill(child, SIGKILL);
        while (::read(ends[0], one, sizeof one) == sizeof one) reported.emplace_back(one[0], one[1]);
        ::close(ends[0]);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself with " << WEXITSTATUS(status);
    }
    auto journal = open();
    ASSERT_TRUE(journal->before());
    EXPECT_FALSE(journal->before()->clean);
    const std::map<std::int64_t, std::string> kept = all_entries();
    EXPECT_GT(reported.size(), 1000u);
    for (const auto& [number, order] : reported) {
        ASSERT_TRUE(kept.count(number) == 1) << "entry " << number << " was acknowledged";
        ASSERT_EQ(kept.at(number), "order " + std::to_string(order));
    }
}

}  // namespace
}  // namespace motionrack::journal
