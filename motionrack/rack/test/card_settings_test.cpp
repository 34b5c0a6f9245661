// Settings of a card in a rack file take effect in its chip.
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/template.hpp>
#include <string>

namespace motionrack::rack {
namespace {

class OneCard {
  public:
    explicit OneCard(const std::string& settings)
        : rack_(
              *read_rack_text("[card.c]\ntype = \"mcx314\"\n" + settings + "[axis.X]\ncard = \"c\"\nchannel = \"x\"\n")
                   .config) {
        rack_.start();
    }
    void command(unsigned code, std::uint32_t value = 0) {
        port().write(mcx314::reg::WR7, static_cast<std::uint16_t>(value >> 16));
        port().write(mcx314::reg::WR6, static_cast<std::uint16_t>(value));
        port().write(mcx314::reg::WR0, static_cast<std::uint16_t>(0x0100 | code));
    }
    void slow_drive() {
        command(mcx314::cmd::R, 800'000);
        command(mcx314::cmd::SV, 100);
        command(mcx314::cmd::V, 50);
        command(mcx314::cmd::CONTINUOUS_PLUS);
        port().pass(milliseconds(200));
    }
    sim::VirtualPort& port() { return *rack_.cards()[0]->port(); }
    std::int64_t inspect(const std::string& name) { return *rack_.cards()[0]->inspect(name); }
    std::size_t conditions() { return rack_.kernel().conditions().size(); }

  private:
    Rack rack_;
};

TEST(Mcx314CardSettings, TheVariantDecidesWhichCommandsExist) {
    OneCard original(""), as("variant = \"mcx314as\"\n");
    original.command(mcx314::cmd::EM, 0x0000'0010);
    as.command(mcx314::cmd::EM, 0x0000'0010);
    EXPECT_EQ(original.conditions(), 1u);
    EXPECT_EQ(original.inspect("x.EM6"), 0);
    EXPECT_EQ(as.conditions(), 0u);
    EXPECT_EQ(as.inspect("x.EM6"), 0x10);
}

TEST(Mcx314CardSettings, TheOtherReadingsOfTheSourcesCanBeChosen) {
    OneCard usual(""), other("low_speed_drive = \"at SV\"\nsoftware_limits = \"at\"\nao_after_reset = 300\n");
    EXPECT_EQ(usual.inspect("x.AO"), 8);
    EXPECT_EQ(other.inspect("x.AO"), 300);
    for (OneCard* card : {&usual, &other}) {
        card->command(mcx314::cmd::COMP_PLUS, 40);
        card->command(mcx314::cmd::NOP);
        card->port().write(mcx314::reg::WR2, 0x0001);  // + software limit
        card->slow_drive();
    }
    EXPECT_EQ(usual.inspect("x.LP"), 41);
    EXPECT_EQ(other.inspect("x.LP"), 40);
    for (OneCard* card : {&usual, &other}) {
        card->command(mcx314::cmd::COMP_PLUS, 1'000'000);
        card->slow_drive();
    }
    EXPECT_EQ(usual.inspect("x.CV"), 50);
    EXPECT_EQ(other.inspect("x.CV"), 100);
}

}  // namespace
}  // namespace motionrack::rack
