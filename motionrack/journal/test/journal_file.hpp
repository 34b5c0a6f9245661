// A journal in a separate file, and direct changes of that file.
#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <motionrack/journal/journal.hpp>
#include <string>

namespace motionrack::journal {

/// Tables of version 1 with one run that ended, without entries and values.
inline const char* const tables_of_version_1 = R"(
    CREATE TABLE run (number INTEGER PRIMARY KEY, begun_ms INTEGER NOT NULL, ended_ms INTEGER);
    CREATE TABLE entry (number INTEGER PRIMARY KEY AUTOINCREMENT, run INTEGER NOT NULL, utc_ms INTEGER NOT NULL,
                        at INTEGER NOT NULL, kind TEXT NOT NULL, text TEXT NOT NULL, data TEXT NOT NULL);
    CREATE INDEX entry_kind ON entry (kind, number);
    CREATE TABLE kept (key TEXT PRIMARY KEY, value TEXT NOT NULL, run INTEGER NOT NULL,
                       utc_ms INTEGER NOT NULL) WITHOUT ROWID;
    INSERT INTO run VALUES (1, 10, 20);
    PRAGMA application_id = 1296716366; PRAGMA user_version = 1;)";

class JournalFile : public testing::Test {
  protected:
    JournalFile()
        : path_((std::filesystem::path(testing::TempDir()) / ("journal_" + std::to_string(::getpid()) + ".db"))
                    .string()) {
        remove();
    }
    ~JournalFile() override { remove(); }
    void remove() const {
        for (const char* end : {"", "-journal", "-wal", "-shm", ".lock"}) std::filesystem::remove(path_ + end);
    }
    std::unique_ptr<Journal> open() const {
        Result<std::unique_ptr<Journal>> journal = Journal::open(path_);
        EXPECT_TRUE(journal) << journal.error().message;
        return journal ? std::move(*journal) : nullptr;
    }
    /// Writes an entry, waits until it is on the disk and returns its number; -1: refused.
    static std::int64_t write(Journal& journal, std::string kind, std::string text) {
        std::promise<std::int64_t> number;
        journal.write(Instant{7}, std::move(kind), std::move(text), "{}",
                      [&](const Result<std::int64_t>& done) { number.set_value(done ? *done : -1); });
        return number.get_future().get();
    }

    /// Changes the file as another program would.
    void change(const char* sql) const {
        sqlite3* file = nullptr;
        ASSERT_EQ(sqlite3_open(path_.c_str(), &file), SQLITE_OK);
        EXPECT_EQ(sqlite3_exec(file, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(file);
        sqlite3_close(file);
    }
    /// Reads the file as another program does.
    std::map<std::int64_t, std::string> all_entries() const {
        std::map<std::int64_t, std::string> out;
        sqlite3* file = nullptr;
        EXPECT_EQ(sqlite3_open(path_.c_str(), &file), SQLITE_OK);
        const auto take = [](void* into, int, char** values, char**) {
            (*static_cast<std::map<std::int64_t, std::string>*>(into))[std::stoll(values[0])] = values[1];
            return 0;
        };
        EXPECT_EQ(sqlite3_exec(file, "SELECT number, text FROM entry", take, &out, nullptr), SQLITE_OK);
        sqlite3_close(file);
        return out;
    }

    std::string path_;
};

}  // namespace motionrack::journal
