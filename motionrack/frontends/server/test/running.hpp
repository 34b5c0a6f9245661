// A machine with its panel and a server that run while a test asks.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <motionrack/authority/control_lease.hpp>
#include <motionrack/frontends/server/door_orders.hpp>
#include <motionrack/frontends/server/server.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/operate/pacer.hpp>
#include <motionrack/rack/config.hpp>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "web_client.hpp"

namespace motionrack::server {

/// Two axes that stand where they should; 20 s of the rack a second.
class Running {
  public:
    using Change = std::function<void(ServerSettings&)>;
    explicit Running(const Change& change = {}, Page page = {}) {
        const rack::RackReading reading = rack::read_rack_text("[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n"
                                                               "[axis.Y]\ncard = \"m\"\nchannel = \"y\"\n");
        operate::MachineSettings settings;
        settings.pace = [this](Instant now) { return pacer.pace(now); };
        settings.on_status = [this](const operate::Status& status) { look(status); };
        machine = *operate::Machine::make(*reading.config, std::move(settings));
        authority::DoorkeeperSettings door_settings;
        door_settings.on_start_code = [](const std::string&) {};
        door = *authority::Doorkeeper::open(door_settings);
        panel::PanelSettings panel_settings;
        panel_settings.elsewhere = door_orders(*door);
        panel = std::make_unique<panel::Panel>(*machine, lease, std::move(panel_settings));
        ServerSettings server_settings;
        server_settings.port = 0;
        server_settings.version = "0.1.0";
        server_settings.rack = "two";
        server_settings.boot = "b007";
        server_settings.limits.requests_at_once = server_settings.limits.messages_at_once = 1e9;
        server_settings.clock = [this] {
            const std::lock_guard<std::mutex> alone(lock);
            return authority::Now{std::chrono::system_clock::now() + later, std::chrono::steady_clock::now() + later};
        };
        server_settings.audit = [this](const AuditEntry& entry) {
            const std::lock_guard<std::mutex> alone(lock);
            audit.push_back(entry);
        };
        if (change) change(server_settings);
        auto opened = Server::open(std::move(server_settings), *panel, *door, lease, std::move(page));
        if (!opened) throw std::runtime_error(opened.error().text());
        server = std::move(*opened);
        thread = std::thread([this] { machine->run(); });
    }
    ~Running() {
        machine->quit();
        thread.join();
        server->stop();
    }

    WebClient client() const { return WebClient(server->port()); }
    /// A token of this role for a name.
    std::string token(const std::string& name, authority::Role role = authority::Role::maintain) {
        const authority::Now now{std::chrono::system_clock::now(), std::chrono::steady_clock::now()};
        const std::string code = role == authority::Role::maintain ? door->start_code() : *door->invite(role, now);
        return door->pair(code, name, "127.0.0.1", now)->token;
    }
    /// A WebSocket with this token, past hello.
    WebClient stream(const std::string& token) const {
        WebClient client(server->port());
        EXPECT_EQ(client.upgrade().status, 101);
        client.receive();
        if (!token.empty()) {
            EXPECT_TRUE(client.order({{"token", token}}).value("done", false));
        }
        return client;
    }
    /// One that has control of the enabled machine.
    WebClient master(const std::string& name) {
        WebClient client = stream(token(name));
        EXPECT_TRUE(client.order({{"order", "take_control"}}).value("done", false));
        EXPECT_TRUE(client.order({{"order", "enable"}, {"on", true}}).value("done", false));
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
    /// Where the axes were, each time after the program began; and then nothing more.
    std::vector<std::array<std::int64_t, 3>> path() {
        const std::lock_guard<std::mutex> alone(lock);
        return path_;
    }

    live::MonotonicClock clock;
    operate::Pacer pacer{clock, operate::ClockMode::real, 20};
    authority::ControlLease lease;
    std::unique_ptr<operate::Machine> machine;
    std::unique_ptr<authority::Doorkeeper> door;
    std::unique_ptr<panel::Panel> panel;
    std::unique_ptr<Server> server;
    std::thread thread;
    std::mutex lock;
    std::chrono::hours later{0};
    std::vector<AuditEntry> audit;

  private:
    void look(const operate::Status& status) {
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
    return state_is(message, "standstill") && message["status"]["program"]["name"] == "job" && !message["status"]["program"]["runs"];
}

/// A job of a few seconds of the rack's time.
inline std::string job() {
    std::string out = "G21 G90\n";
    for (int i = 0; i < 20; ++i) out += "G1 X20 Y10 F3000\nG2 X0 Y0 R30\n";
    return out + "M2\n";
}

}  // namespace motionrack::server
