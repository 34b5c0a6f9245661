// Compares the map with the page that documents it.
#include <gtest/gtest.h>

#include <fstream>
#include <motionrack/base/describe.hpp>
#include <motionrack/cards/rtc5/map.hpp>
#include <sstream>
#include <tests/source_root.hpp>

namespace motionrack::rtc5 {
namespace {

TEST(Rtc5Map, TheReferencePageIsCurrent) {
    std::ifstream file(source_dir() + "/docs/reference/rtc5.md");
    std::stringstream stored;
    stored << file.rdbuf();
    EXPECT_EQ(stored.str(), describe_markdown(card_map()))
        << "make it anew: motionrack describe rtc5 --markdown > docs/reference/rtc5.md";
}

TEST(Rtc5Map, CommandsDeclareTheirParameters) {
    EXPECT_EQ(command_named(map::commands, "mark_abs").meaning, "(X, Y): straight, laser on, at the mark speed");
    EXPECT_EQ(command_named(map::commands, "list_nop").meaning, "one tick");
}

}  // namespace
}  // namespace motionrack::rtc5
