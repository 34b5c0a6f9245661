// Quota of a journal.
#include <gmock/gmock.h>

#include <filesystem>
#include <mutex>

#include "journal_file.hpp"

namespace motionrack::journal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(JournalFile, WarnsBeforeItsQuotaAndKeepsTheNewestEntriesWithinIt) {
    std::vector<std::string> reported;
    std::mutex lock;
    JournalSettings settings;
    settings.max_bytes = 400'000;
    settings.on_quota = [&](const std::string& sentence) {
        const std::lock_guard<std::mutex> alone(lock);
        reported.push_back(sentence);
    };
    auto journal = *Journal::open(path_, settings);
    const auto count = [&] {
        const std::lock_guard<std::mutex> alone(lock);
        return reported.size();
    };
    const std::string text(200, 'x');
    std::int64_t last = 0;
    for (int i = 0; i < 4000; ++i) {
        if (i % 50 != 49)
            journal->write(Instant{i}, "audit", text);
        else
            last = write(*journal, "audit", text);
        if (count() == 0) {
            EXPECT_LT(std::filesystem::file_size(path_), 400'000u);
        }
    }
    ASSERT_GT(count(), 2u);
    EXPECT_THAT(reported[0], AllOf(HasSubstr("% of its quota of 0.4 MB"), HasSubstr("copy the file first")));
    EXPECT_THAT(reported[1], HasSubstr("has reached its quota of 0.4 MB: entries before number"));
    const auto entries = journal->read({0, "", 10000});
    EXPECT_LT(entries->size(), 2000u);
    EXPECT_GT(entries->size(), 500u);
    EXPECT_GE(entries->back().number, last);
    EXPECT_EQ(journal->check()->problem, "");
    EXPECT_FALSE(journal->read({0, "journal", 10})->empty());
    ASSERT_TRUE(journal->close());
    EXPECT_LT(std::filesystem::file_size(path_), 480'000u);
    journal.reset();
    journal = open();
    EXPECT_TRUE(journal->before()->clean);
    EXPECT_EQ(journal->before()->damage, "");
}

TEST_F(JournalFile, KeepsItsHundredNewestEntriesBeyondItsQuota) {
    JournalSettings settings;
    settings.max_bytes = 200'000;
    const auto journal = *Journal::open(path_, settings);
    for (int i = 0; i < 90; ++i) EXPECT_GT(write(*journal, "audit", std::string(4'000, 'x')), i);
    EXPECT_EQ(journal->read({0, "audit", 1000})->size(), 90u);
    const auto reported = journal->read({0, "journal", 1000});
    ASSERT_EQ(reported->size(), 1u) << "with nobody to call, the warning is in the journal";
    EXPECT_THAT(reported->front().text, HasSubstr("of its quota of 0.2 MB"));
}

/// Each note is an entry, too: one after each removal would replace the other entries.
TEST_F(JournalFile, WritesOnceThatItsHundredNewestEntriesExceedItsQuota) {
    std::vector<std::string> reported;  // each before write() returns
    JournalSettings settings;
    settings.max_bytes = 200'000;
    settings.on_quota = [&](const std::string& sentence) { reported.push_back(sentence); };
    const auto journal = *Journal::open(path_, settings);
    for (int i = 0; i < 150; ++i) EXPECT_GT(write(*journal, "audit", std::string(4'000, 'x')), i);
    const auto entries = journal->read({0, "", 1000});
    EXPECT_EQ(entries->size(), 100u);
    EXPECT_EQ(entries->back().text, std::string(4'000, 'x'));
    const auto notes = journal->read({0, "journal", 1000});
    ASSERT_EQ(notes->size(), 1u) << "of the first removal";
    EXPECT_THAT(notes->front().text, HasSubstr("The newest 100 alone exceed it: from now on each new entry replaces"));
    EXPECT_EQ(reported.size(), 2u) << "the warning, and the note";
    EXPECT_EQ(journal->check()->problem, "");
}

TEST_F(JournalFile, RemovesAsManyEntriesAtOnceAsItsQuotaNeeds) {
    {
        const auto journal = open();
        for (int i = 0; i < 400; ++i) write(*journal, "audit", std::string(4'000, 'x'));
        EXPECT_TRUE(journal->close());
    }
    std::vector<std::string> reported;
    JournalSettings settings;
    settings.max_bytes = 1'000'000;
    settings.on_quota = [&](const std::string& sentence) { reported.push_back(sentence); };
    const auto journal = *Journal::open(path_, settings);
    write(*journal, "audit", "short");
    write(*journal, "audit", "short");  // the note of the removal is stored before it
    ASSERT_EQ(reported.size(), 2u);
    EXPECT_THAT(reported[0], AllOf(HasSubstr("has reached its quota"), testing::Not(HasSubstr("exceed it"))));
    EXPECT_THAT(reported[1], HasSubstr("% of its quota")) << "it is nearly full";
    const auto entries = journal->read({0, "audit", 1000});
    EXPECT_LT(entries->size(), 250u);
    EXPECT_GT(entries->size(), 150u);
}

TEST_F(JournalFile, RemovesATenthOfItsEntriesAtItsQuota) {
    std::vector<std::string> reported;  // each before write() returns
    JournalSettings settings;
    settings.max_bytes = 400'000;
    settings.on_quota = [&](const std::string& sentence) { reported.push_back(sentence); };
    const auto journal = *Journal::open(path_, settings);
    std::int64_t last = 0;
    while (reported.size() < 2) last = write(*journal, "audit", std::string(1'500, 'x'));
    EXPECT_GT(last, 120);
    EXPECT_THAT(reported[1], HasSubstr("entries before number " + std::to_string(last / 10 + 2) + " were removed"));
    EXPECT_EQ(journal->read({0, "audit", 1000})->front().number, last / 10 + 2);
}

TEST_F(JournalFile, ReportsThatItCannotBeKeptWithinItsQuota) {
    JournalSettings settings;
    settings.max_bytes = 200'000;
    const auto journal = *Journal::open(path_, settings);
    change("CREATE TRIGGER no BEFORE DELETE ON entry BEGIN SELECT RAISE(ABORT, 'they stay'); END");
    for (int i = 0; i < 110; ++i) write(*journal, "audit", std::string(2'000, 'x'));
    EXPECT_THAT(journal->failure(), HasSubstr("could not be kept within its quota: they stay"));
    EXPECT_EQ(journal->read({0, "audit", 1000})->size(), 110u);
    EXPECT_EQ(journal->check()->problem, "") << "its chain begins where it began";
    EXPECT_FALSE(journal->close());
}

}  // namespace
}  // namespace motionrack::journal
