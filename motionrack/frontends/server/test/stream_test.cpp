// WebSocket clients: snapshots, commands, control, reloads.
#include <gmock/gmock.h>

#include <future>
#include <optional>
#include <tests/answer_delay.hpp>
#include <thread>

#include "running.hpp"

namespace motionrack::server {
namespace {

using auth::Role;
using nlohmann::json;
using testing::HasSubstr;

bool is_picture(const json& message) {
    return message.contains("seq");
}
std::string error_of(const json& answer) {
    return answer.contains("error") ? answer["error"]["message"].get<std::string>() : "";
}

TEST(StreamConnection, StartsWithHelloAndSendsSnapshots) {
    Running running;
    WebClient client = running.client();
    ASSERT_EQ(client.upgrade().status, 101);
    const json hello = json::parse(client.receive().text)["hello"];
    EXPECT_EQ(hello["rack"], "two");
    EXPECT_EQ(hello["boot"], "b007");
    EXPECT_EQ(hello["role"], "observe");
    EXPECT_TRUE(hello["simulation"]);
    const json first = client.receive_until(is_picture);
    EXPECT_EQ(first["status"]["state"], "disabled");
    EXPECT_TRUE(first["values"].empty());
    EXPECT_EQ(first["lost"].get<int>() + 1, first["seq"].get<int>());
    EXPECT_GT(client.receive_until(is_picture)["seq"], first["seq"]);
}

TEST(StreamConnection, SendsTheRequestedChannelsInTheirOrder) {
    Running running;
    WebClient client = running.stream("");
    EXPECT_TRUE(client.exchange({{"subscribe", {{"channels", {"X.commanded", "Y.commanded"}}, {"rate_hz", 100}}}})
                    .value("done", false));
    const json picture =
        client.receive_until([](const json& message) { return is_picture(message) && !message["values"].empty(); });
    EXPECT_EQ(picture["values"], json({0, 0}));
    EXPECT_THAT(error_of(client.exchange({{"subscribe", {{"channels", {"X.nothing"}}}}})), HasSubstr("X.nothing"));
    EXPECT_THAT(error_of(client.exchange({{"subscribe", {{"rate_hz", 101}}}})), HasSubstr("1 to 100"));
    EXPECT_THAT(
        error_of(client.exchange({{"subscribe", {{"channels", json(std::vector<std::string>(65, "X.commanded"))}}}})),
        HasSubstr("65 channels"));
    EXPECT_THAT(error_of(client.exchange({{"subscribe", {{"rates", 1}}}})), HasSubstr("accepts only"));
    EXPECT_THAT(error_of(client.exchange({{"subscribe", 1}})), HasSubstr("requires"));
    EXPECT_FALSE(client.receive_until(is_picture)["values"].empty()) << "what was refused changed nothing";
}

TEST(StreamConnection, SendsEventsToAllClients) {
    Running running;
    WebClient watcher = running.stream("");
    WebClient anna = running.master("anna");
    const json event = watcher.receive_until(
        [](const json& message) { return message.contains("event") && message["event"]["kind"] == "command"; });
    EXPECT_THAT(event["event"]["text"].get<std::string>(), HasSubstr("anna"));
}

TEST(StreamConnection, RefusesWithASentenceAndContinues) {
    Running running;
    WebClient client = running.stream(running.token("anna"));
    const auto refused = [&](const std::string& text) {
        client.send_frame(1, text);
        return error_of(client.receive_until([](const json& message) { return message.contains("error"); }));
    };
    EXPECT_THAT(refused("{"), HasSubstr("is not valid JSON"));
    EXPECT_THAT(refused("[]"), HasSubstr("is not a JSON object"));
    EXPECT_THAT(refused(std::string(1000, '[')), HasSubstr("nested deeper"));
    EXPECT_THAT(refused("{\"id\":1}"), HasSubstr("one of token, subscribe, command, query"));
    EXPECT_THAT(refused("{\"id\":{},\"command\":\"enable\"}"), HasSubstr("id of a message"));
    EXPECT_THAT(refused("{\"id\":1,\"command\":\"fly\"}"), HasSubstr("Unknown command 'fly'"));
    EXPECT_THAT(refused("{\"id\":1,\"command\":\"begin\"}"), HasSubstr("'begin' is now 'start_program'"));
    EXPECT_THAT(refused("{\"id\":1,\"order\":\"enable\",\"on\":true}"), HasSubstr("'order' is now 'command'"));
    EXPECT_THAT(refused("{\"id\":1,\"command\":\"status\"}"), HasSubstr("Unknown command 'status'"));
    EXPECT_THAT(refused("{\"id\":1,\"query\":\"enable\"}"), HasSubstr("Unknown query 'enable'. Nothing was done."));
    EXPECT_THAT(refused("{\"id\":1,\"command\":7}"), HasSubstr("one of token"));
    EXPECT_THAT(refused("{\"id\":1,\"command\":\"enable\",\"on\":true}"), HasSubstr("Take control first"));
    EXPECT_THAT(refused("{\"id\":1,\"token\":\"x\"}"), HasSubstr("not known"));
    EXPECT_TRUE(client.exchange({{"query", "status"}}).value("done", false));
}

TEST(StreamConnection, StopsUnderItsFormerNameToo) {
    Running running;
    WebClient client = running.master("anna");
    client.say({{"id", 1}, {"order", "stop"}});
    const json event = client.receive_until(
        [](const json& message) { return message.contains("event") && message["event"]["kind"] == "stop"; });
    EXPECT_THAT(event["event"]["text"].get<std::string>(), HasSubstr("anna"));
}

TEST(StreamConnection, AcceptsLongProgramsFromOperators) {
    Running running;
    WebClient anna = running.master("anna");
    std::string text = "(" + std::string(200'000, 'x') + ")\n" + job();
    for (std::size_t at = 100; at < 200'000; at += 100) text[at] = '\n', text[at - 1] = ')', text[at + 1] = '(';
    EXPECT_TRUE(anna.exchange({{"command", "start_program"}, {"name", "job"}, {"text", text}}).value("done", false));
    WebClient bert = running.stream(running.token("bert", Role::observe));
    bert.say({{"id", 1}, {"command", "start_program"}, {"name", "job"}, {"text", text}});
    WebFrame frame;
    do frame = bert.receive();
    while (frame.kind == 1);
    EXPECT_EQ(frame.code, 1009);
}

TEST(StreamConnection, HasOneControlHolderAtATime) {
    Running running;
    WebClient anna = running.master("anna");
    WebClient bert = running.stream(running.token("bert"));
    EXPECT_THAT(error_of(bert.exchange({{"command", "jog"}, {"axis", "X"}, {"speed", 5}})),
                HasSubstr("Control is with anna"));
    EXPECT_THAT(error_of(bert.exchange({{"command", "take_control"}})), HasSubstr("anna has it"));
    ASSERT_TRUE(anna.exchange({{"command", "start_program"}, {"name", "job"}, {"text", job()}}).value("done", false));
    EXPECT_THAT(error_of(bert.exchange({{"command", "take_control"}, {"force", true}})),
                HasSubstr("has it and the machine moves"));
    EXPECT_TRUE(bert.exchange({{"command", "hold"}}).value("done", false)) << "everybody who operates may hold";
    anna.receive_until([](const json& message) { return state_is(message, "hold"); });
    EXPECT_TRUE(anna.exchange({{"command", "stop"}}).value("done", false));
    anna.receive_until([](const json& message) { return state_is(message, "error stop"); });
    EXPECT_TRUE(bert.exchange({{"command", "take_control"}, {"force", true}}).value("done", false));
    EXPECT_THAT(error_of(anna.exchange({{"command", "enable"}, {"on", true}})), HasSubstr("Control is with bert"));
}

TEST(StreamConnection, EndsItsJogsWhenItCloses) {
    Running running({}, {}, whole_seconds(3600));
    WebClient watcher = running.stream("");
    {
        WebClient anna = running.master("anna");
        ASSERT_TRUE(
            anna.exchange({{"command", "jog"}, {"axis", "X"}, {"speed", 1}, {"sequence", 1}}).value("done", false));
        anna.receive_until([](const json& message) { return state_is(message, "jogging"); });
        { WebClient bert = running.stream(running.token("bert")); }  // closing another connection has no effect
        EXPECT_TRUE(anna.exchange({{"command", "jog"}, {"axis", "X"}, {"speed", 2}, {"sequence", 2}, {"renews", true}})
                        .value("done", false));
    }
    const json stood = watcher.receive_until([](const json& message) {
        return state_is(message, "standstill") && message["status"]["axes"][0]["commanded"] > 0;
    });
    EXPECT_LT(stood["status"]["axes"][0]["commanded"], 290) << "it stopped long before the end of its travel";
}

/// At least half of the jogs stop within 50 ms of the close, although their lease lasts an hour.
TEST(StreamConnection, EndsItsJogsWithin50MsOfItsClose) {
    Running running({}, {}, whole_seconds(3600));
    const std::string token = running.token("anna");
    operate::Machine& machine = running.served->machine();
    const auto state = [&machine] {
        std::promise<operate::MachineState> out;
        machine.post([&] { out.set_value(machine.state()); });
        return out.get_future().get();
    };
    test::AnswerDelays delays;
    for (int i = 0; i < 21; ++i) {
        std::optional<WebClient> anna;
        anna.emplace(running.stream(token));
        ASSERT_TRUE(anna->exchange({{"command", "take_control"}}).value("done", false));
        ASSERT_TRUE(anna->exchange({{"command", "enable"}, {"on", true}}).value("done", false));
        ASSERT_TRUE(anna->exchange({{"command", "jog"}, {"axis", "X"}, {"speed", 0.5}}).value("done", false));
        ASSERT_TRUE(anna->receive_until([](const json& message) { return state_is(message, "jogging"); }).is_object());
        delays.measure([&] {
            anna.reset();
            while (state() != operate::MachineState::standstill) std::this_thread::yield();
        });
    }
    delays.expect_in_time(0.5, "a jog whose connection closes");
}

TEST(StreamConnection, RejectsALateJogAndARenewalOfAnEndedOne) {
    Running running;
    WebClient anna = running.master("anna");
    const json jog = {{"command", "jog"}, {"axis", "X"}, {"speed", 1}};
    const auto with = [&](std::int64_t sequence, bool renews) {
        json out = jog;
        out["sequence"] = sequence;
        out["renews"] = renews;
        return error_of(anna.exchange(out));
    };
    EXPECT_THAT(with(1, true), HasSubstr("has ended"));
    EXPECT_EQ(with(2, false), "");
    EXPECT_TRUE(anna.exchange({{"command", "jog_stop"}, {"sequence", 7}}).value("done", false));
    EXPECT_THAT(with(6, false), HasSubstr("sequence 6, but 7 came before it"));
    EXPECT_TRUE(anna.exchange({{"command", "jog_stop"}, {"sequence", 3}}).value("done", false))
        << "a stop is never too old";
}

/// Client errors, while the machine runs a job and while it is stationary.
class StreamConnectionWhile : public testing::TestWithParam<bool> {
  protected:
    static bool moving() { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Machine, StreamConnectionWhile, testing::Bool(),
                         [](const auto& each) { return each.param ? "moving" : "standing"; });

/// Path of an undisturbed job.
std::vector<std::array<std::int64_t, 3>> quiet_path() {
    Running running;
    WebClient anna = running.master("anna");
    EXPECT_TRUE(anna.exchange({{"command", "start_program"}, {"name", "job"}, {"text", job()}}).value("done", false));
    anna.receive_until(job_is_over);
    return running.path();
}

TEST_P(StreamConnectionWhile, WhoseClientLeavesOrLoadsItsPageAgainChangesNothing) {
    Running running;
    const std::string token = running.token("anna");
    {
        WebClient anna = running.stream(token);
        ASSERT_TRUE(anna.exchange({{"command", "take_control"}}).value("done", false));
        ASSERT_TRUE(anna.exchange({{"command", "enable"}, {"on", true}}).value("done", false));
        if (moving()) {
            ASSERT_TRUE(
                anna.exchange({{"command", "start_program"}, {"name", "job"}, {"text", job()}}).value("done", false));
        }
    }
    WebClient again = running.stream(token);
    if (moving()) again.receive_until(job_is_over);
    EXPECT_TRUE(again.receive_until([](const json& message) { return state_is(message, "standstill"); }).is_object())
        << "it is still enabled";
    EXPECT_TRUE(again.exchange({{"command", "take_control"}}).value("done", false))
        << "control comes back without force";
    EXPECT_EQ(running.path(), moving() ? quiet_path() : decltype(quiet_path())());
}

TEST_P(StreamConnectionWhile, LosesSnapshotsOfASlowReaderOnly) {
    Running running;
    WebClient anna = running.master("anna");
    if (moving()) {
        ASSERT_TRUE(
            anna.exchange({{"command", "start_program"}, {"name", "job"}, {"text", job()}}).value("done", false));
    }
    WebClient slow(running.port(), false, true);
    ASSERT_EQ(slow.upgrade().status, 101);
    slow.say({{"id", 1}, {"subscribe", {{"rate_hz", 100}}}});
    WebClient quick = running.stream("");
    ASSERT_TRUE(quick.exchange({{"subscribe", {{"rate_hz", 100}}}}).value("done", false));
    // Until the slow client's buffers are certainly full, all others receive their snapshots.
    for (int i = 0; i < 400; ++i) ASSERT_TRUE(quick.receive_until(is_picture).is_object());
    std::int64_t lost = 0, before = 0;
    while (lost == 0) {
        const json picture = slow.receive_until(is_picture);
        ASSERT_TRUE(picture.is_object());
        lost = picture["lost"];
        EXPECT_EQ(picture["seq"].get<std::int64_t>(), before + lost + 1) << "the numbers tell what was lost";
        before = picture["seq"];
        if (before > 100'000) break;
    }
    EXPECT_GT(lost, 0);
}

TEST(StreamConnection, IsEndedWhenItsTokenIsRevoked) {
    Running running;
    WebClient anna = running.master("anna");
    WebClient bert = running.stream(running.token("bert", Role::operate));
    EXPECT_TRUE(anna.exchange({{"command", "revoke_user"}, {"user", "bert"}}).value("done", false));
    WebFrame frame;
    do frame = bert.receive();
    while (frame.kind == 1);
    EXPECT_EQ(frame.kind, 8);
    EXPECT_EQ(frame.code, 1008);
    EXPECT_THAT(frame.text, HasSubstr("pair again"));
}

TEST(StreamConnection, ReceivesACloseFrameWhenTheServerEnds) {
    Running running;
    WebClient client = running.stream("");
    running.served->server().stop();
    WebFrame frame;
    do frame = client.receive();
    while (frame.kind == 1);
    EXPECT_EQ(frame.kind, 8);
    EXPECT_EQ(frame.code, 1001);
}

}  // namespace
}  // namespace motionrack::server
