// Commands and the journal; conditions reported by the machine's parts.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "asked.hpp"

namespace motionrack::panel {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A folder that is removed with the test.
struct Folder {
    Folder() : path(std::filesystem::temp_directory_path() / ("motionrack-panel-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
};

TEST(CommandAnswer, IsAnsweredOnceTheJournalHasIt) {
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
        const auto entries = book.read({0, "command", 10});
        ASSERT_TRUE(entries);
        for (const journal::Entry& entry : *entries) seen = seen || entry.text == "anna: enable on=true";
    });
    a.good(0.3, "mdi", {{"text", "G1 X12 F600"}});
    a.good(1.9, "set_single_block", {{"on", true}});  // answered when it and all earlier entries are on the disk
    a.at(2, eve, "journal", {{"limit", 100}}, [](const Answer& answer) {
        std::string kinds;
        for (const json& entry : answer.body["journal"]) kinds += entry["kind"].get<std::string>() + " ";
        EXPECT_THAT(kinds, HasSubstr("command"));
        EXPECT_THAT(kinds, HasSubstr("state"));
        EXPECT_THAT(kinds, HasSubstr("position"));
    });
    a.at(2, eve, "journal_check", json::object(), [](const Answer& answer) {
        EXPECT_TRUE(answer.body["whole"].get<bool>()) << answer.body;
        EXPECT_GT(answer.body["entries"].get<int>(), 5);
    });
    a.run(2.5);
    EXPECT_TRUE(seen);
}

/// Returns the journal's active alarm text in the machine's status; empty: none.
std::string alarm_of(const Asked& a) {
    std::string out;
    for (const operate::Alarm& alarm : a.machine->status().alarms)
        if (alarm.active && alarm.source == "journal") out += alarm.text;
    return out;
}

TEST(JournalThatFails, HoldsTheMachineAndPreventsEveryStart) {
    const Folder folder;
    auto opened = journal::Journal::open((folder.path / "rack.journal").string());
    ASSERT_TRUE(opened) << opened.error().message;
    PanelSettings settings;
    settings.journal = opened->get();
    Asked a(two_axes(), std::move(settings));
    const auto refused = [](const Answer& answer) {
        EXPECT_EQ(answer.status, 409) << answer.body;
        EXPECT_THAT(answer.body.dump(), HasSubstr("was deleted while it was in use. The machine holds"));
    };
    const auto taken = [](const Answer& answer) {
        EXPECT_EQ(answer.status, 200) << answer.body;
        EXPECT_THAT(answer.body.value("unrecorded", ""), HasSubstr("was deleted"));
    };
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "start_program", {{"name", "part.ngc"}, {"text", "G1 X200 F600\nX0\nM30\n"}});
    a.at(1.0, [&] { std::filesystem::remove(folder.path / "rack.journal"); });
    a.at(1.1, anna, "set_overrides", {{"feed", 0.5}}, [](const Answer& answer) {
        // On a busy computer the journal's supervision may have detected it before.
        const bool noticed = answer.status == 409;
        EXPECT_TRUE(noticed || answer.status == 500) << answer.status;
        EXPECT_THAT(answer.body.dump(), HasSubstr(noticed ? "was deleted while it was in use. The machine holds"
                                                          : "'set_overrides' is not recorded. The machine holds"));
        EXPECT_THAT(answer.body.dump(), Not(HasSubstr("was executed")));
    });
    double held = 0;
    a.at(2.0, [&] {
        EXPECT_EQ(a.machine->state(), operate::MachineState::hold);
        EXPECT_THAT(alarm_of(a), HasSubstr("was deleted"));
        held = a.x();
        EXPECT_LT(held, 40);
    });
    a.at(2.1, anna, "resume", json::object(), refused);
    a.at(2.2, anna, "set_clock", {{"mode", "unthrottled"}}, refused);
    a.at(3.0, anna, "stop", json::object(), taken);
    a.at(3.5, anna, "reset", json::object(), taken);
    a.at(3.6, anna, "start_program", {{"name", "again.ngc"}, {"text", "G1 X0 F600\nM30\n"}}, refused);
    a.at(3.7, anna, "mdi", {{"text", "G0 X0"}}, refused);
    a.at(3.8, anna, "home", json::object(), refused);
    a.at(3.9, [&] { EXPECT_EQ(a.x(), held); });
    a.at(4.0, anna, "jog_by", {{"axis", "X"}, {"distance", 1}, {"speed", 10}}, taken);
    a.at(5.0, [&] { EXPECT_NEAR(a.x(), held + 1, 0.01) << "out of the way by hand"; });
    a.run(5.1);
    EXPECT_NE(alarm_of(a), "") << "no reset ends it";
    EXPECT_FALSE((*opened)->close());
}

TEST(Event, CarriesTheReportsOfThePartsOfTheMachine) {
    Asked a(two_axes());
    std::vector<std::string> reported;
    a.panel->on_event([&](const Event& event) {
        if (event.kind == "condition") reported.push_back(event.text);
    });
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "mdi", {{"text", "G1 X50 F3000"}});
    a.good(0.5, "inject_fault", {{"target", "X"}, {"fault", "motor.lose_steps=640"}});
    a.run(4);
    EXPECT_FALSE(reported.empty());
}

}  // namespace
}  // namespace motionrack::panel
