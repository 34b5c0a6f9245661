// Card types: their capabilities, the files that may name them, and their live ports or the reasons for having none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <motionrack/rack/catalogue.hpp>
#include <regex>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack::rack {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string without_a_live_port(std::string_view type) {
    const Result<const CardPlugin*> plugin = find_live_plugin(type);
    return plugin ? std::string() : plugin.error().message;
}

TEST(CardPlugins, HaveALivePortWithRegistersAndFunctionsOrAReasonForNone) {
    for (const CardPlugin* plugin : card_plugins()) {
        const bool has_port = plugin->no_live_port.empty();
        EXPECT_EQ(plugin->view != nullptr, has_port) << plugin->type.name;
        EXPECT_EQ(plugin->library != nullptr, has_port) << plugin->type.name;
        EXPECT_EQ(find_live_plugin(plugin->type.name).has_value(), has_port) << plugin->type.name;
    }
}

TEST(CardPlugins, WhoseRegistersAreNotTheirMakersHaveNoLivePort) {
    const auto others = HasSubstr("Nothing was opened. A real card is one of: mcx314, databoard4002.");
    EXPECT_THAT(without_a_live_port("ioflex02"),
                AllOf(StartsWith("An IOFLEX02 has no live port: its hardware manual is not at hand"), others));
    for (const char* card : {"grating_bus", "grating_decoder"})
        EXPECT_THAT(
            without_a_live_port(card),
            AllOf(StartsWith("A card of the grating bus has no live port: its source names no registers"), others));
    EXPECT_THAT(without_a_live_port("rtc5"),
                AllOf(StartsWith("An RTC5 has no live port: a real one is driven through its maker's DLL"), others));
    EXPECT_THAT(without_a_live_port("rtc6"), AllOf(StartsWith("Unknown card type 'rtc6'. "), others));
    EXPECT_EQ(without_a_live_port("mcx314"), "");
    EXPECT_EQ(without_a_live_port("databoard4002"), "");
}

TEST(CardPlugins, WithoutALivePortAreOnThePageOfLivePortsWithTheirReasons) {
    const std::string page =
        std::regex_replace(text_of(source_root / "docs/howto/live-port.md"), std::regex(R"(\s+)"), " ");
    for (const CardPlugin* plugin : card_plugins())
        EXPECT_THAT(page, HasSubstr(std::string(plugin->no_live_port))) << plugin->type.name;
}

TEST(CardPlugins, AreFoundByWhatTheyCanDo) {
    EXPECT_THAT(card_types_that(drives_stages), ElementsAre("grating_bus"));
    EXPECT_THAT(card_types_that(drives_scan_heads), ElementsAre("rtc5"));
    EXPECT_THAT(card_types_that(positions_by_itself), ElementsAre("databoard4002"));
    EXPECT_THAT(card_types_that(can_latch), ElementsAre("mcx314"));
    EXPECT_EQ(card_types_text(has_channels), "mcx314");
    EXPECT_EQ(card_types_text([](const CardType& type) { return type.position_loop || type.marks; }),
              "databoard4002 or rtc5");
    EXPECT_EQ(card_types_text([](const CardType&) { return false; }), "");
}

TEST(CardPlugins, AreNamedByTheCatalogueAndByTheirOwnFilesAlone) {
    // Files named after frames and stages belong to the grating bus.
    constexpr std::array<std::string_view, 8> own = {"mcx314_", "databoard4002_", "ioflex02_", "rtc5_",
                                                     "io8255_", "grating",        "frame_",    "stage."};
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(source_root / "motionrack/rack")) {
        const std::string file = entry.path().filename().string();
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
        if (file == "catalogue.cpp" ||
            std::any_of(own.begin(), own.end(), [&](std::string_view begin) { return file.rfind(begin, 0) == 0; }))
            continue;
        ++files;
        const std::string text = text_of(entry.path());
        for (const std::string_view type : card_type_names())
            EXPECT_EQ(text.find(type), std::string::npos) << file << " names " << type;
    }
    EXPECT_GT(files, 50);
}

}  // namespace
}  // namespace motionrack::rack
