// Misbehaving clients: malformed, too large and too many requests; the motion must be unaffected.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <list>

#include "running.hpp"

namespace motionrack::server {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(HostileRequest, IsRefusedWithAReason) {
    Running running;
    struct Case {
        const char* text;
        int status;
    };
    const std::string long_head = "GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(9000, 'x') + "\r\n\r\n";
    const std::string long_line = "GET /" + std::string(9000, 'x') + " HTTP/1.1\r\n\r\n";
    for (const Case& one :
         {Case{"\r\n\r\n\r\n", 400}, Case{"HELLO\r\n\r\n", 400}, Case{"GET / HTTP/9.9\r\n\r\n", 400},
          Case{"GET / HTTP/1.1\r\nHost localhost\r\n\r\n", 400},
          Case{"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: x\r\n\r\n", 400},
          Case{"POST /api/pair HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n", 400},
          Case{"POST /api/pair HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n", 400},
          Case{"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 400}, Case{"GET / HTTP/1.1\r\n\r\n", 403},
          Case{"GET / HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n", 403}, Case{long_head.c_str(), 431},
          Case{long_line.c_str(), 431}, Case{"BREW / HTTP/1.1\r\nHost: localhost\r\n\r\n", 405},
          Case{"POST /api/pair HTTP/1.1\r\nHost: localhost\r\nContent-Length: 999999999999\r\n\r\n", 413}}) {
        WebClient client = running.client();
        client.send(one.text);
        const WebAnswer answer = client.answer();
        EXPECT_EQ(answer.status, one.status) << one.text;
        EXPECT_NE(answer.message(), "") << one.text;
    }
    EXPECT_EQ(running.client().ask("GET", "/api/status").status, 200);
}

TEST(HostileRequest, ThatIsTooLongIsRejectedWhileItIsReceived) {
    Running running;
    WebClient client = running.client();
    const WebAnswer answer = client.ask("POST", "/api/pair", std::string(2'000'000, ' '));
    EXPECT_EQ(answer.status, 413);
    EXPECT_THAT(answer.message(), HasSubstr("1024 bytes"));
    WebClient chunked = running.client();
    std::string text = "POST /api/pair HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
    for (int i = 0; i < 20; ++i) text += "2000\r\n" + std::string(0x2000, ' ') + "\r\n";
    chunked.send(text);
    EXPECT_EQ(chunked.answer().status, 413);
}

TEST(HostileRequest, ThatDoesNotEndIsClosedByTheServer) {
    Running running([](ServerSettings& settings) {
        settings.limits.header = settings.limits.body = settings.limits.idle = std::chrono::milliseconds(20);
    });
    WebClient silent = running.client(), slow = running.client(), half = running.client(), idle = running.client();
    slow.send("GET / HT");
    half.send("POST /api/pair HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\n{");
    EXPECT_EQ(idle.ask("GET", "/api/status").status, 200);
    EXPECT_TRUE(silent.ended());
    EXPECT_TRUE(slow.ended());
    EXPECT_TRUE(half.ended());
    EXPECT_TRUE(idle.ended());
}

TEST(HostileRequest, IsRejectedAboveTheRateLimitExceptStop) {
    Running running([](ServerSettings& settings) {
        settings.limits.requests_at_once = 5;
        settings.limits.requests_per_second = 1e-6;
    });
    WebClient client = running.client();
    for (int i = 0; i < 5; ++i) EXPECT_EQ(client.ask("GET", "/api/status").status, 200);
    const WebAnswer refused = client.ask("GET", "/api/status");
    EXPECT_EQ(refused.status, 429);
    EXPECT_EQ(refused.fields.at("retry-after"), "1");
    EXPECT_EQ(running.client().upgrade().status, 429);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(client.ask("POST", "/api/stop").status, 200);
}

TEST(HostileStream, IsRefusedOrEndedWithAReason) {
    Running running;
    const auto code_after = [&](const std::function<void(WebClient&)>& offend) {
        WebClient client = running.stream("");
        offend(client);
        for (;;) {
            const WebFrame frame = client.receive();
            if (frame.kind != 1) return frame.code;
        }
    };
    EXPECT_EQ(code_after([](WebClient& c) { c.send_frame(1, std::string(65'537, 'x')); }), 1009) << "too long";
    EXPECT_EQ(code_after([](WebClient& c) {
                  for (int i = 0; i < 20; ++i) c.send_frame(i == 0 ? 1 : 0, std::string(8'000, 'x'), true, false);
              }),
              1009)
        << "too long in pieces";
    EXPECT_EQ(code_after([](WebClient& c) { c.send_frame(1, "\xff\xfe"); }), 1007) << "no UTF-8";
    EXPECT_EQ(code_after([](WebClient& c) { c.send_frame(1, "{}", false); }), 1002) << "not masked";
    EXPECT_EQ(code_after([](WebClient& c) { c.send_frame(3, "{}"); }), 1002) << "no such kind";
    EXPECT_EQ(code_after([](WebClient& c) { c.send_frame(0, "{}"); }), 1002) << "goes on with nothing";
    WebClient binary = running.stream("");
    binary.send_frame(2, "\x01\x02");
    EXPECT_THAT(
        binary.receive_until([](const json& m) { return m.contains("error"); })["error"]["message"].get<std::string>(),
        HasSubstr("binary"));
    EXPECT_EQ(running.client().upgrade("", "/api/other").status, 404);
    EXPECT_EQ(running.client()
                  .ask("GET", "/api/stream", "",
                       "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 12\r\nSec-WebSocket-Key: "
                       "AAAAAAAAAAAAAAAAAAAAAA==\r\n")
                  .status,
              426);
}

TEST(HostileStream, WithAnInvalidHandshakeIsRejectedWithAMessage) {
    const Running running;
    const std::string head =
        "GET /api/stream HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n";
    const std::string version = "Sec-WebSocket-Version: 13\r\n", name = "Sec-WebSocket-Key: ";
    const std::string key = name + "AAAAAAAAAAAAAAAAAAAAAA==\r\n";
    struct Case {
        std::string fields;
        int status;
        const char* says;
    };
    for (const Case& one : {Case{key + "\r\n", 426, "version \"\""},
                            {key + "Sec-WebSocket-Version: 12\r\n\r\n", 426, "version \"12\""},
                            {version + "\r\n", 400, "Sec-WebSocket-Key \"\""},
                            {version + name + "AAAA\r\n\r\n", 400, "16 bytes in base64"},
                            {version + key + key + "\r\n", 400, "Sec-WebSocket-Key \"\""},
                            {version + version + key + "\r\n", 426, "version \"\""},
                            {version + name + "AAAAAAAAAAAAAAAAAAAAAAAA\r\n\r\n", 400, "16 bytes in base64"},
                            {version + name + "AAAAAAAAAAAAA*AAAAAAAA==\r\n\r\n", 400, "16 bytes in base64"},
                            {version + name + std::string(100, 'A') + "\r\n\r\n", 400, "16 bytes in base64"},
                            {version + key + "Content-Length: 2\r\n\r\n{}", 400, "Bytes follow the handshake"},
                            {version + key + "\r\n\x81\x80rack", 400, "Bytes follow the handshake"}}) {
        WebClient client = running.client();
        client.send(head + one.fields);
        const WebAnswer answer = client.answer();
        EXPECT_EQ(answer.status, one.status) << one.fields;
        EXPECT_THAT(answer.message(), HasSubstr(one.says)) << one.fields;
        EXPECT_THAT(answer.message(), HasSubstr("No WebSocket was opened")) << one.fields;
        EXPECT_EQ(answer.fields.at("content-type"), "application/json") << one.fields;
        EXPECT_EQ(answer.fields.count("sec-websocket-version"), one.status == 426 ? 1u : 0u) << one.fields;
        EXPECT_TRUE(client.ended());
    }
    WebClient client = running.client();
    client.send(head + version + key + "\r\n");
    EXPECT_EQ(client.answer().status, 101);
}

TEST(HostileStream, ThatSendsTooMuchIsRejectedButItsStopIsExecuted) {
    Running running([](ServerSettings& settings) {
        settings.limits.messages_at_once = 3;
        settings.limits.messages_per_second = 1e-6;
    });
    WebClient client = running.client();
    ASSERT_EQ(client.upgrade().status, 101);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(client.exchange({{"query", "status"}}).value("done", false));
    client.say({{"id", 1}, {"query", "status"}});
    const json refused = client.receive_until([](const json& m) { return m.contains("error"); });
    EXPECT_EQ(refused["error"]["kind"], "limit");
    EXPECT_TRUE(client.exchange({{"command", "stop"}}).value("done", false));
}

TEST(HostileStream, AboveTheRateLimitOfItsAddressIsRejected) {
    Running running([](ServerSettings& settings) {
        settings.limits.requests_at_once = 4;
        settings.limits.requests_per_second = 1e-6;
    });
    WebClient one = running.client(), other = running.client();
    ASSERT_EQ(one.upgrade().status, 101);
    ASSERT_EQ(other.upgrade().status, 101);
    for (WebClient* client : {&one, &other, &one, &other})
        EXPECT_TRUE(client->exchange({{"query", "status"}}).value("done", false));
    EXPECT_EQ(other.exchange({{"query", "status"}})["error"]["kind"], "limit");
    EXPECT_TRUE(one.exchange({{"command", "stop"}}).value("done", false));
}

TEST(HostileStream, ThatReadsNoAnswersIsClosed) {
    Running running([](ServerSettings& settings) { settings.limits.texts_waiting = 50; });
    WebClient client(running.port(), false, true);
    ASSERT_EQ(client.upgrade().status, 101);
    for (int i = 0; i < 20'000; ++i) client.send_frame(1, "{\"id\":1,\"query\":\"nothing\"}");
    EXPECT_TRUE(client.ended());
    EXPECT_EQ(running.client().ask("GET", "/api/status").status, 200);
}

TEST(HostileStream, ThatReadsNothingIsClosedWithItsToken) {
    Running running([](ServerSettings& settings) {
        settings.limits.texts_waiting = 1'000'000;
        settings.limits.silence = std::chrono::hours(1);
        settings.limits.spare_time = std::chrono::milliseconds(20);
    });
    WebClient client(running.port(), false, true);
    ASSERT_EQ(client.upgrade().status, 101);
    ASSERT_TRUE(client.exchange({{"token", running.token("anna")}}).value("done", false));
    // More answers than the buffers of a connection take: a write is pending.
    for (int i = 0; i < 40'000; ++i) client.send_frame(1, "{\"id\":1,\"query\":\"nothing\"}");
    EXPECT_EQ(running.served->server().clients(), 1);
    EXPECT_TRUE(running.served->door().revoke("anna"));
    while (running.served->server().clients() > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(client.ended());
}

/// Holds `count` connections, each with different input.
std::list<WebClient> crowd(const Running& running, int count) {
    std::list<WebClient> out;
    for (int i = 0; i < count; ++i) {
        out.emplace_back(running.port());
        if (i % 3 == 0) out.back().send("GET /api/status HTTP/1.1\r\nHost: localhost\r\n\r\n");
        if (i % 3 == 1) out.back().send("GET /api/st");
    }
    return out;
}

std::vector<std::array<std::int64_t, 3>> path_of_the_job(int connections, int& refused) {
    Running running([](ServerSettings& settings) {
        settings.limits.spare_time = std::chrono::seconds(20);
        settings.limits.of_a_network = 200;
    });
    WebClient anna = running.master("anna");
    EXPECT_TRUE(anna.exchange({{"command", "start_program"}, {"name", "job"}, {"text", job()}}).value("done", false));
    std::list<WebClient> others = crowd(running, connections);
    anna.receive_until(job_is_over);
    int at = 0;
    for (WebClient& one : others) {
        if (at++ % 3 != 0) continue;
        const WebAnswer answer = one.answer();
        if (answer.status == 200) continue;
        EXPECT_EQ(answer.status, 503);
        EXPECT_NE(answer.message(), "");
        ++refused;
    }
    // All slots are occupied by connections that keep them: STOP is executed nevertheless.
    if (connections > 0) {
        EXPECT_EQ(running.client().ask("GET", "/api/status").status, 503);
        EXPECT_EQ(running.client().ask("POST", "/api/stop").status, 200);
    }
    return running.path();
}

TEST(ThousandConnections, AreRefusedAboveTheLimitAndDisturbNoMotion) {
    rlimit files = {};
    ::getrlimit(RLIMIT_NOFILE, &files);
    files.rlim_cur = std::min<rlim_t>(files.rlim_max, 8192);
    ::setrlimit(RLIMIT_NOFILE, &files);
    if (files.rlim_cur < 2500)
        GTEST_SKIP() << "this process may have " << files.rlim_cur << " files open; 2500 are needed";
    int refused = 0, none = 0;
    const auto crowded = path_of_the_job(1000, refused);
    EXPECT_GT(refused, 100);
    EXPECT_EQ(crowded, path_of_the_job(0, none));
    EXPECT_FALSE(crowded.empty());
}

}  // namespace
}  // namespace motionrack::server
