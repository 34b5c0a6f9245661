// A card's function library on the page: declared functions, permissions, journal entries.
#include <gmock/gmock.h>

#include "asked.hpp"

namespace motionrack::panel {
namespace {

using testing::HasSubstr;

rack::RackConfig two_cards() {
    return config_of(
        "[card.m]\ntype = \"mcx314\"\n[card.free]\ntype = \"mcx314\"\n[card.glass]\ntype = \"ioflex02\"\n"
        "[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = 10\n");
}

std::function<void(const Answer&)> is_refused(int status, const std::string& why) {
    return [=](const Answer& answer) {
        EXPECT_EQ(answer.status, status) << answer.body;
        EXPECT_THAT(answer.body["error"]["message"].get<std::string>(), HasSubstr(why));
    };
}

json call_of(const std::string& function, json arguments = json::object(), const std::string& card = "m") {
    return {{"card", card}, {"function", function}, {"arguments", std::move(arguments)}};
}

TEST(LibraryOnThePage, IsDeclaredWithRangesAndUnits) {
    Asked a(two_cards());
    a.at(0.1, eve, "library", {{"name", "m"}}, [](const Answer& answer) {
        const json& functions = answer.body["functions"];
        std::size_t listed = 0;
        for (const json& one : functions) listed += one["own"] == false;
        EXPECT_EQ(listed, 57U);
        const json& set_v = functions[5];
        EXPECT_EQ(set_v["name"], "SetV");
        EXPECT_EQ(set_v["group"], "4.4 Basic motion");
        EXPECT_EQ(set_v["arguments"][1]["min"], 1);
        EXPECT_EQ(set_v["arguments"][1]["max"], 8000);
        EXPECT_EQ(set_v["arguments"][0]["sum"], true);
        EXPECT_EQ(set_v["arguments"][0]["values"][3]["meaning"], "U");
    });
    a.at(0.1, eve, "library", {{"name", "glass"}}, is_refused(409, "no function library"));
    a.at(0.1, eve, "library", {{"name", "nothing"}}, is_refused(400, "the cards of this rack are: m, free, glass"));
    a.at(0.1, eve, "rack", json::object(), [](const Answer& answer) {
        EXPECT_GT(answer.body["cards"][0]["functions"], 57);
        EXPECT_EQ(answer.body["cards"][2]["functions"], 0);
    });
    a.run(0.3);
}

TEST(LibraryOnThePage, NeedsTheRoleControlAndTheService) {
    Asked a(two_cards());
    a.at(0.1, bert, "call", call_of("ReadLPS", {{"axis", 1}}), is_refused(403, "needs the role maintain"));
    a.at(0.1, anna, "call", call_of("ReadLPS", {{"axis", 1}}), is_refused(409, "Take control first"));
    a.good(0.2, "take_control");
    a.good(0.25, "enable", {{"on", true}});
    a.at(0.3, anna, "call", call_of("ReadLPS", {{"axis", 1}}), is_refused(409, "driven by the controller"));
    a.at(0.3, anna, "call", call_of("SetV", {{"axis", 1}, {"data", 9000}}), is_refused(400, "must be 1 to 8000"));
    a.at(0.3, anna, "call", call_of("SetV", {{"axis", 1}, {"data", 0.5}}), is_refused(400, "must be a whole number"));
    a.at(0.3, anna, "call", {{"card", "m"}, {"function", "RESET"}, {"arguments", 3}},
         is_refused(400, "must be an object"));
    a.at(0.3, anna, "service", {{"card", "m"}, {"on", false}}, is_refused(409, "No card is in service"));
    a.run(0.5);
}

TEST(LibraryOnThePage, IsCalledAndRecordedInTheJournal) {
    Asked a(two_cards());
    a.good(0.05, "take_control");
    a.good(0.1, "enable", {{"on", true}});
    a.at(0.2, anna, "service", {{"card", "m"}, {"on", true}}, [](const Answer& answer) {
        EXPECT_EQ(answer.status, 200) << answer.body;
        EXPECT_THAT(answer.body["text"].get<std::string>(), HasSubstr("The position of X is not valid any more."));
    });
    a.good(0.3, "call", call_of("SetRange", {{"data", 800'000}}));
    a.good(0.4, "call",
           call_of("TCurve_F", {{"axis", 1}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 100}, {"m_Pulse", 500}}));
    a.at(0.5, anna, "call", call_of("wait", {{"axis", 1}, {"milliseconds", 10'000}}),
         [](const Answer& answer) { EXPECT_EQ(answer.status, 200) << answer.body; });
    a.at(0.6, anna, "call", call_of("ReadLPS", {{"axis", 1}}), [](const Answer& answer) {
        EXPECT_EQ(answer.body["value"], 500) << answer.body;
        EXPECT_EQ(answer.body["text"], "500 pulses");
    });
    a.at(0.7, anna, "call", call_of("contour_end"), is_refused(409, "no chain"));
    a.at(0.8, eve, "status", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["status"]["service"], "m");
        EXPECT_EQ(answer.body["status"]["state"], "service");
    });
    a.at(0.9, anna, "service", {{"card", "m"}, {"on", false}}, [](const Answer& answer) {
        EXPECT_THAT(answer.body["text"].get<std::string>(), HasSubstr("home it, or set its position"));
    });
    a.at(1.1, eve, "events", {{"limit", 100}}, [](const Answer& answer) {
        std::string all;
        for (const json& event : answer.body["events"]) all += event["text"].get<std::string>() + '\n';
        for (const char* entry :
             {"anna: service card=\"m\" on=true", "service: card m is in service by anna.",
              "anna: call arguments={\"axis\":1,\"m_A\":100,\"m_Pulse\":500,\"m_SV\":100,\"m_V\":1000} card=\"m\" "
              "function=\"TCurve_F\"",
              "anna: call contour_end: contour_end: no chain", "standstill: The service of card m has ended"})
            EXPECT_THAT(all, HasSubstr(entry));
    });
    a.run(1.3);
}

TEST(LibraryOnThePage, StopsWhenControlOrTheConnectionEnds) {
    for (const bool leaves : {false, true}) {
        Asked a(two_cards());
        a.good(0.05, "take_control");
        a.good(0.1, "enable", {{"on", true}});
        a.good(0.2, "service", {{"card", "m"}, {"on", true}});
        a.good(0.3, "call", call_of("SetRange", {{"data", 800'000}}));
        a.good(0.4, "call", call_of("TCurve_C", {{"axis", 1}, {"m_SV", 100}, {"m_V", 8000}, {"m_A", 1}}));
        a.at(0.6, [&] {
            EXPECT_GT(a.machine->status().axes[0].velocity, 0);
            if (leaves)
                a.panel->left("w1");
            else
                EXPECT_TRUE(a.lease.release("w1"));
        });
        double x = 0;
        a.at(0.61, [&] { x = a.machine->status().axes[0].true_position; });
        a.at(0.8, [&] {
            EXPECT_EQ(a.machine->status().axes[0].true_position, x);
            EXPECT_EQ(a.machine->state(), operate::MachineState::standstill);
            EXPECT_THAT(a.machine->status().reason, HasSubstr("Loss of control by anna"));
        });
        a.run(0.9);
    }
}

TEST(LibraryOnThePage, OfACardThatNothingDrivesNeedsControlOnly) {
    Asked a(two_cards());
    a.good(0.05, "take_control");
    a.good(0.1, "call", call_of("SetRange", {{"data", 800'000}}, "free"));
    a.at(0.2, anna, "call", call_of("ReadLPS", {{"axis", 1}}, "free"),
         [](const Answer& answer) { EXPECT_EQ(answer.body["value"], 0) << answer.body; });
    a.good(0.3, "service", {{"card", "free"}, {"on", false}});
    a.at(0.4, [&] { EXPECT_EQ(a.machine->state(), operate::MachineState::disabled); });
    a.run(0.5);
}

}  // namespace
}  // namespace motionrack::panel
