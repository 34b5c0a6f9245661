// A machine with commands at given instants of virtual time.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <optional>
#include <string>
#include <tests/invariants/watch.hpp>
#include <tests/source_root.hpp>
#include <vector>

namespace motionrack::operate {

/// Returns a rack of two axes at the rack file's positions; `more`: further text of the file.
inline rack::RackConfig two_axes(const std::string& more = "") {
    return rack::good(
        "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = 10\n"
        "[axis.Y]\ncard = \"m\"\nchannel = \"y\"\n" +
        more);
}

inline rack::RackConfig router() {
    return *rack::read_rack_text(*rack::rack_template("router")).config;
}

/// Returns the rack of a servo whose card positions it by itself.
inline rack::RackConfig carriage() {
    return *rack::read_rack_file((source_root / "examples/11_carriage/machine.toml").string()).config;
}

/// Sets all positions to their present values.
inline void set_all_positions(Machine& m) {
    for (const AxisStatus& axis : m.status().axes) EXPECT_TRUE(m.manual().set_position(axis.letter, axis.commanded));
}

/// Returns the message of a refused command; empty: it was accepted.
inline std::string refusal_of(const Result<void>& result) {
    return result ? std::string() : result.error().message;
}

/// A machine, and commands that are given at their instants.
class Operated {
  public:
    explicit Operated(const rack::RackConfig& config, MachineSettings settings = {}) {
        settings.pace = [this](Instant now) { return give(to_seconds(now)), true; };
        settings.on_status = [this](const Status& status) { observe(status); };
        settings.on_event = [this](const control::gcode::CanonCall& step) { events.push_back(step.kind); };
        auto made = Machine::make(config, std::move(settings));
        EXPECT_TRUE(made) << made.error().message;
        machine = std::move(*made);
        watch.emplace(*machine);
        EXPECT_TRUE(machine->enable(true));
    }
    void at(double seconds, std::function<void(Machine&)> order) {
        const auto later =
            std::find_if(orders_.begin(), orders_.end(), [&](const Order& one) { return one.seconds > seconds; });
        orders_.insert(later, {seconds, std::move(order)});
    }
    /// Sets the listener to the status of every slice.
    void each_status(std::function<void(const Status&)> see) { see_ = std::move(see); }
    /// Runs until `seconds`.
    void run(double seconds) {
        at(seconds, [](Machine& m) { m.quit(); });
        machine->run();
    }
    double x() const { return machine->status().axes[0].commanded; }
    double y() const { return machine->status().axes[1].commanded; }

    std::unique_ptr<Machine> machine;
    std::optional<test::MachineWatch> watch;
    std::vector<std::string> states;  ///< in order of occurrence
    std::vector<control::gcode::CanonCallKind> events;
    double peak_velocity = 0, stood_since = 0;

  private:
    struct Order {
        double seconds;
        std::function<void(Machine&)> give;
    };
    void give(double now) {
        while (machine && !orders_.empty() && now >= orders_.front().seconds) {
            const Order order = orders_.front();
            orders_.pop_front();
            order.give(*machine);
        }
    }
    void observe(const Status& status) {
        if (see_) see_(status);
        if (states.empty() || states.back() != name_of(status.state)) states.emplace_back(name_of(status.state));
        for (const AxisStatus& axis : status.axes) {
            peak_velocity = std::max(peak_velocity, std::fabs(axis.velocity));
            if (axis.velocity != 0) stood_since = to_seconds(status.at);
        }
    }
    std::deque<Order> orders_;
    std::function<void(const Status&)> see_;
};

}  // namespace motionrack::operate
