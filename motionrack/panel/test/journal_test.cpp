// Orders and the journal; what the machine's parts report.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "asked.hpp"

namespace motionrack::panel {
namespace {

using testing::HasSubstr;

/// A folder that goes with the test.
struct Folder {
    Folder() : path(std::filesystem::temp_directory_path() / ("motionrack-panel-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
};

TEST(AnOrder, IsAnsweredWhenTheJournalHasIt) {
    const Folder folder;
    auto opened = journal::Journal::open((folder.path / "rack.journal").string());
    ASSERT_TRUE(opened) << opened.error().message;
    journal::Journal& book = **opened;
    PanelSettings settings;
    settings.journal = &book;
    Asked a(two_axes(), std::move(settings));
    bool seen = false;
    a.good(0.1, "take_control");
    a.at(0.2, anna, "enable", {{"on", true}}, [&](const Answer& answer) {
        EXPECT_EQ(answer.status, 200);
        const auto entries = book.read({0, "order", 10});
        ASSERT_TRUE(entries);
        for (const journal::Entry& entry : *entries) seen = seen || entry.text == "anna: enable on=true";
    });
    a.good(0.3, "line", {{"text", "G1 X12 F600"}});
    a.good(1.9, "set_single_step", {{"on", true}});  // answered when it and all before it are on the disk
    a.at(2, eve, "journal", {{"limit", 100}}, [](const Answer& answer) {
        std::string kinds;
        for (const json& entry : answer.body["journal"]) kinds += entry["kind"].get<std::string>() + " ";
        EXPECT_THAT(kinds, HasSubstr("order"));
        EXPECT_THAT(kinds, HasSubstr("state"));
        EXPECT_THAT(kinds, HasSubstr("position"));
    });
    a.run(2.5);
    EXPECT_TRUE(seen);
}

TEST(AnEvent, TellsWhatThePartsOfTheMachineReport) {
    Asked a(two_axes());
    std::vector<std::string> told;
    a.panel->on_event([&](const Event& event) {
        if (event.kind == "condition") told.push_back(event.text);
    });
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "line", {{"text", "G1 X50 F3000"}});
    a.good(0.5, "inject_fault", {{"target", "X"}, {"fault", "motor.lose_steps=640"}});
    a.run(4);
    EXPECT_FALSE(told.empty());
}

}  // namespace
}  // namespace motionrack::panel
