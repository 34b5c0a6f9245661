// A machine with its panel and a server that run during a test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <motionrack/frontends/server/served_rack.hpp>
#include <motionrack/rack/config.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <tests/invariants/watch.hpp>
#include <thread>
#include <vector>

#include "web_client.hpp"

namespace motionrack::server {

/// Two axes with valid positions, at 20 simulated seconds per second.
class Running {
  public:
    using Change = std::function<void(ServerSettings&)>;
    explicit Running(const Change& change = {}, Page page = {}, Duration jog_lease = milliseconds(250)) {
        const rack::RackReading reading = rack::read_rack_text(
            "[rack]\nname = \"two\"\n[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n"
            "[axis.Y]\ncard = \"m\"\nchannel = \"y\"\n");
        ServedSettings settings;
        settings.factor = 20;
        settings.version = "0.0.0";
        settings.boot = "b007";
        settings.machine.on_status = [this](const operate::Status& status) { observe(status); };
        settings.machine.jog_lease = jog_lease;
        settings.door.on_start_code = [](const std::string&) {};
        settings.page = std::move(page);
        settings.server.port = 0;
        settings.server.limits.requests_at_once = settings.server.limits.messages_at_once = 1e9;
        settings.server.clock = [this] {
            const std::lock_guard<std::mutex> alone(lock);
            return auth::Timestamps{std::chrono::system_clock::now() + later, std::chrono::steady_clock::now() + later};
        };
        settings.server.audit = [this](const AuditEntry& entry) {
            const std::lock_guard<std::mutex> alone(lock);
            audit.push_back(entry);
        };
        if (change) change(settings.server);
        auto opened = ServedRack::open(*reading.config, std::move(settings));
        if (!opened) throw std::runtime_error(opened.error().text());
        served = std::move(*opened);
        watch.emplace(served->machine());
        thread = std::thread([this] { served->run(); });
    }
    ~Running() {
        served->machine().quit();
        thread.join();
        served->stop();
    }

    std::uint16_t port() const { return served->server().port(); }
    WebClient client() const { return WebClient(port()); }
    /// Creates a token of this role for a name.
    std::string token(const std::string& name, auth::Role role = auth::Role::maintain) {
        const auth::Timestamps now{std::chrono::system_clock::now(), std::chrono::steady_clock::now()};
        const std::string code =
            role == auth::Role::maintain ? served->door().start_code() : *served->door().invite(role, now);
        return served->door().pair(code, name, "127.0.0.1", now)->token;
    }
    /// Opens a WebSocket with this token, past the greeting.
    WebClient stream(const std::string& token) const {
        WebClient client(port());
        EXPECT_EQ(client.upgrade().status, 101);
        client.receive();
        if (!token.empty()) {
            EXPECT_TRUE(client.exchange({{"token", token}}).value("done", false));
        }
        return client;
    }
    /// Opens a WebSocket that has control of the enabled machine.
    WebClient master(const std::string& name) {
        WebClient client = stream(token(name));
        EXPECT_TRUE(client.exchange({{"command", "take_control"}}).value("done", false));
        EXPECT_TRUE(client.exchange({{"command", "enable"}, {"on", true}}).value("done", false));
        return client;
    }
    bool audited(const std::string& what, int status) {
        const std::lock_guard<std::mutex> alone(lock);
        for (const AuditEntry& entry : audit)
            if (entry.what == what && entry.status == status) return true;
        return false;
    }
    void let_pass(std::chrono::hours time) {
        const std::lock_guard<std::mutex> alone(lock);
        later += time;
    }
    /// Returns, for every status while a program runs, the ticks since the first one and the pulses of X and Y.
    std::vector<std::array<std::int64_t, 3>> path() {
        const std::lock_guard<std::mutex> alone(lock);
        return path_;
    }

    std::optional<test::MachineWatch> watch;  ///< checks the invariants of every run until the machine's last slice
    std::unique_ptr<ServedRack> served;
    std::thread thread;
    std::mutex lock;
    std::chrono::hours later{0};
    std::vector<AuditEntry> audit;

  private:
    void observe(const operate::Status& status) {
        if (!status.program_runs) return;
        const std::lock_guard<std::mutex> alone(lock);
        if (path_.empty()) begun_ = status.at;
        path_.push_back({(status.at - begun_).count(), status.axes[0].pulses, status.axes[1].pulses});
    }
    Instant begun_{};
    std::vector<std::array<std::int64_t, 3>> path_;
};

inline bool state_is(const nlohmann::json& message, const std::string& state) {
    return message.contains("status") && message["status"]["state"] == state;
}

inline bool job_is_over(const nlohmann::json& message) {
    return state_is(message, "standstill") && message["status"]["program"]["name"] == "job" &&
           !message["status"]["program"]["runs"];
}

/// A job of a few simulated seconds.
inline std::string job() {
    std::string out = "G21 G90\n";
    for (int i = 0; i < 20; ++i) out += "G1 X20 Y10 F3000\nG2 X0 Y0 R30\n";
    return out + "M2\n";
}

}  // namespace motionrack::server
