// Live ports of the types of card: which have one, and the reasons of those that have none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/catalogue.hpp>
#include <regex>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack::rack {
namespace {

using testing::AllOf;
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

}  // namespace
}  // namespace motionrack::rack
