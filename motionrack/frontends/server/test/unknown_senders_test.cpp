// Unauthenticated clients: limits of their connections and audit entries; STOP is executed in spite of them.
#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <atomic>
#include <list>
#include <motionrack/frontends/server/connection_slots.hpp>
#include <motionrack/frontends/server/origin_policy.hpp>
#include <motionrack/frontends/server/unknown_sender_log.hpp>

#include "flood.hpp"
#include "running.hpp"

namespace motionrack::server {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using namespace std::chrono_literals;

// ---- connection slots

struct Someone final : OpenConnection {
    void end(std::string_view) override { ended = true; }
    bool ended = false;
};

Limits few() {
    Limits limits;
    limits.callers = 4;
    limits.connections = 5;
    limits.of_a_network = 3;
    return limits;
}

TEST(ConnectionSlots, CloseTheOldestConnectionOfTheNetworkWithTheMost) {
    Limits limits = few();
    limits.callers = 16;
    ConnectionSlots open_connections(limits);
    Someone lone;
    std::list<Someone> flood;
    open_connections.arrive(&lone, "lone");
    for (int i = 0; i < 40; ++i) open_connections.arrive(&flood.emplace_back(), "flood");
    EXPECT_FALSE(lone.ended);
    EXPECT_EQ(open_connections.callers(), limits.callers);
    int at = 0;
    for (const Someone& one : flood) EXPECT_EQ(one.ended, at++ < 25) << at;
}

TEST(ConnectionSlots, KeepRecentConnections) {
    Limits limits = few();
    limits.callers = 16;
    ConnectionSlots open_connections(limits);
    std::list<Someone> others;
    Someone stop;
    for (int i = 0; i < 14; ++i) open_connections.arrive(&others.emplace_back(), std::to_string(i));
    open_connections.arrive(&others.emplace_back(), "here");
    open_connections.arrive(&stop, "here");
    for (int i = 0; i < 11; ++i) {
        open_connections.arrive(&others.emplace_back(), "here");
        EXPECT_FALSE(stop.ended) << "what it has sent may not have been read";
    }
}

TEST(ConnectionSlots, CloseTheOldestConnectionIfEachNetworkHasOne) {
    const Limits limits = few();
    ConnectionSlots open_connections(limits);
    std::list<Someone> all;
    for (int i = 9; i >= 0; --i) open_connections.arrive(&all.emplace_back(), std::to_string(i));
    int at = 0;
    for (const Someone& one : all) EXPECT_EQ(one.ended, at++ < 6) << at;
}

TEST(ConnectionSlots, AreSharedByNetworks) {
    const Limits limits = few();
    ConnectionSlots open_connections(limits);
    std::list<Someone> all;
    const auto come = [&](const std::string& network) {
        Someone& one = all.emplace_back();
        open_connections.arrive(&one, network);
        return open_connections.take_slot(&one, network);
    };
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(come("a"));
    EXPECT_FALSE(come("a")) << "its share";
    EXPECT_TRUE(come("b"));
    EXPECT_TRUE(come("b"));
    EXPECT_FALSE(come("c")) << "all are taken";
    EXPECT_EQ(open_connections.callers(), 2u) << "they go on as callers";
    EXPECT_TRUE(open_connections.take_slot(&all.front(), "a")) << "it has one";
    Someone stream;
    open_connections.replace(&all.front(), &stream);
    open_connections.leave(&all.front());
    EXPECT_FALSE(come("a"));
    open_connections.leave(&stream);
    EXPECT_TRUE(come("a"));
}

TEST(Networks, AreAnIpv4AddressOr64BitsOfIpv6) {
    EXPECT_EQ(network_of("192.0.2.7"), "192.0.2.7");
    EXPECT_EQ(network_of("2001:db8:0:1:2:3:4:5"), "2001:db8:0:1::/64");
    EXPECT_EQ(network_of("::1"), "::/64");
}

// ---- the audit

TEST(UnknownSenderLog, LogsAFewLinesAndCountsTheOthers) {
    std::vector<AuditEntry> lines;
    UnknownSenderLog log([&](const AuditEntry& entry) { lines.push_back(entry); });
    UnknownSenderLog::Time now{};
    for (int i = 0; i < 60'000; ++i, now += 1ms) {
        log.add({"", "192.0.2.7", "pair", 403, "Not paired."}, "192.0.2.7", now);
        log.tick(now);
    }
    EXPECT_LE(lines.size(), 27u);
    log.tick(now);
    log.tick(now += 60s);
    EXPECT_LE(lines.size(), 28u);
    EXPECT_THAT(lines.back().outcome, testing::AllOf(HasSubstr("more within 60 s"), HasSubstr("Not paired.")));
}

TEST(UnknownSenderLog, IsNotFloodedByManyNetworks) {
    std::size_t lines = 0;
    UnknownSenderLog log([&](const AuditEntry&) { ++lines; });
    UnknownSenderLog::Time now{};
    for (int i = 0; i < 3'600'000; i += 10, now += 10ms) {
        const std::string address = "2001:db8:0:" + std::to_string(i % 9999) + "::/64";
        log.add({"", address, "pair", 403, "Not paired."}, address, now);
        log.tick(now);
    }
    EXPECT_LT(lines, 5'000u) << "within an hour";
    EXPECT_GT(lines, 3'000u);
}

// ---- requests

TEST(UnknownSender, PairsWithAShortNameOnly) {
    Running running;
    const WebAnswer answer =
        running.client().ask("POST", "/api/pair", "{\"code\":\"A\",\"name\":\"" + std::string(60'000, 'x') + "\"}");
    EXPECT_EQ(answer.status, 413);
    EXPECT_THAT(answer.message(), HasSubstr("1024 bytes"));
    EXPECT_EQ(
        running.client().ask("POST", "/api/pair", "{\"code\":\"A\",\"name\":\"" + std::string(900, 'x') + "\"}").status,
        403);
    const std::lock_guard<std::mutex> alone(running.lock);
    ASSERT_EQ(running.audit.size(), 1u);
    EXPECT_EQ(running.audit[0].user, "");
}

TEST(UnknownSender, SendsShortMessagesOnly) {
    Running running([](ServerSettings& settings) { settings.loopback_role = auth::Role::none; });
    WebClient client = running.client();
    ASSERT_EQ(client.upgrade().status, 101);
    client.send_frame(1, std::string(5'000, 'x'));
    for (;;) {
        const WebFrame frame = client.receive();
        if (frame.kind == 1) continue;
        EXPECT_EQ(frame.code, 1009);
        break;
    }
}

TEST(UnknownSender, ChecksProgramsUpToTheLengthOfOtherBodiesOnly) {
    std::string program;
    for (int i = 0; i < 1000; ++i) program += "(" + std::string(70, '.') + ")\n";
    const std::string longer = json{{"text", program}}.dump(), shorter = json{{"text", program.substr(0, 7300)}}.dump();
    Running running;
    EXPECT_EQ(running.client().ask("POST", "/api/check", shorter).status, 200);
    const WebAnswer refused = running.client().ask("POST", "/api/check", longer);
    EXPECT_EQ(refused.status, 413);
    EXPECT_THAT(refused.message(), HasSubstr("65536 bytes"));
    const std::string bearer = "Authorization: Bearer " + running.token("anna", auth::Role::observe) + "\r\n";
    EXPECT_EQ(running.client().ask("POST", "/api/check", longer, bearer).status, 200);
    Running open([](ServerSettings& settings) { settings.loopback_role = auth::Role::maintain; });
    EXPECT_EQ(open.client().ask("POST", "/api/check", longer).status, 200) << "without authentication";
}

TEST(UnknownSender, ChecksProgramsWithinTheAuditOfStrangers) {
    const auto entries = [](auth::Role without_token) {
        std::atomic<int> passed = 0;
        Running running([&](ServerSettings& settings) {
            settings.loopback_role = without_token;
            settings.clock = [&] {
                const auto later = passed.load() * 1500ms;
                return auth::Timestamps{std::chrono::system_clock::now() + later,
                                        std::chrono::steady_clock::now() + later};
            };
        });
        WebClient client = running.client();
        for (; passed < 100; ++passed) EXPECT_EQ(client.ask("POST", "/api/check", R"({"text":"G0 X1\n"})").status, 200);
        const std::lock_guard<std::mutex> alone(running.lock);
        return running.audit.size();
    };
    EXPECT_LT(entries(auth::Role::observe), 50u) << "20 at once, one in 10 s, and a line a minute";
    EXPECT_EQ(entries(auth::Role::maintain), 100u) << "without authentication";
}

TEST(Token, IsInvalidOnceItsBrowserIsRemoved) {
    Running running;
    const std::string bearer = "Authorization: Bearer " + running.token("anna") + "\r\n";
    EXPECT_EQ(running.client().ask("GET", "/api/forget", "", bearer).status, 405);
    EXPECT_EQ(running.client().ask("POST", "/api/forget").status, 401);
    EXPECT_EQ(running.client().ask("GET", "/api/users", "", bearer).status, 200);
    EXPECT_EQ(running.client().ask("POST", "/api/forget", "{}", bearer).status, 200);
    EXPECT_EQ(running.client().ask("GET", "/api/users", "", bearer).status, 401);
    EXPECT_EQ(running.client().ask("POST", "/api/forget", "{}", bearer).status, 401);
    EXPECT_TRUE(running.audited("forget", 200));
    EXPECT_TRUE(running.served->door().users().empty());
}

// ---- STOP

TEST(Stop, IsExecutedInAFloodOfConnections) {
    Running running;
    for (const Flood::Address from : {Flood::Address::another, Flood::Address::the_same})
        for (const std::size_t held : {0u, 400u}) {
            const Flood flood(running.port(), held, from);
            expect_stops_heard(flood, fmt::format("{} connections held", held),
                               [&] { return running.client().ask("POST", "/api/stop").status; });
        }
}

TEST(Stop, HasAReservedDescriptorWhenAllOthersAreInUse) {
    Running running;
    EXPECT_EQ(running.client().ask("GET", "/api/status").status, 200);
    const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const timeval half_a_minute{30, 0};
    ::setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &half_a_minute, sizeof half_a_minute);
    rlimit before = {};
    ::getrlimit(RLIMIT_NOFILE, &before);
    const rlimit now{400, before.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &now);
    std::vector<int> files;
    for (int file = 0; (file = ::open("/dev/null", O_RDONLY | O_CLOEXEC)) >= 0;) files.push_back(file);
    EXPECT_EQ(errno, EMFILE);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(running.port());
    EXPECT_EQ(::connect(client, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    const std::string request = "POST /api/stop HTTP/1.1\r\nHost: localhost\r\n\r\n";
    EXPECT_EQ(::send(client, request.data(), request.size(), MSG_NOSIGNAL), static_cast<ssize_t>(request.size()));
    std::array<char, 12> answer{};
    EXPECT_EQ(::recv(client, answer.data(), answer.size(), MSG_WAITALL), static_cast<ssize_t>(answer.size()));
    EXPECT_EQ(std::string(answer.data(), answer.size()), "HTTP/1.1 200");
    for (const int file : files) ::close(file);
    ::close(client);
    ::setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_TRUE(running.audited("stop", 200));
}

}  // namespace
}  // namespace motionrack::server
