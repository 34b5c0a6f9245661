// A machine with a Grbl port, driven step by step: bytes in, time passes, bytes out.
//
// The machine runs on its own thread, which pauses while the test works: the two alternate.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <memory>
#include <motionrack/grbl/grbl_session.hpp>
#include <motionrack/rack/template.hpp>
#include <mutex>
#include <optional>
#include <sstream>
#include <tests/invariants/watch.hpp>
#include <thread>

namespace motionrack::grbl {

inline rack::RackConfig rack_of(const std::string& text) {
    const rack::RackReading reading = rack::read_rack_text(text);
    EXPECT_TRUE(reading.config) << (reading.errors.empty() ? "" : reading.errors[0].text());
    return *reading.config;
}

/// Returns a rack of X, Y and Z without home switches, at the rack file's positions. `more`: further text of the file.
inline rack::RackConfig three_axes(const std::string& more = "") {
    return rack_of(
        "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[axis.Y]\ncard = \"m\"\nchannel = "
        "\"y\"\n[axis.Z]\ncard = \"m\"\n"
        "channel = \"z\"\n" +
        more);
}

/// Returns a rack of X, Y and Z with a probe; `block`: its text in the rack file.
inline rack::RackConfig with_probe(const std::string& block) {
    return rack_of(
        "[card.m]\ntype = \"mcx314\"\nvariant = \"mcx314as\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[axis.Y]\ncard "
        "= \"m\"\nchannel = \"y\"\n"
        "[axis.Z]\ncard = \"m\"\nchannel = \"z\"\n[probe]\n" +
        block);
}

inline rack::RackConfig router() {
    return *rack::read_rack_text(*rack::rack_template("router")).config;
}

/// Returns the number of answers ("ok" or "error:") in the text.
inline int answers(const std::string& text) {
    std::istringstream in(text);
    int out = 0;
    for (std::string line; std::getline(in, line);) out += line == "ok\r" || line.rfind("error:", 0) == 0;
    return out;
}

class Bench {
  public:
    explicit Bench(const rack::RackConfig& config, SessionSettings settings = {}) {
        operate::MachineSettings machine_settings;
        machine_settings.pace = [this](Instant now) { return wait_for_turn(now); };
        machine_settings.on_status = [this](const operate::Status&) {
            if (session) session->tick();
        };
        auto made = operate::Machine::make(config, std::move(machine_settings));
        EXPECT_TRUE(made) << made.error().message;
        machine = std::move(*made);
        watch.emplace(*machine);
        machine->listen([](const operate::Status&) {},
                        [this](const operate::StopReport& report) { session->stopped(report); });
        session = std::make_unique<GrblSession>(*machine, std::move(settings));
        thread_ = std::thread([this] { machine->run(); });
        pass(0.01);
    }
    ~Bench() {
        machine->quit();
        {
            const std::lock_guard<std::mutex> alone(lock_);
            ending_ = true;
        }
        turn_.notify_all();
        thread_.join();
    }

    /// Advances time by this number of seconds.
    void pass(double seconds) {
        std::unique_lock<std::mutex> alone(lock_);
        until_ += from_seconds(seconds);
        waiting_ = false;
        turn_.notify_all();
        turn_.wait(alone, [this] { return waiting_; });
    }
    /// Sends these bytes and returns the output within `seconds`.
    std::string ask(std::string_view bytes, double seconds = 0.01) {
        session->receive(bytes);
        pass(seconds);
        return session->take_output();
    }
    /// Requests and returns the status report.
    std::string report() { return ask("?"); }
    /// Waits for idle, 100 s at most; returns the output meanwhile.
    std::string until_idle() {
        std::string out;
        for (int i = 0; i < 10'000 && session->state() != State::idle; ++i) out += ask("");
        EXPECT_EQ(session->state(), State::idle);
        return out;
    }
    double axis(int index) { return machine->status().axes[static_cast<std::size_t>(index)].commanded; }

    std::unique_ptr<operate::Machine> machine;
    std::optional<test::MachineWatch> watch;
    std::unique_ptr<GrblSession> session;

  private:
    bool wait_for_turn(Instant now) {
        std::unique_lock<std::mutex> alone(lock_);
        while (now >= until_ && !ending_) {
            waiting_ = true;
            turn_.notify_all();
            turn_.wait(alone);
        }
        return true;
    }

    std::mutex lock_;
    std::condition_variable turn_;
    Instant until_{};
    bool waiting_ = false, ending_ = false;
    std::thread thread_;
};

}  // namespace motionrack::grbl
