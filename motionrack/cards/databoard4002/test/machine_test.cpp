// The card with a machine: servo amplifier and DC motor, carriage with end stops, reference cam, zero pulse, emergency
// button.
//
//   vout ─► motor ─► carriage ─► limit switches ─► esr, esl
//                       ├─► encoder ─► o1, o2, zero
//                       └─► cam ─► ref              button ─► ems
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/driver/slope.hpp>
#include <motionrack/cards/databoard4002/test/host.hpp>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>
#include <motionrack/sim/parts/emergency_button.hpp>
#include <motionrack/sim/parts/reference_cam.hpp>
#include <motionrack/sim/wire_connections.hpp>
#include <vector>

namespace motionrack::databoard4002 {
namespace {

using ::testing::HasSubstr;

/// 1000 counts and 10 mm per revolution: 100 counts/mm. The carriage is at 0, the stops are at -300 and +3000 mm.
parts::AxisMechanicsSettings carriage() {
    parts::AxisMechanicsSettings s;
    s.motor = {1'000, 1, 1e12, 1e12};
    s.axle.travel_per_rev = parts::linear_travel(10);
    s.encoder.counts_per_rev = 1'000;
    for (auto* end : {&s.limit_minus, &s.limit_plus}) end->active_level = 1, end->bounce = milliseconds(1);
    s.limit_minus.position = -300;
    s.limit_plus.position = 3'000;
    return s;
}

struct Machine {
    explicit Machine(const parts::DcMotorSettings& settings = {})
        : motor(kernel, "motor", settings),
          axis(kernel, "carriage", carriage()),
          connected((axis.connect(motor), true)),
          cam(kernel, "cam", axis.rotor(), 12'600, 13'200),
          button(kernel, "button"),
          host({}, false, &axis.encoder(), &kernel),
          junctions(kernel),
          driver(host.port, host.port, {.counts_per_mm = 100}) {
        const auto pin = [this](const char* name) { return kernel.find_wire("c1." + std::string(name)); };
        junctions.join(pin("vout"), motor.drive_wire());
        junctions.join(axis.limit_plus_wire(), pin("esr"));
        junctions.join(axis.limit_minus_wire(), pin("esl"));
        junctions.join(axis.index_wire(), pin("zero"));
        junctions.join(cam.wire(), pin("ref"));
        junctions.join(button.wire(), pin("ems"));
        host.start();
        EXPECT_TRUE(driver.connect());
        scale.analog = true;
        scale.counts_per_volt = settings.gain;
    }
    /// Slope mode with ramps that this motor follows.
    void set_slope(double top, double ramp, double lag_s = 0.01) {
        const auto table = design_slope(
            {.top_speed = top, .acceleration = ramp, .deceleration = ramp, .creep_speed = 300, .lag_s = lag_s}, scale);
        ASSERT_TRUE(table) << table.error().message;
        ASSERT_TRUE(driver.set_slope(*table));
        ASSERT_TRUE(driver.on_regulation());
    }
    double mm() { return axis.position(kernel.now()); }

    sim::Kernel kernel;
    parts::DcMotor motor;
    parts::AxisMechanics axis;
    bool connected;
    parts::ReferenceCam cam;
    parts::EmergencyButton button;
    Host host;
    sim::WireConnections junctions;
    Driver driver;
    SpeedScale scale;
};

/// Number of direction changes of the output, and range of the carriage, in `time`.
struct Swing {
    int turns = 0;
    double width_mm = 0;
};
Swing swing_of(Machine& m, Duration time) {
    Swing out;
    int last = 0;
    double min_mm = m.mm(), max_mm = min_mm;
    for (const Instant until = m.kernel.now() + time; m.kernel.now() < until;) {
        m.host.run(microseconds(200));
        const int volts = m.host.level("vout"), direction = (volts > 0) - (volts < 0);
        if (direction != 0 && last != 0 && direction != last) ++out.turns;
        if (direction != 0) last = direction;
        min_mm = std::min(min_mm, m.mm());
        max_mm = std::max(max_mm, m.mm());
    }
    out.width_mm = max_mm - min_mm;
    return out;
}

TEST(Databoard4002Machine, ASlopeBringsTheCarriageToItsTargetWithinTheMotorsLag) {
    Machine m;
    m.set_slope(50'000, 100'000);
    for (const double target : {1'500.0, 200.0, 2'750.0, -100.0}) {
        const auto moved = m.driver.move_to_mm(target, whole_seconds(30), Waiting::interrupt);
        ASSERT_TRUE(moved) << moved.error().message;
        m.host.run(milliseconds(200));
        EXPECT_NEAR(m.mm(), target, 0.05) << "a few counts of overrun at creep speed";
        EXPECT_EQ(m.motor.rate(m.kernel.now()), 0);
        EXPECT_NEAR(*m.driver.position_mm(), m.mm(), 0.011);
    }
}

TEST(Databoard4002Machine, AtFullRateWithoutASlopeItOvershootsFar) {
    Machine m;
    ASSERT_TRUE(m.driver.set_rate(16'302));  // 5 V
    ASSERT_TRUE(m.driver.move_to_mm(1'000, whole_seconds(10)));
    m.host.run(milliseconds(300));
    EXPECT_GT(m.mm(), 1'003);
}

TEST(Databoard4002Machine, LockWithASuitableWindowSettlesAfterAPush) {
    Machine m;
    m.set_slope(20'000, 40'000);
    ASSERT_TRUE(m.driver.move_to_mm(500, whole_seconds(30)));
    ASSERT_TRUE(m.driver.set_deviation(25));
    ASSERT_TRUE(m.driver.lock());
    m.host.run(milliseconds(100));
    m.motor.fault("motor.push", 1'000, m.kernel.now());
    m.host.run(milliseconds(1'500));
    EXPECT_NEAR(m.mm(), 500, 0.25);
    const Swing rest = swing_of(m, whole_seconds(2));
    EXPECT_EQ(rest.turns, 0);
    EXPECT_EQ(rest.width_mm, 0);
}

TEST(Databoard4002Machine, LockWithTooSmallAWindowAtHighSpeedHunts) {
    Machine m;
    ASSERT_TRUE(m.driver.set_rate(16'302));  // 5 V, no slope
    ASSERT_TRUE(m.driver.move_to_mm(500, whole_seconds(30)));
    ASSERT_TRUE(m.driver.set_deviation(5));
    ASSERT_TRUE(m.driver.lock());
    const Swing hunting = swing_of(m, whole_seconds(2));
    EXPECT_GT(hunting.turns, 20);
    EXPECT_GT(hunting.width_mm, 1);
    // A window wider than the overrun ends it.
    ASSERT_TRUE(m.driver.set_deviation(2'000));
    m.host.run(milliseconds(500));
    const Swing rest = swing_of(m, whole_seconds(1));
    EXPECT_EQ(rest.turns, 0);
    EXPECT_EQ(rest.width_mm, 0);
}

TEST(Databoard4002Machine, TheEndStopStopsTheCarriageAndAllowsTheOtherDirection) {
    Machine m;
    m.set_slope(50'000, 100'000);
    const auto moved = m.driver.move_to_mm(3'200, whole_seconds(30), Waiting::interrupt);
    ASSERT_FALSE(moved);
    EXPECT_THAT(moved.error().message, HasSubstr("the right end stop is active"));
    m.host.run(milliseconds(500));
    EXPECT_GT(m.mm(), 3'000);
    EXPECT_LT(m.mm(), 3'020);
    ASSERT_TRUE(m.driver.move_to_mm(0, whole_seconds(30), Waiting::interrupt));
}

TEST(Databoard4002Machine, TheEmergencyButtonStopsItAndItStaysWhenReleased) {
    Machine m;
    m.set_slope(50'000, 100'000);
    m.host.port.on_slice(milliseconds(10), [&] {
        if (m.mm() > 700) m.button.press();
    });
    const auto moved = m.driver.move_to_mm(2'000, whole_seconds(30));
    ASSERT_FALSE(moved);
    EXPECT_THAT(moved.error().message, HasSubstr("the emergency stop is active"));
    m.host.port.on_slice(whole_seconds(100), [] {});
    m.host.run(milliseconds(500));
    const double there = m.mm();
    EXPECT_GT(there, 700);
    EXPECT_LT(there, 800);
    m.button.release();
    m.host.run(whole_seconds(1));
    EXPECT_EQ(m.mm(), there);
    ASSERT_TRUE(m.driver.move_to_mm(0, whole_seconds(30)));
}

TEST(Databoard4002Machine, TheZeroPulseUnderTheCamBecomesTheZeroOfTheCounter) {
    Machine m;
    // The cam is active at 126 .. 132 mm, the zero pulses are at whole revolutions: every 10 mm.
    ASSERT_TRUE(m.driver.find_zero(event::ZERO | event::REF, 100'000, 15'463, whole_seconds(60)));
    m.host.run(milliseconds(300));
    EXPECT_NEAR(m.mm(), 130, 0.5);
    EXPECT_NEAR(*m.driver.position_mm(), m.mm() - 130, 0.011);
    // The zero pulse alone: the next revolution. The reference alone: the edge of the cam, from the other side.
    ASSERT_TRUE(m.driver.find_zero(event::ZERO, 100'000, 15'463, whole_seconds(60), Waiting::interrupt));
    m.host.run(milliseconds(300));
    EXPECT_NEAR(m.mm(), 140, 0.5);
    EXPECT_NEAR(*m.driver.position_mm(), m.mm() - 140, 0.011);
    ASSERT_TRUE(m.driver.find_zero(event::REF, -100'000, 15'463, whole_seconds(60)));
    m.host.run(milliseconds(300));
    EXPECT_NEAR(m.mm(), 132, 0.5);
    EXPECT_NEAR(*m.driver.position_mm(), m.mm() - 132, 0.021);
}

TEST(Databoard4002Machine, AHeavierCarriageNeedsAGentlerSlope) {
    parts::DcMotorSettings heavy;
    heavy.load_inertia_ratio = 8;
    Machine m(heavy);
    double overrun[2] = {};
    for (int gentle = 0; gentle < 2; ++gentle) {
        m.set_slope(50'000, gentle ? 60'000 : 1'500'000, gentle ? 0.09 : 0);
        ASSERT_TRUE(m.driver.move_to_mm(gentle ? 0 : 1'000, whole_seconds(60)));
        m.host.run(whole_seconds(1));
        overrun[gentle] = std::fabs(m.mm() - (gentle ? 0 : 1'000));
    }
    EXPECT_GT(overrun[0], 10 * overrun[1]);
}

TEST(Databoard4002Machine, TheEventTraceOfTheMachineIsReproducible) {
    std::uint64_t hashes[2];
    for (std::uint64_t& hash : hashes) {
        Machine m;
        m.set_slope(50'000, 100'000);
        ASSERT_TRUE(m.driver.move_to_mm(800, whole_seconds(30)));
        hash = m.kernel.trace_hash() ^ m.kernel.state_hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace motionrack::databoard4002
