// A machine with its panel and requests at given instants of virtual time; everything runs in one thread except the
// panel's own worker.
#pragma once

#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <fstream>
#include <motionrack/auth/control_lease.hpp>
#include <motionrack/panel/operation_specs.hpp>
#include <motionrack/panel/panel.hpp>
#include <motionrack/rack/config.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <tests/invariants/watch.hpp>
#include <tests/source_root.hpp>
#include <thread>
#include <vector>

namespace motionrack::panel {

using nlohmann::json;

inline std::string text_of_file(const std::string& path) {
    std::ifstream in(source_dir() + "/" + path);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

inline rack::RackConfig config_of(const std::string& text) {
    const rack::RackReading reading = rack::read_rack_text(text);
    EXPECT_TRUE(reading.config) << (reading.errors.empty() ? "" : reading.errors[0].text());
    return *reading.config;
}
inline rack::RackConfig demonstration() {
    return config_of(text_of_file("examples/15_panel/demonstration.toml"));
}
/// Returns a rack of two axes without switches, at the rack file's positions.
inline rack::RackConfig two_axes() {
    return config_of(
        "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = "
        "10\n[axis.Y]\ncard = "
        "\"m\"\nchannel = \"y\"\n");
}

inline const Caller anna{"anna", auth::Role::maintain, "w1"}, bert{"bert", auth::Role::operate, "w2"},
    eve{"eve", auth::Role::observe, "w3"}, nobody{"", auth::Role::none, "w4"};

class Asked {
  public:
    explicit Asked(const rack::RackConfig& config, PanelSettings settings = {},
                   operate::MachineSettings machine_settings = {}) {
        machine_settings.pace = [this](Instant now) { return pace(to_seconds(now)); };
        auto made = operate::Machine::make(config, std::move(machine_settings));
        EXPECT_TRUE(made) << made.error().message;
        machine = std::move(*made);
        watch.emplace(*machine);
        settings.picture_every = std::chrono::microseconds(0);
        panel = std::make_unique<Panel>(*machine, lease, std::move(settings));
    }
    /// Sends a request at `seconds`; virtual time waits for answers from the worker.
    void at(double seconds, const Caller& caller, const std::string& name, json fields = json::object(),
            std::function<void(const Answer&)> check = {}) {
        at(seconds, [this, caller, name, fields = std::move(fields), check = std::move(check)] {
            ask(caller, name, fields, check);
        });
    }
    void at(double seconds, std::function<void()> work) {
        const auto later =
            std::find_if(orders_.begin(), orders_.end(), [&](const Timed& one) { return one.seconds > seconds; });
        orders_.insert(later, {seconds, std::move(work)});
    }
    /// Sends a command of anna, who holds control, and expects that it is accepted.
    void good(double seconds, const std::string& name, json fields = json::object()) {
        at(seconds, anna, name, std::move(fields),
           [name](const Answer& answer) { EXPECT_EQ(answer.status, 200) << name << ": " << answer.body.dump(); });
    }
    void ask(const Caller& caller, const std::string& name, const json& fields,
             std::function<void(const Answer&)> check) {
        ++open_;
        panel->ask(caller, name, fields, [this, check = std::move(check)](const Answer& answer) {
            if (check) check(answer);
            --open_;
        });
    }
    void run(double seconds) {
        at(seconds, [this] { machine->quit(); });
        machine->run();
        EXPECT_EQ(open_, 0) << "a command was never answered";
    }
    double x() const { return machine->status().axes[0].commanded; }

    /// The clock of the lease stands still, so that control does not expire on a busy computer.
    auth::ControlLease lease{[] { return auth::Moment{}; }};
    std::optional<test::MachineWatch> watch;  ///< the laws of every run, to the machine's last slice
    std::unique_ptr<operate::Machine> machine;
    std::unique_ptr<Panel> panel;

  private:
    struct Timed {
        double seconds;
        std::function<void()> work;
    };
    bool pace(double now) {
        if (!machine || !panel) return true;
        // Worker and journal answer in real time; a bus access needs virtual time.
        if (open_ == 0) waiting_since_ = std::chrono::steady_clock::now();
        if (open_ > 0 && std::chrono::steady_clock::now() - waiting_since_ < std::chrono::milliseconds(200)) {
            std::this_thread::yield();
            return false;
        }
        while (!orders_.empty() && now >= orders_.front().seconds) {
            const Timed one = std::move(orders_.front());
            orders_.pop_front();
            one.work();
        }
        return true;
    }
    std::deque<Timed> orders_;
    std::atomic<int> open_{0};
    std::chrono::steady_clock::time_point waiting_since_{};
};

}  // namespace motionrack::panel
