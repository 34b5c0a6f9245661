// A card replaced by a real one, as shown on the page: /dev/zero acts as a real card at standstill.
#include <gmock/gmock.h>

#include <motionrack/live/test/zero_card.hpp>
#include <motionrack/operate/clock_pacer.hpp>

#include "asked.hpp"

namespace motionrack::panel {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const char* const place = "port:/dev/zero";

rack::RackConfig with_bench() {
    return config_of(
        "[card.m]\ntype = \"mcx314\"\n[card.bench]\ntype = \"mcx314\"\n"
        "[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = 10\n");
}

operate::MachineSettings with_live() {
    operate::MachineSettings settings;
    settings.live.push_back(*operate::read_live_place(std::string("bench=") + place));
    return settings;
}

std::function<void(const Answer&)> is_refused(const std::string& why) {
    return [=](const Answer& answer) {
        EXPECT_EQ(answer.status, 409) << answer.body;
        EXPECT_THAT(answer.body["error"]["message"].get<std::string>(), HasSubstr(why));
    };
}

std::string live_text(const json& all, const char* list) {
    std::string out;
    for (const json& one : all[list]) out += one.value("name", one.value("target", "")) + '\n';
    return out;
}

TEST(RealCardOnThePage, ReportsItsAddressAndShowsNothingOfTheVirtualOne) {
    Asked a(with_bench(), {}, with_live());
    a.at(0.1, eve, "rack", json::object(), [](const Answer& answer) {
        const json& cards = answer.body["cards"];
        EXPECT_TRUE(cards[0]["live"].is_null());
        EXPECT_EQ(cards[1]["live"], place);
        EXPECT_GT(cards[1]["functions"], 57);
        for (const char* list : {"pins", "values", "quantities"}) {
            EXPECT_EQ(cards[1][list].size(), 0U) << list;
        }
        EXPECT_THAT(live_text(answer.body, "wires"), HasSubstr("m.xlmtp"));
        for (const char* list : {"wires", "faults"}) {
            EXPECT_THAT(live_text(answer.body, list), Not(HasSubstr("bench")));
        }
    });
    a.at(0.1, eve, "channels", json::object(), [](const Answer& answer) {
        EXPECT_THAT(live_text(answer.body, "channels"), HasSubstr("m.x.LP"));
        EXPECT_THAT(live_text(answer.body, "channels"), Not(HasSubstr("bench")));
    });
    a.run(0.2);
}

/// A service of a real card starts and ends in real time, which can be slow on a busy computer: 5 s are enough.
TEST(RealCardOnThePage, IsReadInServiceOnly) {
    const live::test::ZeroCard zero;
    Asked a(with_bench(), {}, with_live());
    a.at(0.05, eve, "card", {{"name", "bench"}}, [](const Answer& answer) {
        EXPECT_EQ(answer.body["registers"].size(), 0U);
        EXPECT_EQ(answer.body["values"].size(), 0U);
        EXPECT_THAT(answer.body["reason"].get<std::string>(), HasSubstr("is read while it is in service only"));
    });
    a.good(0.1, "take_control");
    a.good(0.15, "service", {{"card", "bench"}, {"on", true}});
    a.at(5, eve, "card", {{"name", "bench"}}, [](const Answer& answer) {
        ASSERT_FALSE(answer.body.contains("reason")) << answer.body;
        EXPECT_EQ(answer.body["registers"][0]["name"], "RR0");
        EXPECT_EQ(answer.body["registers"][0]["fields"]["DRV"], 0);
        EXPECT_EQ(answer.body["values"].size(), 16U);
        EXPECT_EQ(answer.body["values"][0]["name"], "x.LP");
    });
    a.at(5, eve, "status", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["status"]["service"], "bench");
        EXPECT_FALSE(answer.body["status"]["simulation"]) << "something real moves";
    });
    a.at(5.05, eve, "card", {{"name", "m"}},
         [](const Answer& answer) { EXPECT_GT(answer.body["values"].size(), 16U); });
    a.good(5.1, "service", {{"card", "bench"}, {"on", false}});
    a.at(10, eve, "card", {{"name", "bench"}}, [](const Answer& answer) {
        EXPECT_EQ(answer.body["registers"].size(), 0U);
        EXPECT_TRUE(answer.body.contains("reason"));
    });
    a.at(10, eve, "status", json::object(),
         [](const Answer& answer) { EXPECT_TRUE(answer.body["status"]["simulation"]); });
    a.at(10.05, eve, "events", {{"limit", 100}}, [](const Answer& answer) {
        std::string all;
        for (const json& event : answer.body["events"]) all += event["text"].get<std::string>() + '\n';
        EXPECT_THAT(all, HasSubstr("service: card bench is in service by anna; it is a real one, at port:/dev/zero."));
    });
    a.run(10.1);
}

TEST(RealCardOnThePage, IsNotAffectedByCommandsToTheVirtualOne) {
    live::MonotonicClock clock;
    operate::ClockPacer pacer(clock, operate::ClockMode::real, 1);
    PanelSettings settings;
    settings.pacer = &pacer;
    Asked a(with_bench(), std::move(settings), with_live());
    const std::string why = "card bench is a real one at port:/dev/zero. Nothing was done.";
    a.good(0.05, "take_control");
    a.at(0.1, anna, "read_register", {{"card", "bench"}, {"bits", 16}, {"address", 0}}, is_refused(why));
    a.at(0.1, anna, "write_register", {{"card", "bench"}, {"bits", 16}, {"address", 0}, {"value", 0}}, is_refused(why));
    a.at(0.1, anna, "set_wire", {{"name", "bench.xlmtp"}, {"value", 0}}, is_refused(why));
    a.at(0.1, anna, "inject_fault", {{"target", "bench"}, {"fault", "stuck=1"}}, is_refused(why));
    for (const char* mode : {"unthrottled", "paused", "real"})
        a.at(0.1, anna, "set_clock", {{"mode", mode}, {"factor", 2}},
             is_refused("The clock was not changed: card bench"));
    a.at(0.2, [&] { EXPECT_EQ(pacer.factor(), 1); });
    a.run(0.3);
}

}  // namespace
}  // namespace motionrack::panel
