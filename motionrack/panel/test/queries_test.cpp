// Queries: status, channels, cards, scope; and their freedom from side effects.
#include <gmock/gmock.h>

#include <cmath>

#include "asked.hpp"

namespace motionrack::panel {
namespace {

using testing::HasSubstr;

const char* const part = "G21 G90 F1200\nG1 X30 Y0\nG2 X40 Y10 I10\nM2\n";

TEST(Queries, LeaveTheTraceOfAJobAsItIs) {
    const auto traced = [](bool viewer) {
        Asked a(demonstration());
        std::shared_ptr<ChannelSet> set;
        a.good(0.1, "take_control");
        a.good(0.2, "enable", {{"on", true}});
        for (const char* axis : {"X", "Y", "Z", "A"})
            a.good(0.3, "set_position", {{"axis", axis}, {"position", *axis == 'Z' ? 80 : 0}});
        a.good(0.6, "start_program", {{"name", "p"}, {"text", part}});
        if (viewer) {
            a.at(0.2, [&] {
                a.panel->subscribe({"X.actual", "X.position_mm", "motion.x.LP", "motion.xpp", "glass.0.POSITION",
                                    "scan.XOUT", "host.sequence", "head.spot_x_mm", "mask_x.position_mm"},
                                   [&](Result<std::shared_ptr<ChannelSet>> made) { set = *made; });
            });
            for (double at = 0.3; at < 1.6; at += 0.1)
                for (const char* card : {"motion", "positioner", "glass", "decoder", "host", "mask", "scan"})
                    a.at(at, eve, "card", {{"name", card}},
                         [](const Answer& answer) { EXPECT_EQ(answer.status, 200) << answer.body; });
            for (const char* query : {"status", "rack", "frames", "path", "channels"}) a.at(1, eve, query);
            a.at(1, eve, "workpiece", {{"scanner", "head"}});
            a.at(1, eve, "slopes", {{"name", "positioner"}});
        }
        a.run(5);
        EXPECT_NEAR(a.x(), 40, 0.01);
        if (viewer) {
            const auto values = set->newest();
            EXPECT_EQ(values->numbers.size(), 9U);
            for (const double number : values->numbers) EXPECT_FALSE(std::isnan(number));
        }
        return a.machine->rack().kernel().trace_hash();
    };
    EXPECT_EQ(traced(false), traced(true));
}

TEST(Channels, AreSharedRejectedAndRemoved) {
    Asked a(two_axes());
    std::shared_ptr<ChannelSet> one, other;
    a.at(0.1, [&] {
        a.panel->subscribe({"X.actual", "estop"}, [&](auto made) { one = *made; });
        a.panel->subscribe({"X.actual", "estop"}, [&](auto made) { other = *made; });
        a.panel->subscribe({"X.weight"}, [&](auto made) {
            EXPECT_THAT(made.error().message, HasSubstr("Unknown channel 'X.weight'"));
        });
        a.panel->subscribe(std::vector<std::string>(65, "estop"),
                           [&](auto made) { EXPECT_THAT(made.error().message, HasSubstr("the limit is 64")); });
    });
    a.at(0.3, [&] {
        EXPECT_EQ(one.get(), other.get());
        EXPECT_THAT(one->newest()->numbers, testing::ElementsAre(10, 1));
        EXPECT_EQ(one->newest()->sequence, a.panel->picture()->sequence());
        other.reset();
        std::weak_ptr<ChannelSet> gone = one;
        one.reset();
        EXPECT_TRUE(gone.expired());
    });
    a.run(0.4);
}

TEST(Channels, AllCanBeReadAndHaveASentence) {
    Asked a(demonstration());
    a.at(0.1, eve, "channels", json::object(), [&](const Answer& answer) {
        const json& list = answer.body["channels"];
        EXPECT_GT(list.size(), 300U);
        for (std::size_t i = 0; i < list.size(); i += 60) {
            std::vector<std::string> names;
            for (std::size_t k = i; k < std::min(i + 60, list.size()); ++k) {
                names.push_back(list[k]["name"]);
                EXPECT_FALSE(list[k]["text"].get<std::string>().empty());
            }
            a.panel->subscribe(names, [](auto made) { EXPECT_TRUE(made); });
        }
    });
    a.run(0.3);
}

TEST(RackQueries, IsDescribedWithCardsWiresPartsAndFaults) {
    PanelSettings settings;
    settings.rack_text = "[rack]\n";
    Asked a(demonstration(), std::move(settings));
    a.at(0.1, eve, "rack", json::object(), [](const Answer& answer) {
        const json& rack = answer.body;
        EXPECT_EQ(rack["name"], "demonstration");
        EXPECT_EQ(rack["text"], "[rack]\n");
        EXPECT_EQ(rack["axes"].size(), 4U);
        EXPECT_EQ(rack["cards"].size(), 8U);
        EXPECT_EQ(rack["cards"][0]["channels"], json({"x", "y", "z", "u"}));
        EXPECT_FALSE(rack["cards"][0]["registers"].empty());
        EXPECT_FALSE(rack["cards"][0]["pins"][0]["meaning"].get<std::string>().empty());
        EXPECT_EQ(rack["scanners"], json({"head"}));
        EXPECT_FALSE(rack["faults"].empty());
    });
    a.at(0.2, eve, "card", {{"name", "motion"}}, [](const Answer& answer) {
        std::vector<std::string> names;
        for (const json& reg : answer.body["registers"]) names.push_back(reg["name"]);
        EXPECT_THAT(names, testing::IsSupersetOf({"RR0", "x.RR1", "u.RR2"}));
        std::vector<std::string> values;
        for (const json& value : answer.body["values"]) values.push_back(value["name"]);
        EXPECT_THAT(values, testing::IsSupersetOf({"x.LP", "x.EP", "x.CV", "x.CA"}));
        EXPECT_TRUE(answer.body["pins"].contains("xlmtp"));
    });
    a.at(0.3, eve, "frames", json::object(), [](const Answer& answer) {
        const json& bus = answer.body["buses"][0];
        EXPECT_EQ(bus["cards"].size(), 3U);
        EXPECT_TRUE(bus["agree"].get<bool>()) << bus["reason"];
        EXPECT_EQ(bus["cards"][1]["positions"].size(), 2U);
    });
    a.at(0.3, eve, "slopes", {{"name", "motion"}}, [](const Answer& answer) { EXPECT_EQ(answer.status, 400); });
    a.at(0.3, eve, "slopes", {{"name", "positioner"}},
         [](const Answer& answer) { EXPECT_EQ(answer.body["slopes"].size(), 2U); });
    a.at(0.3, eve, "card", {{"name", "nobody"}}, [](const Answer& answer) { EXPECT_EQ(answer.status, 400); });
    a.at(0.3, eve, "workpiece", {{"scanner", "nobody"}}, [](const Answer& answer) { EXPECT_EQ(answer.status, 400); });
    a.run(0.5);
}

TEST(RackQueries, HasNoFramesWithoutABusAndNoJournalWithoutOne) {
    Asked a(two_axes());
    a.at(0.1, eve, "frames", json::object(), [](const Answer& answer) { EXPECT_EQ(answer.status, 409); });
    a.at(0.1, eve, "journal", json::object(), [](const Answer& answer) { EXPECT_EQ(answer.status, 409); });
    a.at(0.1, eve, "homing", json::object(),
         [](const Answer& answer) { EXPECT_TRUE(answer.body["homing"].is_null()); });
    a.at(0.1, eve, "users", json::object(), [](const Answer& answer) { EXPECT_EQ(answer.status, 403); });
    a.run(0.2);
}

TEST(Program, IsPlannedBeforeItRunsAndItsPathIsShown) {
    Asked a(two_axes());
    a.at(0.1, eve, "check", {{"name", "p"}, {"text", part}}, [](const Answer& answer) {
        EXPECT_TRUE(answer.body["ok"].get<bool>()) << answer.body;
        EXPECT_NEAR(answer.body["length_mm"].get<double>(), 20 + M_PI * 5, 7);
        EXPECT_GT(answer.body["path"].size(), 10U);
        EXPECT_EQ(answer.body["max"]["X"], 40);
        EXPECT_GT(answer.body["duration_s"].get<double>(), 1);
    });
    a.at(0.1, eve, "check", {{"text", "G1 X1\nG1 F100 X900\n"}}, [](const Answer& answer) {
        EXPECT_FALSE(answer.body["ok"].get<bool>());
        EXPECT_EQ(answer.body["problems"][1]["line"], 2);
    });
    a.good(0.2, "take_control");
    a.good(0.3, "enable", {{"on", true}});
    a.good(0.4, "start_program", {{"name", "p"}, {"text", part}});
    a.at(5, eve, "path", json::object(), [](const Answer& answer) {
        EXPECT_GT(answer.body["planned"].size(), 10U);
        EXPECT_GT(answer.body["driven"].size(), 100U);
        EXPECT_EQ(answer.body["errors"].size(), answer.body["driven"].size());
        EXPECT_NEAR(answer.body["driven"].back()[1].get<double>(), 40, 0.1);
    });
    a.at(5.1, eve, "path", {{"have", 1}, {"since", 4.9}}, [](const Answer& answer) {
        EXPECT_FALSE(answer.body.contains("planned"));
        EXPECT_TRUE(answer.body["driven"].empty());
    });
    a.run(6);
}

TEST(Scope, HasEveryEdgeOfAPulseOutputAndSamplesFromBeforeTheTrigger) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "scope_arm",
           {{"channels", {"m.xpp", "X.position_mm", "X.actual"}},
            {"trigger", "m.xpp"},
            {"edge", "either"},
            {"period_us", 50},
            {"length", 0.05},
            {"pre", 0.01}});
    a.at(0.5, eve, "scope", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["state"], "armed");
        EXPECT_FALSE(answer.body.contains("capture"));
    });
    a.good(0.6, "mdi", {{"text", "G1 X20 F600"}});
    a.at(1, eve, "scope", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["state"], "done");
        const json& capture = answer.body["capture"];
        const json& edges = capture["traces"][0];
        ASSERT_GT(edges["at"].size(), 20U);
        EXPECT_DOUBLE_EQ(edges["at"][0].get<double>(), 0);
        for (const json& at : edges["at"]) EXPECT_LE(at.get<double>(), 0.04);
        const json& place = capture["traces"][1]["values"];
        EXPECT_NEAR(static_cast<double>(place.size()), 1000, 2);
        EXPECT_NEAR(capture["first_sample"].get<double>(), -0.01, 6e-5);
        EXPECT_DOUBLE_EQ(place[0].get<double>(), 10);
        EXPECT_GT(place.back().get<double>(), 10.01);
    });
    a.at(1.1, eve, "scope", {{"since", 1}},
         [](const Answer& answer) { EXPECT_FALSE(answer.body.contains("capture")); });
    a.run(3);
}

TEST(Scope, TriggersOnANumberRunsAgainAndIsStopped) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "scope_arm",
           {{"channels", {"X.position_mm"}},
            {"trigger", "X.position_mm"},
            {"edge", "rise"},
            {"level", 15},
            {"period_us", 1000},
            {"length", 0.2},
            {"pre", 0.1},
            {"mode", "run"}});
    a.good(0.5, "mdi", {{"text", "G1 X20 F600"}});
    a.good(0.5, "mdi", {{"text", "G1 X10 F600"}});
    a.good(0.5, "mdi", {{"text", "G1 X20 F600"}});
    a.at(5, eve, "scope", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["state"], "armed");
        EXPECT_EQ(answer.body["capture"]["number"], 2);
        const json& values = answer.body["capture"]["traces"][0]["values"];
        EXPECT_LT(values[99].get<double>(), 15);
        EXPECT_GE(values[101].get<double>(), 15);
    });
    a.good(5.1, "scope_stop");
    a.at(5.2, eve, "scope", json::object(), [](const Answer& answer) { EXPECT_EQ(answer.body["state"], "idle"); });
    a.at(5.2, anna, "scope_arm", {{"channels", {"X.position_mm"}}, {"period_us", 1}, {"length", 1}},
         [](const Answer& answer) { EXPECT_EQ(answer.status, 409); });
    a.at(5.2, anna, "scope_arm", {{"channels", {"X.position_mm"}}, {"trigger", "estop"}},
         [](const Answer& answer) { EXPECT_EQ(answer.status, 400); });
    a.at(5.2, eve, "scope_arm", {{"channels", {"estop"}}}, [](const Answer& answer) { EXPECT_EQ(answer.status, 403); });
    a.run(5.5);
}

TEST(LaserCard, MarksWhileTheRackRunsAndAddsToTheWorkpiece) {
    Asked a(demonstration());
    const char* const job = "[drawing]\ntext = \"AB\"\nheight_mm = 4\n[pace]\nmark_speed_mm_s = 200\n";
    a.good(0.1, "take_control");
    a.at(0.2, anna, "mark", {{"card", "motion"}, {"job", job}},
         [](const Answer& answer) { EXPECT_EQ(answer.status, 400); });
    a.at(0.2, anna, "mark", {{"card", "scan"}, {"job", "[drawing]\nsvg = \"/etc/passwd\"\n"}},
         [](const Answer& answer) {
             EXPECT_EQ(answer.status, 409);
             EXPECT_THAT(answer.body["error"]["message"].get<std::string>(), HasSubstr("are not read"));
         });
    a.at(0.2, anna, "mark", {{"card", "scan"}, {"job", "nonsense"}},
         [](const Answer& answer) { EXPECT_EQ(answer.status, 400); });
    a.at(0.3, anna, "mark", {{"card", "scan"}, {"job", job}},
         [](const Answer& answer) { EXPECT_EQ(answer.status, 200) << answer.body; });
    a.at(0.31, anna, "mark", {{"card", "scan"}, {"job", job}},
         [](const Answer& answer) { EXPECT_EQ(answer.status, 409) << answer.body; });
    a.at(1, eve, "workpiece", {{"scanner", "head"}}, [](const Answer& answer) {
        EXPECT_NEAR(answer.body["marked_mm"].get<double>(), 25, 20);
        EXPECT_GT(answer.body["marks"].size(), 2U);
        EXPECT_EQ(answer.body["part"]["name"], "line");
    });
    a.good(1.1, "mark_stop", {{"card", "scan"}});
    a.at(1.2, anna, "mark", {{"card", "scan"}, {"job", job}, {"start", "parts"}},
         [](const Answer& answer) { EXPECT_EQ(answer.status, 200) << answer.body; });
    double before = 0;
    a.at(1.25, eve, "workpiece", {{"scanner", "head"}},
         [&](const Answer& answer) { before = answer.body["marked_mm"]; });
    a.at(4.5, eve, "workpiece", {{"scanner", "head"}},
         [&](const Answer& answer) { EXPECT_GT(answer.body["marked_mm"].get<double>(), 1.9 * before); });
    a.run(5);
}

TEST(Picture, IsEncodedOnceAndHasWhatThePageShows) {
    Asked a(demonstration());
    a.at(0.2, [&] {
        const auto picture = a.panel->picture();
        const json status = json::parse(picture->status_text());
        EXPECT_EQ(&picture->status_text(), &picture->status_text());
        EXPECT_EQ(status["axes"].size(), 4U);
        EXPECT_TRUE(status["axes"][0]["can_home"].get<bool>());
        EXPECT_TRUE(status["axes"][0]["leds"].contains("hard_plus"));
        EXPECT_FALSE(status["axes"][0]["leds"]["hard_plus"].get<bool>());
        for (const char* led : {"index", "alarm", "capture", "compare"})
            EXPECT_TRUE(status["axes"][0]["leds"].contains(led)) << led;
        EXPECT_TRUE(status["axes"][0]["leds"]["in_position"].get<bool>());
        EXPECT_FALSE(status["axes"][0]["enabled"].get<bool>());
        EXPECT_EQ(status["clock"]["mode"], "unthrottled");
        EXPECT_TRUE(status["control"]["holder"].is_null());
        EXPECT_TRUE(status["simulation"].get<bool>());
    });
    a.good(0.3, "take_control");
    a.good(0.4, "enable", {{"on", true}});
    a.good(0.5, "home", {{"axes", "X"}});
    a.at(0.8, eve, "status", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["status"]["state"], "homing");
        EXPECT_TRUE(answer.body["status"]["homing"]["phases"].contains("X")) << answer.body["status"]["homing"];
        EXPECT_FALSE(answer.body["status"]["axes"][0]["leds"]["in_position"].get<bool>());
    });
    a.good(30.1, "set_wire", {{"name", "motion.yalarm"}, {"value", 0}});
    a.at(30.2, eve, "status", json::object(), [](const Answer& answer) {
        EXPECT_TRUE(answer.body["status"]["axes"][1]["leds"]["alarm"].get<bool>());
        EXPECT_FALSE(answer.body["status"]["axes"][0]["leds"]["alarm"].get<bool>());
    });
    a.at(30, eve, "homing", json::object(), [](const Answer& answer) {
        EXPECT_TRUE(answer.body["homing"]["axes"][0]["homed"].get<bool>()) << answer.body;
    });
    a.run(31);
}

}  // namespace
}  // namespace motionrack::panel
