// Detection of damage and of manual changes in a journal.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <motionrack/journal/seal.hpp>

#include "journal_file.hpp"

namespace motionrack::journal {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DamagedJournal : public JournalFile {
  protected:
    /// Makes the journal of one run with three entries, the machine positions and a regular end.
    void make() {
        remove();
        auto journal = open();
        for (const char* text : {"one", "two", "three"}) write(*journal, "audit", text);
        journal->keep("machine", "X 12.5");
        ASSERT_TRUE(journal->close());
    }
    static std::string text_of(const std::string& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }
    /// Opens the journal in a next run and returns its finding about the last run.
    LastRun next() const {
        auto journal = open();
        return journal && journal->before() ? *journal->before() : LastRun{};
    }
};

TEST_F(DamagedJournal, WithoutDamageIsValid) {
    make();
    const LastRun last = next();
    EXPECT_TRUE(last.clean);
    EXPECT_THAT(last.doubts, IsEmpty());
    EXPECT_EQ(last.damage, "");
    EXPECT_EQ(last.kept.at("machine"), "X 12.5");
}

TEST_F(DamagedJournal, InvalidatesAValueWithAChangedDigit) {
    for (const char* change_it :
         {"UPDATE kept SET value = 'X 62.5'", "UPDATE kept SET run = 2", "UPDATE kept SET utc_ms = utc_ms + 1",
          "UPDATE kept SET key = 'machine ', seal = seal", "UPDATE kept SET seal = ''",
          "CREATE TABLE loose AS SELECT * FROM kept; DROP TABLE kept; ALTER TABLE loose RENAME TO kept; "
          "UPDATE kept SET value = NULL"}) {
        make();
        change(change_it);
        const LastRun last = next();
        EXPECT_THAT(last.doubts, Contains(HasSubstr("does not fit its checksum"))) << change_it;
        EXPECT_EQ(last.kept.count("machine"), 0u) << change_it;
    }
}

TEST_F(DamagedJournal, DoesNotMistakeTheEndOfAnEarlierRunForThatOfAKilledOneWithoutItsLog) {
    make();
    std::string killed;
    {
        const auto journal = open();
        write(*journal, "audit", "moved to X 50");
        killed = text_of(path_);
    }
    remove();
    std::ofstream(path_, std::ios::binary) << killed;
    EXPECT_FALSE(next().clean);
}

TEST_F(DamagedJournal, InvalidatesAChangedEndEntry) {
    make();
    change("UPDATE run SET ended_ms = ended_ms + 1");
    EXPECT_THAT(next().doubts, ElementsAre("the end of run 1 does not fit its checksum"));
    remove();
    write(*open(), "job", "cut off");
    change("UPDATE run SET ended_ms = 1");
    EXPECT_THAT(next().doubts, ElementsAre("the end of run 1 does not fit its checksum"))
        << "a run that was cut off does not become one that ended by itself";
}

TEST_F(DamagedJournal, InvalidatesAnOlderValueOfTheSameRun) {
    auto journal = open();
    journal->keep("machine", "X 12.5");
    write(*journal, "state", "stands");
    change("CREATE TABLE older AS SELECT * FROM kept");
    journal->keep("machine", "X 62.5");
    ASSERT_TRUE(journal->close());
    journal.reset();
    change("DELETE FROM kept; INSERT INTO kept SELECT * FROM older; DROP TABLE older");
    EXPECT_THAT(next().doubts, ElementsAre("the end of run 1 does not fit its checksum"));
}

TEST_F(DamagedJournal, DoesNotMistakeTheValuesOfAnEarlierRunForThoseOfTheLastOne) {
    make();
    ASSERT_TRUE(open()->close());
    EXPECT_THAT(next().doubts, ElementsAre("the stored value of 'machine' is of run 1, not of the last one, 2"));
}

TEST_F(DamagedJournal, DetectsChangedAndRemovedEntries) {
    const std::pair<const char*, const char*> changes[] = {
        {"UPDATE entry SET text = 'tow' WHERE number = 2", "entry 2 was changed"},
        {"UPDATE entry SET at = at + 1 WHERE number = 1", "entry 1 was changed"},
        {"UPDATE entry SET kind = 'order' WHERE number = 3", "entry 3 was changed"},
        {"UPDATE entry SET text = text || data, data = '' WHERE number = 3", "entry 3 was changed"},
        {"UPDATE entry SET text = 'tow' WHERE number > 1", "entry 2 was changed"},
        {"DELETE FROM entry WHERE number = 2", "entries 2 to 2 were removed"},
        {"DELETE FROM entry WHERE number = 1", "entries 1 to 1 were removed"},
        {"DELETE FROM entry WHERE number > 1", "entries 2 to 3 were removed"},
        {"DELETE FROM entry", "entries 1 to 3 were removed"},
        {"UPDATE chain SET link = 'abc' WHERE name = 'head'", "entry 3 is not the last written one"},
        {"DELETE FROM chain", "entry 3 is not the last written one"},
    };
    for (const auto& [sql, reported] : changes) {
        make();
        change(sql);
        EXPECT_THAT(next().damage, HasSubstr(reported)) << sql;
        EXPECT_THAT(next().damage, HasSubstr(reported)) << sql << ": it stays noticed";
        const auto journal = open();
        EXPECT_EQ(write(*journal, "job", "goes on"), 4) << sql << ": numbers are not used twice";
        const Result<ChainCheck> check = journal->check();
        ASSERT_TRUE(check);
        EXPECT_NE(check->problem, "") << sql;
    }
}

TEST_F(DamagedJournal, ChecksTheNewestEntriesAtTheStartAndAllOnRequest) {
    {
        const auto journal = open();
        for (std::int64_t i = 0; i < Journal::checked_at_start + 10; ++i) journal->write(Instant{i}, "command", "o");
        write(*journal, "command", "the last");
        ASSERT_TRUE(journal->close());
    }
    change("UPDATE entry SET text = 'p' WHERE number = 3");
    const auto journal = open();
    EXPECT_EQ(journal->before()->damage, "");
    EXPECT_THAT(journal->check()->problem, HasSubstr("entry 3 was changed"));
}

TEST_F(DamagedJournal, ChecksTheChainWhileItIsWritten) {
    const auto journal = open();
    for (int i = 1; i <= 200; ++i) {
        journal->write(Instant{i}, "audit", "entry");
        if (i % 20 != 0) continue;
        const Result<ChainCheck> check = journal->check();
        ASSERT_TRUE(check) << check.error().message;
        EXPECT_EQ(check->problem, "");
    }
    write(*journal, "audit", "the last");
    EXPECT_EQ(journal->check()->entries, 201);
}

TEST_F(DamagedJournal, IsRefusedWhereItsStructureIsBroken) {
    make();
    change("PRAGMA wal_checkpoint(TRUNCATE)");
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(0, std::ios::end);
    const std::streamoff pages = file.tellp() / 4096;
    ASSERT_GE(pages, 4);
    for (std::streamoff page = 1; page < pages; ++page) {
        file.seekp(page * 4096 + 3);
        file.write("\xff\xff\xff\xff", 4);
    }
    file.close();
    const auto refused = Journal::open(path_);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("Nothing was started. Keep the file"));
}

/// A disk that lost the last writes: the file starts as it was before it had tables.
TEST_F(DamagedJournal, IsRefusedWhereItsFirstPageIsThatOfANewFile) {
    make();
    change("PRAGMA wal_checkpoint(TRUNCATE)");
    const std::string whole = path_ + ".whole";
    std::filesystem::rename(path_, whole);
    change("PRAGMA journal_mode = WAL");
    std::string page(4096, '\0');
    ASSERT_TRUE(std::ifstream(path_, std::ios::binary).read(page.data(), 4096));
    std::filesystem::rename(whole, path_);
    std::fstream(path_, std::ios::in | std::ios::out | std::ios::binary).write(page.data(), 4096);
    const auto refused = Journal::open(path_);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                testing::AllOf(HasSubstr("bytes and no tables"), HasSubstr("Nothing was started. Keep the file")));
}

TEST_F(DamagedJournal, IsRejectedIfItsNumbersAreOutOfRange) {
    for (const char* sql :
         {"UPDATE entry SET number = 9223372036854775807 WHERE number = 3",
          "UPDATE entry SET number = -5 WHERE number = 1", "UPDATE run SET number = 9223372036854775807",
          "UPDATE run SET number = -1", "UPDATE chain SET number = 1000000000000001",
          "UPDATE sqlite_sequence SET seq = 9223372036854775807"}) {
        make();
        change(sql);
        const auto refused = Journal::open(path_);
        ASSERT_FALSE(refused) << sql;
        EXPECT_THAT(refused.error().message,
                    testing::AllOf(HasSubstr("outside 0 to"), HasSubstr("Nothing was started")));
    }
}

TEST_F(DamagedJournal, IsRejectedIfItsValuesBelongToNoRun) {
    make();
    change("DELETE FROM run");
    const auto refused = Journal::open(path_);
    ASSERT_FALSE(refused) << "it would be taken for a journal that begins";
    EXPECT_THAT(refused.error().message, testing::AllOf(HasSubstr("entries without their runs"),
                                                        HasSubstr("Nothing was started. Keep the file")));
}

/// As left by a killed program: the last writes are in the log beside the file.
TEST_F(DamagedJournal, IsNotChangedWithItsLogIfRejected) {
    for (const char* mode : {"PRAGMA journal_mode = WAL", "PRAGMA journal_mode = DELETE"}) {
        make();
        sqlite3* other = nullptr;
        ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
        sqlite3_db_config(other, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
        EXPECT_EQ(sqlite3_exec(other, mode, nullptr, nullptr, nullptr), SQLITE_OK);
        EXPECT_EQ(sqlite3_exec(other, "PRAGMA user_version = 9", nullptr, nullptr, nullptr), SQLITE_OK);
        sqlite3_close(other);
        const std::string file = text_of(path_), log = text_of(path_ + "-wal");
        const auto refused = Journal::open(path_);
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message, HasSubstr("has version 9; this program knows versions up to 2"));
        EXPECT_EQ(text_of(path_), file) << mode;
        EXPECT_EQ(text_of(path_ + "-wal"), log) << mode;
    }
}

TEST_F(DamagedJournal, OfVersion1IsUpgradedAndInvalidOnce) {
    change(tables_of_version_1);
    change(R"(
        INSERT INTO entry VALUES (7, 1, 11, 5, 'job', 'began', '{}'), (8, 1, 12, 6, 'job', 'ended', '{}');
        INSERT INTO kept VALUES ('machine', 'X 3', 1, 13);)");
    {
        auto journal = open();
        ASSERT_TRUE(journal->before());
        EXPECT_EQ(journal->before()->doubts.size(), 2u);
        EXPECT_EQ(journal->before()->damage, "");
        EXPECT_EQ(journal->read({})->size(), 2u);
        EXPECT_EQ(write(*journal, "job", "goes on"), 9);
        EXPECT_EQ(journal->check()->problem, "");
        journal->keep("machine", "X 4");
        ASSERT_TRUE(journal->close());
    }
    EXPECT_THAT(next().doubts, IsEmpty());
    change("UPDATE entry SET text = 'begun' WHERE number = 7");
    EXPECT_THAT(next().damage, HasSubstr("entry 7 was changed"));
}

TEST(Seal, DependsOnTheBoundariesOfFields) {
    EXPECT_NE(Seal().add("ab").add("c").text(), Seal().add("a").add("bc").text());
    EXPECT_NE(Seal().add("").add("a").text(), Seal().add("a").add("").text());
    EXPECT_EQ(Seal().add(std::int64_t{12}).text(), Seal().add("12").text());
}

}  // namespace
}  // namespace motionrack::journal
