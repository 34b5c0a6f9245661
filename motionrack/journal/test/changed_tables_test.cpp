// Journals whose tables another program has changed: while they are open, and before they are opened.
#include <gmock/gmock.h>

#include "journal_file.hpp"

namespace motionrack::journal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string message_of(const Result<void>& result) {
    return result ? std::string() : result.error().message;
}

class ChangedTables : public JournalFile {
  protected:
    /// Returns the message of a refused journal; empty: it was opened.
    std::string refusal() const {
        const auto opened = Journal::open(path_);
        return opened ? std::string() : opened.error().message;
    }
};

TEST_F(ChangedTables, FailEveryEntryFromThenOn) {
    for (const std::string table : {"entry", "chain"}) {
        SCOPED_TRACE(table);
        remove();
        const auto journal = open();
        EXPECT_EQ(write(*journal, "state", "there"), 1);
        change(("DROP TABLE " + table).c_str());
        EXPECT_EQ(write(*journal, "state", "not there"), -1);
        EXPECT_THAT(journal->failure(), HasSubstr("could not be written: no such table: " + table));
        EXPECT_THAT(message_of(journal->close()), HasSubstr("The end of this run is not in it"));
    }
}

TEST_F(ChangedTables, FailAtAValueThatCannotBeKept) {
    const auto journal = open();
    change("DROP TABLE kept");
    journal->keep("machine", "X 1");
    write(*journal, "state", "after it");
    EXPECT_THAT(journal->failure(), HasSubstr("could not be written: no such table: kept"));
    EXPECT_FALSE(journal->close());
}

TEST_F(ChangedTables, CannotBeCheckedWithoutEntries) {
    const auto journal = open();
    change("DROP TABLE entry");
    const Result<ChainCheck> check = journal->check();
    ASSERT_FALSE(check);
    EXPECT_THAT(check.error().message, HasSubstr("The journal cannot be read: no such table: entry"));
}

TEST_F(ChangedTables, HaveNoEndOfTheirRun) {
    const auto journal = open();
    change("DROP TABLE run");
    EXPECT_THAT(message_of(journal->close()),
                AllOf(HasSubstr("could not be written: no such table: run"), HasSubstr("The end of this run")));
}

TEST_F(ChangedTables, ThatTakeNoRunAreRefused) {
    EXPECT_TRUE(open()->close());
    change("CREATE TRIGGER no BEFORE INSERT ON run BEGIN SELECT RAISE(ABORT, 'no more runs'); END");
    EXPECT_THAT(refusal(), AllOf(HasSubstr("cannot be written: no more runs"), HasSubstr("Free the disk")));
    change("DROP TRIGGER no");
    EXPECT_TRUE(open()->before()->clean) << "the refused start has left nothing";
}

TEST_F(ChangedTables, WithAnUnreadableDeclarationAreRefused) {
    EXPECT_TRUE(open()->close());
    change("PRAGMA writable_schema = ON; UPDATE sqlite_master SET sql = 'CREATE TABLE entry (' WHERE name = 'entry'");
    EXPECT_THAT(refusal(), HasSubstr("cannot be used as a journal: malformed database schema (entry)"));
}

/// The program was killed between the tables and its first run.
TEST_F(ChangedTables, WithoutAnyRunAreThoseOfANewJournal) {
    EXPECT_TRUE(open()->close());
    change("DELETE FROM run");
    const auto journal = open();
    ASSERT_TRUE(journal);
    EXPECT_FALSE(journal->before());
    EXPECT_EQ(journal->run(), 1);
    EXPECT_EQ(write(*journal, "state", "the first"), 1);
}

TEST_F(ChangedTables, OfVersion1AreUpgradedWithoutEntriesToo) {
    change(tables_of_version_1);
    const auto journal = open();
    ASSERT_TRUE(journal);
    EXPECT_EQ(journal->before()->damage, "");
    EXPECT_EQ(write(*journal, "job", "the first"), 1);
    EXPECT_EQ(journal->check()->problem, "");
}

TEST_F(ChangedTables, OfVersion1ThatCannotBeUpgradedAreRefusedAndLeftAsTheyAre) {
    const std::pair<const char*, const char*> changes[] = {
        {"ALTER TABLE run ADD COLUMN seal TEXT NOT NULL DEFAULT ''", "duplicate column name: seal"},
        {"ALTER TABLE entry DROP COLUMN data", "no such column: data. It was not changed"},
        {"CREATE TRIGGER no BEFORE UPDATE ON entry BEGIN SELECT RAISE(ABORT, 'as it is'); END", "as it is"},
    };
    for (const auto& [sql, reported] : changes) {
        SCOPED_TRACE(sql);
        remove();
        change(tables_of_version_1);
        change("INSERT INTO entry VALUES (1, 1, 11, 5, 'job', 'began', '{}')");
        change(sql);
        EXPECT_THAT(refusal(), AllOf(HasSubstr("cannot be used as a journal"), HasSubstr(reported)));
        EXPECT_THAT(refusal(), HasSubstr(reported)) << "nothing of the upgrade has remained";
        change("CREATE TABLE chain (name TEXT)");
    }
}

}  // namespace
}  // namespace motionrack::journal
