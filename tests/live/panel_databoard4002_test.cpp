// The operator panel with a real DataBoard 4002 in service; a virtual one is served by another process: live_server
// databoard4002 --real-time panel_databoard4002. Its motor follows the pulses, one count each.
#include <gmock/gmock.h>

#include <csignal>
#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/live/byte_card_port.hpp>
#include <string>
#include <tests/live/panel_on_a_card.hpp>

namespace motionrack {
namespace {

using live_test::PanelOnACard;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

constexpr int thousand_hz = 16'384 - 400;

class PanelOnADataBoard : public PanelOnACard {
  protected:
    PanelOnADataBoard() : PanelOnACard("databoard4002") {}
    /// Reads the rate of the card from the test's process; the program must not access the card meanwhile.
    int rate() const {
        const auto port =
            live::ByteCardPort::open(*live::read_port_spec(card.other_place()), databoard4002::card_map());
        EXPECT_TRUE(port);
        databoard4002::Driver driver(**port, **port);
        const Result<int> rate = driver.rate();
        EXPECT_TRUE(rate) << rate.error().message;
        return rate.value_or(-1);
    }
    void begin() const {
        EXPECT_TRUE(served->post("take_control").contains("done"));
        good("set_rate", {{"rate", thousand_hz}}, "Written.");
    }
    void drive() const {
        begin();
        good("set_target", {{"counts", 8'000'000}}, "Written.");
        good("go", json::object(), "Given.");
        good("rate", json::object(), std::to_string(thousand_hz) + " negative backwards, 0 at standstill");
    }
    /// Sends a move of 100 s without waiting for its end; served->answer() returns the answer.
    void begin_long_move() const {
        const json arguments = {{"counts", 100'000}, {"milliseconds", 60'000}};
        ASSERT_TRUE(served->send("POST", "call",
                                 json{{"card", "bench"}, {"function", "move_to"}, {"arguments", arguments}}.dump()));
    }
    static void until_it_waits(ServedLink& link) {
        until("it waits",
              [&] { return link.get("events?limit=20").dump().find("call move_to: begun") != std::string::npos; });
    }
    void expect_standing_after_another_service() const {
        begin();
        end_service();
        EXPECT_EQ(rate(), 0);
        EXPECT_FALSE(alarm(*served)["active"]);
    }
    void until_stopped(ServedLink& link) const {
        until_service_ended(link);
        EXPECT_EQ(rate(), 0);
    }
};

TEST_F(PanelOnADataBoard, CallsTheFunctionsOfItsLibrary) {
    EXPECT_THAT(served->said, HasSubstr("real     bench at " + card.place));
    begin();
    good("version", json::object(), "32 version of its program");
    good("move_to", {{"counts", 250}, {"milliseconds", 10'000}}, "The card is at 250 counts.");
    good("move_by", {{"counts", -290}, {"milliseconds", 10'000}}, "The card is at -40 counts.");
    good("position", json::object(), "-40 counts");
    EXPECT_THAT(call("status", json::object()).value("text", ""), HasSubstr("READY: the card takes an access"));
    const json shown = served->get("card?name=bench");
    EXPECT_EQ(shown["values"][0], (json{{"name", "POSITION"}, {"value", -40}})) << shown;
    EXPECT_EQ(shown["registers"][0]["name"], "STAT") << shown;
    EXPECT_THAT(call("move_to", {{"counts", 9'000'000}, {"milliseconds", 1000}})["error"]["message"].get<std::string>(),
                HasSubstr("counts is 9000000, but must be -8388608 to 8388607 counts"));
    end_service();
    EXPECT_TRUE(alarm(*served).is_null());
}

TEST_F(PanelOnADataBoard, ShowsItsStatusAnewWhileAFunctionWaits) {
    begin();
    begin_long_move();
    ServedLink other(served->port());
    until_it_waits(other);
    const json before = other.get("card?name=bench");
    const auto read_at = [](const json& shown) { return shown.value("at", 0.0); };
    json shown;
    until("STAT is read twice more", [&] {
        shown = other.get("card?name=bench");
        return read_at(shown) > read_at(before) + 0.9;
    });
    EXPECT_EQ(shown["registers"][0]["name"], "STAT") << shown;
    EXPECT_EQ(shown["values"], json::array())
        << "a command would disturb the function, and earlier values are not of now";
    EXPECT_TRUE(other.post("stop").contains("done"));
    EXPECT_THAT(served->answer()["error"]["message"].get<std::string>(), HasSubstr("Stopped on request"));
    until_stopped(other);
    EXPECT_TRUE(alarm(other).is_null());
}

TEST_F(PanelOnADataBoard, StopsDuringAMoveThatAFunctionWaitsFor) {
    begin();
    begin_long_move();
    ServedLink other(served->port());
    until_it_waits(other);
    EXPECT_TRUE(other.post("stop").contains("done"));
    EXPECT_THAT(served->answer()["error"]["message"].get<std::string>(), HasSubstr("Stopped on request"));
    until_stopped(other);
    EXPECT_EQ(other.status()["state"], "error stop");
    EXPECT_TRUE(alarm(other).is_null());
}

TEST_F(PanelOnADataBoard, StopsMotionAtTheEndOfTheServiceAndOfTheProgram) {
    drive();
    end_service();
    until_stopped(*served);
    drive();
    EXPECT_EQ(served->end(SIGTERM), 0);
    EXPECT_EQ(rate(), 0);
}

TEST_F(PanelOnADataBoard, AlarmsWhereItsPortVanishes) {
    drive();
    card.refuse(0xFFFF'FFFF);
    until("an alarm", [&] { return !alarm(*served).is_null(); });
    EXPECT_EQ(rate(), thousand_hz);
    EXPECT_THAT(alarm(*served)["text"].get<std::string>(),
                AllOf(HasSubstr("No such device"), HasSubstr("was not written"),
                      HasSubstr("press the emergency stop that cuts the motors' power")));
    card.refuse(0);
    expect_standing_after_another_service();
}

TEST_F(PanelOnADataBoard, AlarmsWhereItsSlotIsEmpty) {
    drive();
    card.remove(true);
    until("an alarm", [&] { return !alarm(*served).is_null(); });
    EXPECT_EQ(rate(), thousand_hz);
    EXPECT_THAT(alarm(*served)["text"].get<std::string>(), HasSubstr("No card answers under the number 13"));
    EXPECT_TRUE(alarm(*served)["active"]);
    card.remove(false);
    expect_standing_after_another_service();
}

TEST_F(PanelOnADataBoard, IsStoppedThroughAPortThatWasOpenedAgain) {
    drive();
    card.refuse(1);
    until("an alarm", [&] { return !alarm(*served).is_null(); });
    EXPECT_THAT(alarm(*served)["text"].get<std::string>(),
                AllOf(HasSubstr("No such device"), HasSubstr("was opened again"), HasSubstr("they stand")));
    EXPECT_EQ(rate(), 0);
}

}  // namespace
}  // namespace motionrack
