// Commands: permissions, checks, and execution by the machine.
#include <gmock/gmock.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>
#include <motionrack/panel/test/panel_fuzz.hpp>
#include <set>
#include <tests/source_root.hpp>

#include "asked.hpp"

namespace motionrack::panel {
namespace {

using testing::HasSubstr;

std::string message(const Answer& answer) {
    return answer.body.contains("error") ? answer.body["error"]["message"].get<std::string>() : "";
}

/// Expects a refusal with this status and text.
std::function<void(const Answer&)> refused(int status, const std::string& words) {
    return [status, words](const Answer& answer) {
        EXPECT_EQ(answer.status, status) << answer.body.dump();
        EXPECT_THAT(message(answer), HasSubstr(words));
    };
}

TEST(AskingThePanel, NeedsTheRoleTheLeaseAndAKnownName) {
    Asked a(two_axes());
    a.at(0.1, nobody, "status", json::object(), refused(401, "needs the role observe"));
    a.at(0.1, eve, "enable", {{"on", true}}, refused(403, "eve has the role observe"));
    a.at(0.1, bert, "enable", {{"on", true}}, refused(409, ""));
    a.at(0.1, bert, "set_wire", {{"name", "estop"}, {"value", 0}}, refused(403, "needs the role maintain"));
    a.at(0.1, anna, "fly", json::object(), refused(404, "Unknown command or query 'fly'"));
    a.at(0.1, anna, "invite", {{"role", "observe"}}, refused(409, "invite is not available"));
    a.run(0.3);
    EXPECT_EQ(a.machine->state(), operate::MachineState::disabled);
}

TEST(AskingThePanel, ChecksFieldsWithASentence) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.at(0.2, anna, "jog", {{"axis", "X"}}, refused(400, "speed is missing"));
    a.at(0.2, anna, "jog", {{"axis", "X"}, {"speed", "fast"}}, refused(400, "must be a number"));
    a.at(0.2, anna, "jog", {{"axis", "X"}, {"speed", 1e9}}, refused(400, "it must be"));
    a.at(0.2, anna, "jog", {{"axis", "X"}, {"speed", std::nan("")}}, refused(400, "speed"));
    a.at(0.2, anna, "jog", {{"axis", "X"}, {"speed", 1}, {"sped", 1}}, refused(400, "no field 'sped'"));
    a.at(0.2, anna, "jog", json::array(), refused(400, "must be a JSON object"));
    a.at(0.2, anna, "set_clock", {{"mode", "backwards"}}, refused(400, "one of real|unthrottled|paused"));
    a.at(0.2, anna, "acknowledge_alarm", {{"alarm", 1.5}}, refused(400, "whole number"));
    a.at(0.2, anna, "scope_arm", {{"channels", {"estop", 3}}}, refused(400, "list of texts"));
    a.at(0.2, anna, "enable", {{"on", 1}}, refused(400, "true or false"));
    a.run(0.4);
}

TEST(Operator, EnablesJogsAndRunsAProgram) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    for (int i = 0; i < 10; ++i) a.good(0.3 + 0.1 * i, "jog", {{"axis", "X"}, {"speed", 10}});
    a.good(1.3, "jog_stop");
    a.at(2, [&] { EXPECT_GT(a.x(), 18); });
    a.good(2.1, "jog_by", {{"axis", "Y"}, {"distance", 5}, {"speed", 20}});
    a.good(3.5, "start_program", {{"name", "p.ngc"}, {"text", "G21 G90 F1200\nG1 X30\nG1 X40 Y10\nM2\n"}});
    a.good(3.6, "hold");
    a.at(3.7, eve, "path");  // answered after the plan
    a.at(4.5, anna, "status", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["status"]["state"], "hold");
        EXPECT_TRUE(answer.body["status"]["program"]["remaining_s"].is_number());
    });
    a.good(4.6, "resume");
    a.at(9, anna, "program", json::object(), [](const Answer& answer) { EXPECT_EQ(answer.body["name"], "p.ngc"); });
    a.run(10);
    EXPECT_NEAR(a.x(), 40, 0.01);
    EXPECT_EQ(a.machine->state(), operate::MachineState::standstill);
}

TEST(Operator, StopsEverythingWithoutAnyRole) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "mdi", {{"text", "G1 X200 F600"}});
    a.at(1, [&] { a.panel->stop(nobody); });
    a.run(2);
    EXPECT_LT(a.x(), 30);
    EXPECT_EQ(a.machine->state(), operate::MachineState::error_stop);
}

TEST(Operator, SetsSpeedsStepsZeroAndPositions) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "set_overrides", {{"feed", 0.5}});
    a.good(0.3, "set_single_block", {{"on", true}});
    a.good(0.4, "set_position", {{"axis", "X"}, {"position", 100}});
    a.good(0.6, "touch_off", {{"axis", "X"}, {"value", 5}});
    a.at(0.7, [&] { EXPECT_NEAR(a.machine->stream().interpreter().frame().offset[0], 95, 1e-9); });
    a.good(0.8, "set_single_block", {{"on", false}});
    a.good(0.9, "mdi", {{"text", "G1 X6 F600"}});
    a.at(0.9, anna, "mdi", {{"text", "G1 X"}}, refused(400, ""));
    a.run(3);
    EXPECT_DOUBLE_EQ(a.machine->status().feed_override, 0.5);
    EXPECT_NEAR(a.x(), 101, 0.01);
}

TEST(Operator, ReadsAnAlarmAcknowledgesItAndResets) {
    Asked a(two_axes());
    std::vector<std::string> kinds;
    a.panel->on_event([&](const Event& event) { kinds.push_back(event.kind); });
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "set_estop", {{"pressed", true}});
    a.at(0.5, eve, "status", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["status"]["state"], "error stop");
        EXPECT_TRUE(answer.body["status"]["estop"]["pressed"].get<bool>());
        EXPECT_EQ(answer.body["status"]["alarms"].size(), 1U);
    });
    a.good(0.6, "acknowledge_alarm", {{"alarm", 1}});
    a.at(0.6, anna, "acknowledge_alarm", {{"alarm", 7}}, refused(400, "no alarm 7"));
    a.good(0.7, "set_estop", {{"pressed", false}});
    a.good(0.8, "reset");
    a.at(0.9, eve, "events", {{"limit", 50}},
         [](const Answer& answer) { EXPECT_GT(answer.body["events"].size(), 5U); });
    a.run(1);
    EXPECT_EQ(a.machine->state(), operate::MachineState::standstill);
    EXPECT_THAT(kinds, testing::IsSupersetOf({"alarm", "state", "command"}));
}

/// A client that streams lines without reading answers would continue after the dropped lines.
TEST(Stop, OfAnotherUserEndsControlAndNamesThatUser) {
    Asked a(two_axes());
    std::vector<std::string> stops;
    a.panel->on_event([&](const Event& event) {
        if (event.kind == "stop") stops.push_back(event.data["who"].get<std::string>() + ": " + event.text);
    });
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "mdi", {{"text", "G1 X60 F1200"}});
    a.at(0.6, bert, "stop");
    a.at(0.6, anna, "mdi", {{"text", "G1 X0 F1200"}}, refused(409, "Take control first"));
    a.at(0.8, eve, "status", json::object(), [](const Answer& answer) {
        EXPECT_EQ(answer.body["status"]["reason"],
                  "STOP by bert: line 1 was stopped. Reset, then start again. The positions are kept.");
    });
    a.at(1, anna, "mdi", {{"text", "G1 X0 F1200"}}, refused(409, "Take control first"));
    a.good(1.2, "take_control");
    a.good(1.3, "reset");
    a.good(1.4, "stop");
    a.good(1.5, "reset");
    a.good(1.6, "mdi", {{"text", "G1 X60 F1200"}});
    a.run(2);
    // A reset at standstill releases.
    EXPECT_THAT(stops, testing::ElementsAre("bert: STOP by bert: line 1 was stopped.",
                                            "anna: STOP by anna: the machine was in state 'standstill'.",
                                            testing::HasSubstr(": Shutdown")));
}

TEST(Control, IsTakenOverInAHold) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.3, "mdi", {{"text", "G1 X60 F1200"}});
    a.good(0.6, "hold");
    a.at(1, bert, "take_control", json::object(), refused(409, "anna"));
    a.at(1.1, bert, "take_control", {{"force", true}}, [](const Answer& answer) { EXPECT_EQ(answer.status, 200); });
    a.at(1.2, anna, "resume", json::object(), refused(409, "bert"));
    a.at(1.3, bert, "resume", json::object(), [](const Answer& answer) { EXPECT_EQ(answer.status, 200); });
    a.run(6);
    EXPECT_NEAR(a.x(), 60, 1e-3);
}

TEST(Control, IsTransferredOnlyByForceAndAtStandstill) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.at(0.2, bert, "take_control", json::object(), refused(409, "anna"));
    a.good(0.3, "enable", {{"on", true}});
    a.good(0.4, "mdi", {{"text", "G1 X60 F1200"}});
    a.at(0.6, bert, "take_control", {{"force", true}}, refused(409, ""));
    a.at(5, bert, "take_control", {{"force", true}}, [](const Answer& answer) { EXPECT_EQ(answer.status, 200); });
    a.at(5.1, anna, "jog", {{"axis", "X"}, {"speed", 1}}, refused(409, "bert"));
    a.at(5.2, eve, "control", json::object(),
         [](const Answer& answer) { EXPECT_EQ(answer.body["holder_session"], session_mark("w2")); });
    a.at(5.3, bert, "release_control");
    a.run(5.5);
    EXPECT_FALSE(a.lease.holder());
}

TEST(ManualCardAccess, AreReadAndWrittenAtStandstillOnly) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.at(0.2, anna, "read_register", {{"card", "m"}, {"bits", 16}, {"address", 0}},
         [](const Answer& answer) { EXPECT_TRUE(answer.body["value"].is_number()) << answer.body; });
    a.at(0.3, anna, "read_register", {{"card", "m"}, {"bits", 32}, {"address", 0}}, refused(409, "not of 32"));
    a.at(0.3, anna, "read_register", {{"card", "q"}, {"bits", 16}, {"address", 0}}, refused(400, "Unknown card"));
    a.good(0.4, "enable", {{"on", true}});
    a.good(0.5, "mdi", {{"text", "G1 X30 F600"}});
    a.at(0.8, anna, "write_register", {{"card", "m"}, {"bits", 16}, {"address", 0}, {"value", 0}},
         refused(409, "state 'moving'"));
    a.at(4, [&] { EXPECT_TRUE(a.machine->status().axes[0].position_valid); });
    a.at(4.1, anna, "write_register", {{"card", "m"}, {"bits", 16}, {"address", 0}, {"value", 0x0F00}},
         [](const Answer& answer) { EXPECT_EQ(answer.status, 200) << answer.body; });
    a.run(4.5);
    EXPECT_FALSE(a.machine->status().axes[0].position_valid);
}

TEST(ManualCardAccess, AnIoflex02IsCalibratedWhileItsAxisMoves) {
    Asked a(
        config_of("[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n"
                  "[card.glass]\ntype = \"ioflex02\"\nbase_address = 0x2300\npreloaded = true\n"
                  "[wires]\n\"glass.a0\" = \"X.enc_a\"\n\"glass.b0\" = \"X.enc_b\"\n"));
    const auto position = [&] { return a.machine->rack().card("glass")->inspect("0.POSITION").value_or(-1); };
    // Register CMD: cRes (position 0 at once) for axis 0; the pending calibrations of the other axes continue.
    const json zeroed = {{"card", "glass"}, {"bits", 16}, {"address", 0x2312}, {"value", 0x0E01}};
    std::int64_t before = 0, after = 0, later = 0;
    a.good(0.1, "take_control");
    a.good(0.2, "enable", {{"on", true}});
    a.good(0.5, "mdi", {{"text", "G1 X30 F600"}});
    a.at(1.5, [&] { before = position(); });
    a.good(1.6, "write_register", zeroed);
    a.at(1.7, [&] { after = position(); });
    a.at(2.2, [&] { later = position(); });
    a.run(5);
    // 10 mm/s at 800 counts per mm: 8000 counts/s.
    EXPECT_GT(before, 4'000);
    EXPECT_GT(after, 0);
    EXPECT_LT(after, 1'700) << "it counts from 0 again";
    EXPECT_NEAR(static_cast<double>(later - after), 4'000, 400) << "and the motion goes on";
    EXPECT_NEAR(a.x(), 30, 1e-6);
}

TEST(ManualCardAccess, HaveWiresAndFaults) {
    Asked a(two_axes());
    a.good(0.1, "take_control");
    a.good(0.2, "set_wire", {{"name", "m.xin0"}, {"value", 0}});
    a.at(0.3, [&] { EXPECT_EQ(*a.machine->wires().get("m.xin0"), 0); });
    a.good(0.4, "set_wire", {{"name", "m.xin0"}, {"value", nullptr}});
    a.at(0.5, anna, "set_wire", {{"name", "m.xpp"}, {"value", 1}}, refused(409, "output"));
    a.good(0.6, "inject_fault", {{"target", "X"}, {"fault", "encoder.broken_a"}});
    a.at(0.7, anna, "inject_fault", {{"target", "X"}, {"fault", "sulks"}}, refused(400, "no fault"));
    a.at(0.7, anna, "set_clock", {{"mode", "paused"}}, refused(409, "clock"));
    a.run(1);
}

TEST(Tables, DescribeEveryCommandAndQueryInOpenApiAndOnThePage) {
    const json& api = Panel::openapi();
    const std::string page = api_reference();
    std::set<std::string_view> names;
    for (const auto table : {commands(), queries()})
        for (const OperationSpec& row : table) {
            EXPECT_TRUE(names.insert(row.name).second) << row.name << " is there twice";
            EXPECT_TRUE(api["paths"].contains("/api/" + std::string(row.name)));
            EXPECT_THAT(page, HasSubstr("### " + std::string(row.name) + "\n"));
            EXPECT_EQ(row.text.back(), '.') << row.name;
        }
}

TEST(Tables, AreThePageOfTheReference) {
    EXPECT_EQ(text_of_file("docs/reference/api.md"), api_reference())
        << "make it anew: motionrack describe api --markdown > docs/reference/api.md";
}

TEST(Fuzzer, FindsNothingInItsSeeds) {
    int seeds = 0;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/tests/fuzz/corpus/panel")) {
        EXPECT_EQ(fuzz::check_orders(text_of_file("tests/fuzz/corpus/panel/" + entry.path().filename().string())), "")
            << entry.path();
        ++seeds;
    }
    EXPECT_GT(seeds, 4);
}

/// Generates any JSON, three levels deep at most.
rc::Gen<json> any_json(int depth = 3) {
    const auto leaf =
        rc::gen::oneOf(rc::gen::map(rc::gen::arbitrary<double>(), [](double v) { return json(v); }),
                       rc::gen::map(rc::gen::arbitrary<std::int64_t>(), [](std::int64_t v) { return json(v); }),
                       rc::gen::map(rc::gen::arbitrary<bool>(), [](bool v) { return json(v); }), rc::gen::just(json()),
                       rc::gen::map(rc::gen::container<std::string>(rc::gen::inRange('\x20', '\x7f')),
                                    [](const std::string& v) { return json(v); }),
                       rc::gen::element(json("X"), json("m"), json(std::nan("")), json(1e308), json(-1), json("estop"),
                                        json("m.xin0")));
    if (depth == 0) return leaf;
    return rc::gen::oneOf(leaf, rc::gen::map(rc::gen::resize(4, rc::gen::container<std::vector<json>>(rc::gen::lazy(
                                                                    [depth] { return any_json(depth - 1); }))),
                                             [](const std::vector<json>& v) { return json(v); }));
}

struct Question {
    std::string name;
    json fields;
};

/// Returns a random request of a client without control.
Question any_question() {
    std::vector<const OperationSpec*> rows;
    for (const auto table : {commands(), queries()})
        for (const OperationSpec& row : table)
            if (row.name != "take_control" && row.name != "set_estop") rows.push_back(&row);
    const OperationSpec& row = **rc::gen::elementOf(rows);
    Question out{std::string(row.name), json::object()};
    for (const FieldSpec& field : row.fields)
        if (*rc::gen::inRange(0, 6) > 0) out.fields[std::string(field.name)] = *any_json();
    if (*rc::gen::inRange(0, 8) == 0) out.fields["more"] = *any_json();
    if (*rc::gen::inRange(0, 20) == 0) out.fields = *any_json();
    return out;
}

RC_GTEST_PROP(AskingThePanel, AnswersAnyJsonWithASentenceAndMovesNothing, ()) {
    const auto questions = *rc::gen::container<std::vector<Question>>(30, rc::gen::exec(any_question));
    Asked a(two_axes());
    std::size_t answers = 0;
    for (std::size_t i = 0; i < questions.size(); ++i)
        a.at(0.01 * static_cast<double>(i + 1), bert, questions[i].name, questions[i].fields,
             [&](const Answer& answer) {
                 ++answers;
                 EXPECT_NE(answer.body.contains("done"), answer.body.contains("error"));
                 if (answer.status != 200) {
                     EXPECT_GT(message(answer).size(), 10U);
                 }
             });
    a.run(0.5);
    RC_ASSERT(answers == questions.size());
    RC_ASSERT(a.x() == 10);
    const operate::MachineState state = a.machine->state();
    // Any client may stop the machine.
    RC_ASSERT(state == operate::MachineState::disabled || state == operate::MachineState::error_stop);
}

}  // namespace
}  // namespace motionrack::panel
