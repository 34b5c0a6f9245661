// The DC motor's closed forms against small steps of its differential equation; dead band, saturation, load, ends of
// travel.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>
#include <motionrack/sim/parts/emergency_button.hpp>
#include <motionrack/sim/parts/reference_cam.hpp>
#include <vector>

namespace motionrack::parts {
namespace {

struct MotorRig {
    explicit MotorRig(const DcMotorSettings& settings = {}) : motor(kernel, "m", settings) {}
    void volts(double v) {
        kernel.set_wire(motor.drive_wire(), static_cast<int>(std::lround(v * 1e6)));
        kernel.settle();
    }
    void run(double seconds) { kernel.run_until(kernel.now() + from_seconds(seconds)); }
    double rate() { return motor.rate(kernel.now()); }
    double position() { return motor.position(kernel.now()); }

    sim::Kernel kernel;
    DcMotor motor;
};

/// Reference of the motor: its motion integrated in steps of a microsecond.
struct SteppedMotor {
    DcMotorSettings s;
    double volts = 0, velocity = 0, place = 0.5;
    void run(double seconds) {
        const double h = 1e-6, inertia = 1 + s.load_inertia_ratio;
        for (auto steps = static_cast<std::int64_t>(std::lround(seconds / h)); steps > 0; --steps) {
            const double drive = std::max(0.0, std::fabs(volts) - s.dead_band_v) * s.gain;
            const double wanted = std::copysign(std::min(drive, s.saturation_velocity), volts);
            const double torque = std::clamp((wanted - velocity) / (s.time_constant_s * inertia),
                                             -s.current_limit_accel / inertia, s.current_limit_accel / inertia);
            const double friction = s.coulomb_friction / inertia;
            if (velocity == 0 && std::fabs(torque) <= friction) continue;
            const double before = velocity;
            velocity += h * (torque - (velocity > 0 || (velocity == 0 && torque > 0) ? friction : -friction));
            if (before * velocity < 0) velocity = 0;
            place += h * (before + velocity) * 0.5;
        }
    }
};

RC_GTEST_PROP(DcMotor, MovesAsTheDifferentialEquationRequires, ()) {
    DcMotorSettings s;
    s.time_constant_s = *rc::gen::element(0.002, 0.01, 0.05);
    s.load_inertia_ratio = *rc::gen::element(0.0, 1.0, 9.0);
    s.coulomb_friction = *rc::gen::element(1'000.0, 20'000.0);
    s.dead_band_v = *rc::gen::element(0.0, 0.01);
    MotorRig rig(s);
    rig.kernel.start();
    SteppedMotor stepped{s};
    for (int i = 0; i < 6; ++i) {
        const double volts = *rc::gen::inRange(-12'000, 12'001) * 1e-3 * *rc::gen::element(1.0, 0.01);
        rig.volts(volts);
        stepped.volts = volts;
        const double time = 1e-3 * *rc::gen::inRange(1, 60);
        rig.run(time);
        stepped.run(time);
        // An error of one step (1 us) is 2 counts/s at the maximum acceleration; the errors of several steps add up.
        RC_ASSERT(std::fabs(rig.rate() - stepped.velocity) < 60);
        RC_ASSERT(std::fabs(rig.position() - stepped.place) < 3);
    }
}

TEST(DcMotor, VelocityIsProportionalToTheVoltageUpToSaturation) {
    DcMotorSettings s;
    s.coulomb_friction = 0;
    MotorRig rig(s);
    rig.kernel.start();
    rig.volts(2.005);
    rig.run(1);
    EXPECT_NEAR(rig.rate(), 20'000, 0.01);
    rig.volts(-4.005);
    rig.run(1);
    EXPECT_NEAR(rig.rate(), -40'000, 0.01);
    EXPECT_NEAR(rig.motor.tacho(rig.kernel.now()), -0.4, 1e-6);
    rig.volts(50);
    rig.run(1);
    EXPECT_NEAR(rig.rate(), 100'000, 0.01);
}

TEST(DcMotor, IsAtStandstillWithinTheDeadBandAndAtZeroVolts) {
    MotorRig rig;
    rig.kernel.start();
    rig.volts(0.004);
    rig.run(1);
    EXPECT_EQ(rig.position(), 0.5);
    rig.volts(5);
    rig.run(0.2);
    rig.volts(0);
    rig.run(0.2);
    EXPECT_EQ(rig.rate(), 0);
    const double there = rig.position();
    const std::uint64_t events = rig.kernel.events();
    rig.run(1'000);
    EXPECT_EQ(rig.position(), there);
    EXPECT_EQ(rig.kernel.events(), events) << "a motor that stands costs nothing";
}

TEST(DcMotor, ALoadMakesItSlower) {
    double times[2] = {};
    for (int i = 0; i < 2; ++i) {
        MotorRig rig;
        rig.kernel.start();
        rig.motor.fault("motor.load", i * 4, rig.kernel.now());
        rig.volts(8);
        while (rig.rate() < 70'000) rig.run(1e-4);
        times[i] = to_seconds(rig.kernel.now());
    }
    EXPECT_NEAR(times[1] / times[0], 5, 0.1);
}

struct MotorListener final : sim::PositionListener, sim::EdgeListener {
    void crossed(Instant now) override { at.push_back(now); }
    void rate_changed(double, double after, Instant) override { top = std::max(top, std::fabs(after)), ++reported; }
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            edge_at.push_back(batch.origin + batch.tick * batch.at[i]);
            counts.push_back(batch.first_count + batch.step * static_cast<std::int64_t>(i));
        }
    }
    std::vector<Instant> at, edge_at;
    std::vector<std::int64_t> counts;
    double top = 0;
    int reported = 0;
};

TEST(DcMotor, NotifiesAListenerAtTheExactInstantAndDeliversEveryEdge) {
    MotorRig rig;
    MotorListener listener;
    const int slot = rig.motor.add_listener(listener);
    rig.kernel.start();
    rig.motor.set_edge_listener(&listener);
    rig.volts(6);
    for (const std::int64_t above : {1, 700, 2'000, 9'000}) {
        rig.motor.watch(slot, sim::unwatched_below, above);
        listener.at.clear();
        while (listener.at.empty()) rig.run(1e-3);
        EXPECT_EQ(rig.motor.count(listener.at[0]), above);
        EXPECT_EQ(rig.motor.count(listener.at[0] - microseconds(1)), above - 1);
    }
    rig.volts(-3);
    rig.run(0.5);
    std::int64_t count = 0;
    for (std::size_t i = 0; i < listener.counts.size(); ++i) {
        EXPECT_EQ(std::abs(listener.counts[i] - count), 1);
        count = listener.counts[i];
        if (i > 0) {
            EXPECT_LE(listener.edge_at[i - 1], listener.edge_at[i]);
        }
    }
    EXPECT_EQ(count, rig.motor.count(rig.kernel.now()));
    EXPECT_GT(listener.top, 55'000);
    EXPECT_LT(listener.reported, 100);
}

TEST(DcMotor, StopsAtItsEndsOfTravelAndMovesAwayFromThem) {
    DcMotorSettings s;
    s.end_plus = 1'000;
    s.end_minus = -200;
    MotorRig rig(s);
    rig.kernel.start();
    rig.volts(3);
    rig.run(1);
    EXPECT_EQ(rig.motor.count(rig.kernel.now()), 1'000);
    EXPECT_EQ(rig.motor.blocked(), 1);
    EXPECT_EQ(rig.kernel.conditions().size(), 1u);
    rig.volts(4);
    rig.run(1);
    EXPECT_EQ(rig.motor.count(rig.kernel.now()), 1'000);
    rig.volts(-3);
    rig.run(1);
    EXPECT_EQ(rig.motor.count(rig.kernel.now()), -200);
    EXPECT_EQ(rig.kernel.conditions().size(), 2u);
}

TEST(DcMotor, TurnsAnAxisMachineWithCamAndSwitches) {
    sim::Kernel kernel;
    DcMotor motor(kernel, "m", {});
    AxisMechanicsSettings s;
    s.motor = {1'000, 1, 1e12, 1e12};
    s.axle.travel_per_rev = linear_travel(10);
    s.encoder.counts_per_rev = 1'000;
    s.limit_plus.position = 20;
    s.limit_plus.bounce = Duration{0};
    s.limit_plus.active_level = 1;
    AxisMechanics machine(kernel, "x", s);
    machine.connect(motor);
    ReferenceCam cam(kernel, "cam", machine.rotor(), 500, 700);
    EmergencyButton button(kernel, "button");
    kernel.start();
    kernel.run_until(Instant{0});
    kernel.set_wire(motor.drive_wire(), 1'000'000);
    auto run_to = [&](std::int64_t count) {
        while (machine.encoder().count(kernel.now()) < count) kernel.run_until(kernel.now() + microseconds(20));
    };
    run_to(499);
    EXPECT_EQ(kernel.level(cam.wire()), 0);
    run_to(500);
    EXPECT_EQ(kernel.level(cam.wire()), 1);
    run_to(700);
    EXPECT_EQ(kernel.level(cam.wire()), 1);
    run_to(701);
    EXPECT_EQ(kernel.level(cam.wire()), 0);
    run_to(1'999);
    EXPECT_EQ(kernel.level(machine.limit_plus_wire()), 0);
    run_to(2'000);
    EXPECT_EQ(kernel.level(machine.limit_plus_wire()), 1);
    EXPECT_NEAR(machine.position(kernel.now()), 20, 0.05);
    EXPECT_TRUE(machine.in_step());
    button.press();
    kernel.settle();
    EXPECT_EQ(kernel.level(button.wire()), 1);
    button.release();
    button.fault("broken", 1, kernel.now());
    EXPECT_EQ(kernel.level(button.wire()), 1);
}

}  // namespace
}  // namespace motionrack::parts
