// A machine for tests of homing: the chip, its driver on a virtual bus, and for each axis a motor, a leadscrew, limit
// and home switches, and an encoder with index.
//
//   driver ──► VirtualPort ──► chip ──pulses──► axis machine ──home──► xin0, ──enc_z──► xin2, ──limits──► xlmtp, xlmtm
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/driver/home_series.hpp>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <motionrack/sim/wire_connections.hpp>
#include <string>
#include <vector>

namespace motionrack::mcx314 {

inline constexpr double pulses_per_mm = 640;
inline constexpr std::int64_t pulses_per_turn = 3200;

/// Settings of an axis: 5 mm per revolution, 300 mm of travel; the home switch acts at and below 1 mm, limit switches
/// at -8 and 302 mm.
struct RigAxis {
    double start_mm = 20;
    double home_mm = 1;
    double hysteresis_mm = 0.05;
    Duration bounce{0};
    double limit_minus_mm = -8;
    double limit_plus_mm = 302;
    bool wired_home = true;
    bool wired_index = true;
    int home_level = 0;           ///< level of the home switch's wire while active
    double start_stop_hz = 4000;  ///< step of the pulse rate that the motor follows without step loss

    parts::AxisMechanicsSettings machine() const {
        parts::AxisMechanicsSettings s;
        s.motor = {200, 16, start_stop_hz, 200'000};
        s.axle.travel_per_rev = parts::linear_travel(5);
        s.axle.initial_position = start_mm;
        s.encoder.counts_per_rev = 4000;
        s.home.position = home_mm;
        s.home.active_level = home_level;
        s.limit_minus.position = limit_minus_mm;
        s.limit_plus.position = limit_plus_mm;
        for (parts::LimitSwitchSettings* each : {&s.home, &s.limit_minus, &s.limit_plus}) {
            each->hysteresis = hysteresis_mm;
            each->bounce = bounce;
        }
        return s;
    }
};

/// A switch that is active only between two positions, so an axis can stop beyond it. It is moved by an axis.
class Cam final : public sim::Device, private sim::PositionListener {
  public:
    /// Adds a switch that is active (the wire `name` is 0) from `low` to `high`, rotor pulses since the start.
    Cam(sim::Kernel& kernel, const std::string& name, parts::AxisMechanics& machine, std::int64_t low,
        std::int64_t high)
        : kernel_(kernel),
          id_(kernel.add(*this, sim::Phase::parts, name)),
          wire_(kernel.add_wire(name, 1)),
          rotor_(machine.rotor()),
          low_(low),
          high_(high),
          slot_(rotor_.add_listener(*this)) {
        kernel_.schedule(id_, Instant{0});
    }
    sim::WireId wire() const { return wire_; }
    void on_scheduled(Instant now) override { poll(now); }

  private:
    void crossed(Instant now) override { poll(now); }
    void rate_changed(double, double, Instant) override {}
    void poll(Instant now) {
        const std::int64_t at = rotor_.count(now);
        kernel_.set_wire(wire_, at >= low_ && at <= high_ ? 0 : 1);
        if (at < low_)
            rotor_.watch(slot_, sim::unwatched_below, low_);
        else if (at > high_)
            rotor_.watch(slot_, high_, sim::unwatched_above);
        else
            rotor_.watch(slot_, low_ - 1, high_ + 1);
    }

    sim::Kernel& kernel_;
    sim::DeviceId id_;
    sim::WireId wire_;
    sim::PositionFunction& rotor_;
    std::int64_t low_, high_;
    int slot_;
};

class HomeRig {
  public:
    explicit HomeRig(const std::vector<RigAxis>& axes = {RigAxis{}})
        : chip(kernel, "c"),
          port(kernel, chip, chip.id(), chip.interrupt_wire(), nanoseconds(250)),
          driver(port, port),
          junctions_(kernel, "wiring") {
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const std::string axis(1, "XYZU"[i]), pin = std::string("c.") + "xyzu"[i];
            machines.push_back(std::make_unique<parts::AxisMechanics>(kernel, axis, axes[i].machine()));
            machines[i]->connect(chip.pulses(static_cast<int>(i)));
            chip.connect_encoder(static_cast<int>(i), machines[i]->encoder());
            if (axes[i].wired_home) join(machines[i]->home_wire(), pin + "in0");
            if (axes[i].wired_index) join(machines[i]->index_wire(), pin + "in2");
            join(machines[i]->limit_plus_wire(), pin + "lmtp");
            join(machines[i]->limit_minus_wire(), pin + "lmtm");
        }
    }
    void join(sim::WireId from, const std::string& to) { junctions_.join(from, kernel.find_wire(to)); }
    /// Starts the virtual time, and resets the chip: pulse and direction, decelerating limit switches.
    void start() {
        kernel.start();
        kernel.run_until(Instant{0});
        driver.RESET();
        driver.WriteMode2(xyzu, 0x0044);
        EXPECT_TRUE(driver.SetAO(xyzu, 0));
        EXPECT_TRUE(driver.SetRange(xyzu, 800'000));
    }
    double position(int axis = 0) { return machines[static_cast<std::size_t>(axis)]->position(kernel.now()); }
    std::int64_t rotor(int axis = 0) { return machines[static_cast<std::size_t>(axis)]->rotor().count(kernel.now()); }
    void hold_wire(const std::string& name, int level) {
        kernel.force(kernel.find_wire(name), level);
        kernel.settle();
    }
    void fault(int axis, const char* name) { machines[static_cast<std::size_t>(axis)]->fault(name, 1, kernel.now()); }

    sim::Kernel kernel;
    Chip chip;
    sim::VirtualPort port;
    Driver driver;
    std::vector<std::unique_ptr<parts::AxisMechanics>> machines;

  private:
    sim::WireConnections junctions_;
};

/// Homing settings of the rig: the search accelerates from 500 pulses/s to 10,000 pulses/s (15.6 mm/s) with
/// 125,000 pulses/s2 and covers at most 330 mm.
inline HomeSettings rig_settings(int type) {
    HomeSettings s;
    s.type = type;
    s.range = 800'000;
    s.sv = 50;
    s.v = 1000;
    s.a = 100;
    s.slow_v = 25;
    s.travel = 330 * 640;
    s.turn = pulses_per_turn;
    return s;
}

}  // namespace motionrack::mcx314
