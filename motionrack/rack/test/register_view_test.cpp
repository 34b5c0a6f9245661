// Text views of a card's registers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/rack/databoard4002_card.hpp>
#include <motionrack/rack/mcx314_card.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/template.hpp>
#include <nlohmann/json.hpp>
#include <vector>

namespace motionrack::rack {
namespace {

using testing::HasSubstr;
using testing::Not;

/// An empty slot: each read returns FFFFh.
class Empty final : public RegisterPort {
  public:
    void write(std::uint32_t offset, std::uint16_t value) override { writes.emplace_back(offset, value); }
    std::uint16_t read(std::uint32_t offset) override { return reads.push_back(offset), 0xFFFF; }
    std::vector<std::pair<std::uint32_t, std::uint16_t>> writes;
    std::vector<std::uint32_t> reads;
};

/// Views of a virtual card that has executed a drive.
class RegisterViews : public testing::Test {
  protected:
    RegisterViews() : rack_(*read_rack_text(*rack_template("router")).config) {
        rack_.start();
        RegisterPort& port = *rack_.cards()[0]->port();
        command(port, mcx314::cmd::R, 800'000);
        command(port, mcx314::cmd::SV, 100);
        command(port, mcx314::cmd::V, 100);
        command(port, mcx314::cmd::P, 30);
        port.write(mcx314::reg::WR0, 0x010F);
        port.write(mcx314::reg::WR1, 0x8000);
        port.write(mcx314::reg::WR0, 0x0121);
        rack_.cards()[0]->host().pass(whole_seconds(1));
    }
    static void command(RegisterPort& port, unsigned code, std::uint32_t value) {
        port.write(mcx314::reg::WR7, static_cast<std::uint16_t>(value >> 16));
        port.write(mcx314::reg::WR6, static_cast<std::uint16_t>(value));
        port.write(mcx314::reg::WR0, static_cast<std::uint16_t>(0x0100 | code));
    }
    RegisterView view(bool clearing) {
        return *find_card_plugin("mcx314")->view(bus_of(*rack_.cards()[0], rack_.config().cards[0]), clearing);
    }

    Rack rack_;
};

TEST_F(RegisterViews, ShowCountersOfEachAxis) {
    const RegisterView seen = view(false);
    ASSERT_EQ(seen.values.size(), 16u);
    EXPECT_EQ(seen.values[0].name, "LP");
    EXPECT_EQ(seen.values[0].axis, "X");
    EXPECT_EQ(seen.values[0].value, -30);
    EXPECT_EQ(seen.values[4].axis, "Y");
    EXPECT_EQ(seen.values[4].value, 0);
    EXPECT_THAT(view_text(seen, false), HasSubstr("LP   X  -30 "));
}

TEST_F(RegisterViews, ReadClearingRegistersOnlyOnRequest) {
    EXPECT_THAT(view_text(view(false), true), Not(HasSubstr("RR3")));
    EXPECT_THAT(view_text(view(true), false), HasSubstr("DEND   1 "));
    EXPECT_THAT(view_text(view(true), false), Not(HasSubstr("DEND")));
    EXPECT_THAT(view_text(view(true), true), HasSubstr("DEND   0 "));
}

TEST_F(RegisterViews, AreAvailableAsJson) {
    const auto json = nlohmann::json::parse(view_json(view(true)));
    int with_end = 0;
    for (const auto& reg : json["registers"])
        if (reg["name"] == "RR3" && reg["axis"] == "X") with_end += reg["fields"]["DEND"].get<int>();
    EXPECT_EQ(with_end, 1);
    EXPECT_EQ(json["values"][0]["value"], -30);
}

TEST_F(RegisterViews, WriteNothingButNopsAndReadCommands) {
    Empty slot;
    ASSERT_TRUE(mcx314_plugin.view({.registers = &slot}, false));
    for (const auto& [offset, value] : slot.writes) {
        EXPECT_EQ(offset, mcx314::reg::WR0);
        const unsigned code = value & 0xFFu;
        EXPECT_TRUE(code == mcx314::cmd::NOP || (code >= mcx314::cmd::READ_LP && code <= mcx314::cmd::READ_CA)) << code;
    }
    EXPECT_THAT(slot.reads, Not(testing::Contains(mcx314::reg::RR3)));
}

TEST(DataBoardsView, ShowsItsStatusItsPositionAndItsRate) {
    Rack rack(*read_rack_text("[card.board]\ntype = \"databoard4002\"\ncard_number = 5\n").config);
    rack.start();
    Card& card = *rack.card("board");
    databoard4002::DriverSettings settings;
    settings.select = 5;
    databoard4002::Driver driver(*card.byte_port(), card.host(), settings);
    ASSERT_TRUE(driver.connect());
    ASSERT_TRUE(driver.set_rate(16'000));
    ASSERT_TRUE(driver.move_to(-30, whole_seconds(1)));
    card.host().pass(milliseconds(1));  // the card is still busy with the last command
    const Result<RegisterView> view = databoard4002_plugin.view({nullptr, card.byte_port(), &card.host(), 5}, false);
    ASSERT_TRUE(view) << view.error().message;
    EXPECT_THAT(view_text(*view, false), HasSubstr("STAT    80h  status\n          READY  1 "));
    EXPECT_THAT(view_text(*view, false), HasSubstr("POSITION    -30         counts\n"));
    const RegisterView waiting = databoard4002_plugin.view_while_waiting({nullptr, card.byte_port(), &card.host(), 5});
    EXPECT_THAT(view_text(waiting, false), HasSubstr("STAT    00h  status\n")) << "busy with the command of the view";
    EXPECT_TRUE(waiting.values.empty()) << "they are read by commands";
    const Result<RegisterView> absent = databoard4002_plugin.view({nullptr, card.byte_port(), &card.host(), 6}, false);
    ASSERT_FALSE(absent);
    EXPECT_THAT(absent.error().message, HasSubstr("No card answers under the number 6"));
}

}  // namespace
}  // namespace motionrack::rack
