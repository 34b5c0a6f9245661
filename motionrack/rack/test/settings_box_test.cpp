// The owner of a card's settings.
#include <gtest/gtest.h>

#include <motionrack/rack/settings_box.hpp>
#include <string>

namespace motionrack::rack {
namespace {

struct BoardSettings {
    int number = 7;
    std::string image;
};
struct LaserSettings {
    double power = 2.5;
};

TEST(SettingsBox, HasTheDefaultsUntilItsSettingsAreChanged) {
    SettingsBox box;
    EXPECT_EQ(box.get<BoardSettings>().number, 7);
    box.edit<BoardSettings>().number = 8;
    box.edit<BoardSettings>().image = "00FF";
    EXPECT_EQ(box.get<BoardSettings>().number, 8);
    EXPECT_EQ(box.get<BoardSettings>().image, "00FF");
}

TEST(SettingsBox, CopiesItsSettings) {
    SettingsBox box;
    box.edit<BoardSettings>().image = "a text that is longer than a string keeps in itself";
    SettingsBox copy = box;
    copy.edit<BoardSettings>().image = "another";
    EXPECT_EQ(box.get<BoardSettings>().image, "a text that is longer than a string keeps in itself");
    EXPECT_EQ(copy.get<BoardSettings>().image, "another");
}

TEST(SettingsBox, OwnsSettingsOfOneTypeAtATime) {
    SettingsBox box;
    box.edit<BoardSettings>().number = 8;
    EXPECT_EQ(box.get<LaserSettings>().power, 2.5);
    EXPECT_EQ(box.get<BoardSettings>().number, 8) << "to look for another type changes nothing";
    box.edit<LaserSettings>().power = 3;
    EXPECT_EQ(box.get<LaserSettings>().power, 3);
    EXPECT_EQ(box.get<BoardSettings>().number, 7);
}

}  // namespace
}  // namespace motionrack::rack
