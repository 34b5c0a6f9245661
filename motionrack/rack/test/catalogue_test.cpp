// Live ports of the card kinds: which have one, and the reasons of those that have none.
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
    const Result<const CardKind*> kind = find_live_kind(type);
    return kind ? std::string() : kind.error().message;
}

TEST(CardKinds, HaveALivePortWithRegistersAndFunctionsOrAReasonForNone) {
    for (const CardKind& kind : card_kinds()) {
        const bool has_port = kind.no_live_port.empty();
        EXPECT_EQ(kind.view != nullptr, has_port) << kind.type;
        EXPECT_EQ(kind.library != nullptr, has_port) << kind.type;
        EXPECT_EQ(find_live_kind(kind.type).has_value(), has_port) << kind.type;
    }
}

TEST(CardKinds, WhoseRegistersAreNotTheirMakersHaveNoLivePort) {
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

TEST(CardKinds, WithoutALivePortAreOnThePageOfLivePortsWithTheirReasons) {
    const std::string page =
        std::regex_replace(text_of(source_root / "docs/howto/live-port.md"), std::regex(R"(\s+)"), " ");
    for (const CardKind& kind : card_kinds()) EXPECT_THAT(page, HasSubstr(std::string(kind.no_live_port))) << kind.type;
}

}  // namespace
}  // namespace motionrack::rack
