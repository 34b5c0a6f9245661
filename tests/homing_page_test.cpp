// The page on homing: its programs run here, its picture and its table of states are what the program makes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <motionrack/cards/mcx314/driver/manual.hpp>
#include <motionrack/cards/mcx314/test/home_rig.hpp>
#include <motionrack/rack/homing.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack {
namespace {

namespace fs = std::filesystem;
std::string page() {
    return text_of(source_root / "docs/howto/homing.md");
}

/// Homes X with type 4 and tells what was found.
Result<std::string> one_axis(mcx314::Driver& card) {
    mcx314::HomeSettings s;
    s.type = 4;                        // the switch, again slowly, then the index
    s.range = 800'000;                 // speeds in units of 10 pulses/s
    s.sv = 50, s.v = 1000, s.a = 100;  // 500 to 10,000 pulses/s
    s.travel = 200'000;                // pulses: the longest search
    s.turn = 3200;                     // pulses of a motor turn: the index comes within one
    MOTIONRACK_TRY(const mcx314::HomeReport report, mcx314::home(card, 0, s));
    return fmt::format("{} pulses from the switch to the index; {}", *report.switch_to_index(), report.sentence);
}

/// Homes X and Y at once, from a loop of one's own.
Result<void> two_axes(mcx314::Driver& card, const mcx314::HomeSettings& s) {
    Interrupt& host = card.interrupt();
    mcx314::Home x(card, 0), y(card, 1);
    MOTIONRACK_CHECK(x.start(s, host.now()));
    MOTIONRACK_CHECK(y.start(s, host.now()));
    while (x.running() || y.running()) {
        x.step(host.now());  // polls once, never waits; the polling rate does not change the end
        y.step(host.now());
        host.pass(milliseconds(1));
    }
    MOTIONRACK_CHECK(x.report().result());
    return y.report().result();
}

/// Jogs X for as long as `pressed` says so.
Result<void> jog(mcx314::Driver& card, const std::function<bool()>& pressed) {
    Interrupt& host = card.interrupt();
    mcx314::Manual panel(card, 0);
    do {
        if (pressed()) MOTIONRACK_CHECK(panel.jog(+300, host.now()));  // renewed, and at another speed if it is another
        panel.step(host.now());
        host.pass(milliseconds(10));
    } while (panel.state() != mcx314::ManualState::standing);
    return {};
}

TEST(HomingPage, ItsProgramsRun) {
    mcx314::HomeRig rig({mcx314::RigAxis{}, mcx314::RigAxis{.start_mm = 55}});
    rig.start();
    const Result<std::string> told = one_axis(rig.driver);
    ASSERT_TRUE(told) << told.error().message;
    EXPECT_NE(page().find("    " + *told + "\n"), std::string::npos) << *told;
    EXPECT_TRUE(two_axes(rig.driver, mcx314::rig_settings(2)));
    EXPECT_DOUBLE_EQ(rig.position(0), 1.0);
    EXPECT_DOUBLE_EQ(rig.position(1), 1.0);
    int looks = 0;
    EXPECT_TRUE(jog(rig.driver, [&] { return ++looks < 30; }));
    EXPECT_GT(rig.position(0), 2);
}

TEST(HomingPage, ShowsTheseProgramsAndNoOthers) {
    const std::string own = text_of(source_root / "tests/homing_page_test.cpp");
    int blocks = 0;
    const std::string text = page();
    for (std::size_t at = text.find("```cpp\n"); at != std::string::npos;
         at = text.find("```cpp\n", at + 7), ++blocks) {
        std::istringstream code(text.substr(at + 7, text.find("```", at + 7) - at - 7));
        for (std::string line; std::getline(code, line);) {
            if (!line.empty()) {
                EXPECT_NE(own.find("    " + line + "\n"), std::string::npos) << line;
            }
        }
    }
    EXPECT_EQ(blocks, 3);
}

TEST(HomingPage, NamesEveryStateWithItsMeaning) {
    for (int type = 1; type <= 4; ++type)
        for (const mcx314::HomeState& state : mcx314::home_table(type).states)
            EXPECT_NE(page().find(fmt::format("| `{}` | {} |", state.name, state.meaning)), std::string::npos)
                << fmt::format("| `{}` | {} |", state.name, state.meaning);
}

TEST(HomingPage, ItsPictureIsThatOfTheExample) {
    rack::Rack rack(*rack::read_rack_file(source_root / "examples/08_homing/machine.toml").config);
    rack.start();
    rack::HomingSettings settings;
    settings.axes = "X";
    const rack::HomingOutcome outcome = rack::home_axes(rack, settings);
    ASSERT_TRUE(outcome.ended);
    EXPECT_EQ(text_of(source_root / "docs/pictures/homing.svg"), rack::homing_picture(outcome.axes[0]))
        << "make it anew: motionrack home X --rack examples/08_homing/machine.toml --picture docs/pictures/homing.svg";
    EXPECT_NE(page().find("../pictures/homing.svg"), std::string::npos);
}

TEST(HomingPage, WhatItSaysTheCommandPrintsIsPrinted) {
    const std::string printed = text_of(source_root / "examples/08_homing/expected.txt"), text = page();
    const std::size_t at = text.find("    axis X  type 4");
    ASSERT_NE(at, std::string::npos);
    std::istringstream shown(text.substr(at, text.find("\n\n[", at) - at));
    for (std::string line; std::getline(shown, line) && (line.empty() || line.rfind("    ", 0) == 0);) {
        if (!line.empty()) {
            EXPECT_NE(printed.find(line.substr(4) + "\n"), std::string::npos) << line;
        }
    }
}

}  // namespace
}  // namespace motionrack
