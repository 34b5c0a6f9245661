// The operator panel with a real MCX314 in service: `motionrack serve --live`, with a virtual one in place of the real
// one, served by another process: live_server port --real-time panel_live.
#include <gmock/gmock.h>

#include <string>
#include <tests/live/panel_on_a_card.hpp>
#include <utility>
#include <vector>

namespace motionrack {
namespace {

using live_test::PanelOnACard;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// Bit of RR0.
constexpr unsigned x_drives = 1;

class PanelOnARealCard : public PanelOnACard {
  protected:
    PanelOnARealCard() : PanelOnACard("mcx314") {}
    unsigned drives() const {
        std::uint16_t word = 0xFFFF;
        card.look(0, &word, sizeof word);
        return word & 0xFU;
    }
    void drive_x() const {
        EXPECT_TRUE(served->post("take_control").contains("done"));
        good("SetRange", {{"data", 800'000}}, "Written.");
        good("TCurve_C", {{"axis", 1}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}}, "X drives.");
        ASSERT_EQ(drives(), x_drives);
    }
    void until_stopped(ServedLink& link) const {
        until_service_ended(link);
        EXPECT_EQ(drives(), 0U);
    }
};

TEST_F(PanelOnARealCard, CallsTheFunctionsOfItsLibrary) {
    EXPECT_THAT(served->said, HasSubstr("real     bench at " + card.place));
    EXPECT_TRUE(served->post("take_control").contains("done"));
    good("SetRange", {{"data", 800'000}}, "Written.");
    good("TCurve_F", {{"axis", 1}, {"m_SV", 100}, {"m_V", 2000}, {"m_A", 400}, {"m_Pulse", 2000}}, "X drives.");
    good("wait", {{"axis", 1}, {"milliseconds", 10'000}}, "X is at standstill, as commanded.");
    good("ReadLPS", {{"axis", 1}}, "2000 pulses");
    const json shown = served->get("card?name=bench");
    EXPECT_EQ(shown["values"][0]["name"], "x.LP") << shown;
    EXPECT_EQ(shown["values"][0]["value"], 2000) << shown;
    // A busy computer lets this program wait. So that its second line is not too late, the first one takes 4 s;
    // both take less than the 10 s after which control is lost.
    good("contour_begin", {{"SV", 12}, {"V", 12}, {"A", 0}, {"D", 0}}, "The contour is open; add its lines and arcs.");
    good("contour_line", {{"axis", 3}, {"PX", -500}, {"PY", 0}, {"PZ", 0}, {"PU", 0}, {"V", 0}},
         "The line was accepted.");
    good("contour_line", {{"axis", 3}, {"PX", 0}, {"PY", 100}, {"PZ", 0}, {"PU", 0}, {"V", 0}},
         "The line was accepted.");
    const json ended = served->post("call", {{"card", "bench"}, {"function", "contour_end"}});
    EXPECT_TRUE(ended.contains("done")) << ended;
    good("ReadLPS", {{"axis", 1}}, "1500 pulses");
    good("ReadLPS", {{"axis", 2}}, "100 pulses");
    end_service();
    EXPECT_TRUE(alarm(*served).is_null());
}

TEST_F(PanelOnARealCard, StopsADriveWhileAFunctionWaits) {
    drive_x();
    ASSERT_TRUE(served->send(
        "POST", "call",
        json{{"card", "bench"}, {"function", "wait"}, {"arguments", {{"axis", 1}, {"milliseconds", 60'000}}}}.dump()));
    ServedLink other(served->port());
    until("it waits",
          [&] { return other.get("events?limit=20").dump().find("call wait: begun") != std::string::npos; });
    EXPECT_EQ(drives(), x_drives);
    EXPECT_TRUE(other.post("stop").contains("done"));
    until("X stands", [&] { return drives() == 0; });
    EXPECT_THAT(served->answer()["error"]["message"].get<std::string>(),
                HasSubstr("Stopped on request; X stands still."));
    until_stopped(other);
    EXPECT_EQ(other.status()["state"], "error stop");
    EXPECT_TRUE(alarm(other).is_null());
}

TEST_F(PanelOnARealCard, StopsMotionAtEachEndOfTheService) {
    const std::vector<std::pair<const char*, json>> orders = {
        {"stop", json::object()},           {"service", {{"card", "bench"}, {"on", false}}},
        {"enable", {{"on", false}}},        {"release_control", json::object()},
        {"set_estop", {{"pressed", true}}},
    };
    for (const auto& [order, fields] : orders) {
        drive_x();
        const json answer = served->post(order, fields);
        EXPECT_TRUE(answer.contains("done")) << order << ": " << answer;
        until_stopped(*served);
        EXPECT_TRUE(alarm(*served).is_null()) << order;
        if (served->status()["state"] != "error stop") continue;
        served->post("set_estop", {{"pressed", false}});
        served->post("take_control");
        until("it is reset", [&] {
            served->post("reset");
            return served->status()["state"] != "error stop";
        });
    }
}

TEST_F(PanelOnARealCard, StopsTenSecondsAfterTheLastRequestOfItsClient) {
    drive_x();
    served->close();
    until("X stands", [&] { return drives() == 0; });
    ServedLink other(served->port());
    until_stopped(other);
}

TEST_F(PanelOnARealCard, StopsWithTheProgram) {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        drive_x();
        EXPECT_EQ(served->end(signal), 0);
        EXPECT_EQ(drives(), 0U) << signal;
        serve();
    }
}

TEST_F(PanelOnARealCard, KeepsDrivingAfterAKillOfTheProgramUntilTheNextService) {
    drive_x();
    EXPECT_EQ(served->end(SIGKILL), -SIGKILL);
    EXPECT_EQ(drives(), x_drives) << "nothing is left that could stop it";
    serve();
    EXPECT_EQ(drives(), x_drives) << "it is opened by its service only";
    EXPECT_TRUE(served->post("take_control").contains("done"));
    EXPECT_TRUE(served->post("service", {{"card", "bench"}, {"on", true}}).contains("done"));
    EXPECT_EQ(drives(), 0U) << "it was reset";
}

TEST_F(PanelOnARealCard, AlarmsWhereItsPortVanishes) {
    drive_x();
    card.refuse(0xFFFF'FFFF);
    until("an alarm", [&] { return !alarm(*served).is_null(); });
    EXPECT_EQ(drives(), x_drives);
    EXPECT_THAT(alarm(*served)["text"].get<std::string>(),
                AllOf(HasSubstr("No such device"), HasSubstr("was not written"),
                      HasSubstr("press the emergency stop that cuts the motors' power")));
    EXPECT_EQ(served->status()["service"], "");
    served->post("reset");
    EXPECT_TRUE(alarm(*served)["active"]) << "no reset ends its cause";
    const json refused = served->post("call", {{"card", "bench"}, {"function", "RESET"}});
    EXPECT_THAT(refused["error"]["message"].get<std::string>(), HasSubstr("No such device"));
    card.refuse(0);
    good("ReadLPS", {{"axis", 1}}, "0 pulses");
    end_service();
    EXPECT_EQ(drives(), 0U);
    EXPECT_FALSE(alarm(*served)["active"]);
}

TEST_F(PanelOnARealCard, AlarmsWhereItsSlotIsEmpty) {
    drive_x();
    card.remove(true);
    until("an alarm", [&] { return !alarm(*served).is_null(); });
    EXPECT_EQ(drives(), x_drives);
    EXPECT_THAT(alarm(*served)["text"].get<std::string>(),
                AllOf(HasSubstr("no card answers"), HasSubstr("positions are not valid"), HasSubstr("was not written"),
                      HasSubstr("press the emergency stop that cuts the motors' power")));
    const json refused =
        served->post("call", {{"card", "bench"}, {"function", "ReadLPS"}, {"arguments", {{"axis", 1}}}});
    EXPECT_THAT(refused["error"]["message"].get<std::string>(), HasSubstr("no card answers"));
    EXPECT_TRUE(alarm(*served)["active"]);
    card.remove(false);
    good("ReadLPS", {{"axis", 1}}, "0 pulses");
    end_service();
    EXPECT_EQ(drives(), 0U);
    EXPECT_FALSE(alarm(*served)["active"]);
}

TEST_F(PanelOnARealCard, AlarmsWhereAStopIsRefused) {
    drive_x();
    card.refuse(0xFFFF'FFFF);
    EXPECT_TRUE(served->post("stop").contains("done"));
    until("an alarm", [&] { return !alarm(*served).is_null(); });
    EXPECT_TRUE(alarm(*served)["active"]);
    EXPECT_THAT(alarm(*served)["text"].get<std::string>(), HasSubstr("was not written"));
    EXPECT_EQ(served->end(SIGTERM), 4) << "its axes may not be at rest";
    card.refuse(0);
}

TEST_F(PanelOnARealCard, IsStoppedThroughAPortThatWasOpenedAgain) {
    drive_x();
    card.refuse(1);
    until("an alarm", [&] { return !alarm(*served).is_null(); });
    EXPECT_EQ(drives(), 0U);
    EXPECT_THAT(alarm(*served)["text"].get<std::string>(),
                AllOf(HasSubstr("No such device"), HasSubstr("was opened again"), HasSubstr("they stand")));
}

}  // namespace
}  // namespace motionrack
