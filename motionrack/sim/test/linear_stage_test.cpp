// The linear stage's parabolas against small steps of its differential equation; instants, ends, faults, rewinding.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/sim/parts/conditions.hpp>
#include <motionrack/sim/parts/linear_stage.hpp>
#include <vector>

#include "allocation_count.hpp"

namespace motionrack::parts {
namespace {

struct Rig {
    explicit Rig(const LinearStageSettings& settings = {}) : stage(kernel, "x", settings) {}
    void volts(double v) {
        kernel.set_wire(stage.drive_wire(), static_cast<int>(std::lround(v * 1e6)));
        kernel.settle();
    }
    void run(double seconds) { kernel.run_until(kernel.now() + from_seconds(seconds)); }
    double velocity() { return stage.velocity(kernel.now()); }
    double nm() { return stage.position_nm(kernel.now()); }
    std::int64_t count() { return stage.count(kernel.now()); }

    sim::Kernel kernel;
    LinearStage stage;
};

/// Reference of the stage: its motion integrated in steps of a quarter of a microsecond, in metres.
struct Stepped {
    LinearStageSettings s;
    double volts = 0;
    long double velocity = 0, position = 0, peak_velocity = 0;
    void run(double seconds) {
        const long double h = 0.25e-6L, mass = 1 + s.load_mass_ratio;
        for (auto steps = std::llround(seconds / 0.25e-6); steps > 0; --steps) {
            const long double push =
                std::clamp(volts * s.accel_per_volt, -s.current_limit_accel, s.current_limit_accel);
            if (velocity == 0 && std::fabs(push) <= s.coulomb_friction) continue;
            const long double brake =
                velocity > 0 || (velocity == 0 && push > 0) ? s.coulomb_friction : -s.coulomb_friction;
            const long double before = velocity;
            long double accel = (push - brake - s.viscous_friction * velocity) / mass;
            accel = (push - brake - s.viscous_friction * (velocity + accel * h / 2)) / mass;
            velocity = std::clamp<long double>(velocity + h * accel, -s.saturation_velocity, s.saturation_velocity);
            if (before * velocity < 0 && s.coulomb_friction > 0) velocity = 0;
            peak_velocity = std::max(peak_velocity, std::fabs(velocity));
            position += h * (before + velocity) / 2;
        }
    }
};

RC_GTEST_PROP(LinearStage, MovesAsTheDifferentialEquationRequires, ()) {
    LinearStageSettings s;
    s.viscous_friction = *rc::gen::element(0.0, 2.0, 50.0);
    s.coulomb_friction = *rc::gen::element(0.0, 0.3);
    s.load_mass_ratio = *rc::gen::element(0.0, 2.0);
    s.saturation_velocity = *rc::gen::element(0.2, 2.0);
    Rig rig(s);
    rig.kernel.start();
    Stepped stepped{s};
    for (int i = 0; i < 6; ++i) {
        const double volts = *rc::gen::inRange(-12'000, 12'001) * 1e-3 * *rc::gen::element(1.0, 0.01);
        rig.volts(volts);
        stepped.volts = volts;
        const double time = 1e-4 * *rc::gen::inRange(1, 300);
        rig.run(time);
        stepped.run(time);
        // At a reversal or at the saturation velocity, the steps have an error of one step: 0.25 us of 50 m/s2 persist
        // for the rest of the run.
        RC_ASSERT(std::fabs(rig.velocity() - static_cast<double>(stepped.velocity)) < 5e-5);
        RC_ASSERT(std::fabs(rig.nm() - static_cast<double>(stepped.position * 1e9L)) < 5e-5 * 0.15 * 1e9);
        if (s.coulomb_friction == 0 && s.viscous_friction == 0 && stepped.peak_velocity < s.saturation_velocity)
            RC_ASSERT(std::fabs(rig.nm() - static_cast<double>(stepped.position * 1e9L)) < 0.01);
    }
}

RC_GTEST_PROP(LinearStage, IsWhereItIsHoweverOftenItIsAsked, ()) {
    LinearStageSettings s;
    s.viscous_friction = *rc::gen::element(0.0, 7.0);
    s.coulomb_friction = *rc::gen::element(0.0, 0.1);
    Rig seldom(s), often(s);
    seldom.kernel.start();
    often.kernel.start();
    for (int i = 0; i < 5; ++i) {
        const double volts = *rc::gen::inRange(-10'000, 10'001) * 1e-4;
        const std::int64_t ticks = *rc::gen::inRange<std::int64_t>(1, 300'000'000);
        seldom.volts(volts);
        often.volts(volts);
        const Instant until = seldom.kernel.now() + Duration{ticks};
        seldom.kernel.run_until(until);
        while (often.kernel.now() < until) {
            const Instant from = often.kernel.now();
            often.kernel.run_until(std::min(until, from + Duration{*rc::gen::inRange<std::int64_t>(1, 100'000'000)}));
            std::int64_t before = often.count();
            if (often.velocity() == 0) continue;
            for (int k = 0; k < 3; ++k) RC_ASSERT(often.count() == before);
        }
        RC_ASSERT(seldom.count() == often.count());
        RC_ASSERT(seldom.kernel.state_hash() == often.kernel.state_hash());
    }
}

TEST(LinearStage, GainsTheWorkOfTheForceMinusFriction) {
    LinearStageSettings s;
    s.coulomb_friction = 0.5;
    Rig rig(s);
    rig.kernel.start();
    rig.volts(2);
    rig.run(0.1);
    const double way = rig.nm() * 1e-9;
    EXPECT_NEAR(rig.velocity() * rig.velocity() / 2, (10 - 0.5) * way, 1e-12);
    EXPECT_NEAR(rig.velocity(), 0.95, 1e-9);
    EXPECT_NEAR(rig.stage.accel(), 9.5, 1e-9);
    rig.volts(0);
    rig.run(3);
    EXPECT_EQ(rig.velocity(), 0);
    // Friction has dissipated all of the work.
    EXPECT_NEAR(rig.nm() * 1e-9 * 0.5, 10 * way, 1e-8);
    const std::uint64_t events = rig.kernel.events();
    rig.run(1'000);
    EXPECT_EQ(rig.kernel.events(), events) << "a stage that stands costs nothing";
}

TEST(LinearStage, ViscousFrictionLeadsToTheVelocityAtWhichItEqualsTheForce) {
    LinearStageSettings s;
    s.viscous_friction = 20;
    Rig rig(s);
    rig.kernel.start();
    rig.volts(1);
    rig.run(1);
    EXPECT_NEAR(rig.velocity(), 0.25, 1e-8);
    rig.volts(0);
    rig.run(0.1);
    EXPECT_NEAR(rig.velocity(), 0.25 * std::exp(-2.0), 1e-6);
}

TEST(LinearStage, SaturationVelocityAndCurrentLimitAreKept) {
    Rig rig;
    rig.kernel.start();
    rig.volts(100);
    rig.run(0.02);
    EXPECT_NEAR(rig.velocity(), 1, 1e-9) << "50 m/s2 at the current limit";
    rig.run(0.2);
    EXPECT_NEAR(rig.velocity(), 2, 1e-12);
    const std::int64_t there = rig.count();
    rig.run(0.1);
    EXPECT_NEAR(static_cast<double>(rig.count() - there), 2e8 * 1024, 1);
}

struct RecordingListener final : sim::PositionListener, sim::EdgeListener {
    void crossed(Instant now) override { at.push_back(now); }
    void rate_changed(double before, double, Instant now) override {
        if (!rates.empty() && rates.back() == before) return;
        rates.push_back(before);
        reported.push_back(now);
    }
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            edge_at.push_back(batch.origin + batch.tick * batch.at[i]);
            counts.push_back(batch.first_count + batch.step * static_cast<std::int64_t>(i));
        }
    }
    std::vector<Instant> at, reported, edge_at;
    std::vector<double> rates;
    std::vector<std::int64_t> counts;
};

RC_GTEST_PROP(LinearStage, NotifiesAWatchAtTheExactTick, ()) {
    LinearStageSettings s;
    s.viscous_friction = *rc::gen::element(0.0, 30.0);
    Rig rig(s);
    RecordingListener listener;
    const int slot = rig.stage.add_listener(listener);
    rig.kernel.start();
    const int way = *rc::gen::element(1, -1);
    rig.volts(way * *rc::gen::element(10.0, 0.1, 0.001));
    std::int64_t there = 0;
    for (int i = 0; i < 4; ++i) {
        there += *rc::gen::element<std::int64_t>(1, 3, 1'000'003, 2'000'000'011);
        const std::int64_t count = way * there;
        rig.stage.watch(slot, way > 0 ? sim::unwatched_below : count, way > 0 ? count : sim::unwatched_above);
        listener.at.clear();
        for (int k = 0; k < 100'000 && listener.at.empty(); ++k) rig.run(1e-3);
        RC_ASSERT(listener.at.size() == 1u);
        // This rig has already passed the reported instant; a second rig stops one tick before it and at it.
        Rig again(s);
        again.kernel.start();
        again.volts(rig.stage.volts());
        again.kernel.run_until(listener.at[0] - Duration{1});
        const std::int64_t before = again.count();
        again.kernel.run_until(listener.at[0]);
        RC_ASSERT(before * way < there);
        RC_ASSERT(again.count() * way >= there);
        there = std::max(there, way * rig.count());
    }
}

TEST(LinearStage, DeliversEveryEdgeInOrderAtItsTick) {
    Rig rig;
    RecordingListener listener;
    rig.kernel.start();
    rig.stage.set_edge_listener(&listener);
    for (const double volts : {0.001, -0.002, 0.003}) {
        rig.volts(volts);
        rig.run(2e-4);
    }
    std::int64_t count = 0;
    for (std::size_t i = 0; i < listener.counts.size(); ++i) {
        EXPECT_EQ(std::abs(listener.counts[i] - count), 1);
        count = listener.counts[i];
        if (i > 0) {
            EXPECT_LE(listener.edge_at[i - 1], listener.edge_at[i]);
        }
    }
    EXPECT_EQ(count, rig.count());
    EXPECT_GT(listener.counts.size(), 100u);
    Rig again;
    again.kernel.start();
    again.volts(0.001);
    again.kernel.run_until(listener.edge_at[20] - Duration{1});
    EXPECT_EQ(again.count(), listener.counts[20] - 1);
    again.kernel.run_until(listener.edge_at[20]);
    EXPECT_EQ(again.count(), listener.counts[20]);
}

TEST(LinearStage, IsExactAfterAnHourOnAMetre) {
    Rig rig;
    rig.kernel.start();
    rig.volts(0.002);  // 0.01 m/s2
    rig.run(0.02);
    rig.volts(0);
    const double velocity = rig.velocity();
    EXPECT_NEAR(velocity, 2e-4, 1e-13);
    const std::int64_t from = rig.count();
    const Instant at = rig.kernel.now();
    std::int64_t last = from;
    for (int i = 1; i <= 3'600; ++i) {
        rig.kernel.run_until(at + whole_seconds(i));
        const auto expected = from + static_cast<std::int64_t>(static_cast<long double>(rig.stage.rate(at)) * i);
        EXPECT_NEAR(static_cast<double>(rig.count() - expected), 0, 2);
        EXPECT_GT(rig.count(), last);
        last = rig.count();
    }
    EXPECT_NEAR(rig.nm(), 0.72e9, 3e3);
}

TEST(LinearStage, WatchedRatesAreReportedAtTheirTick) {
    Rig rig;
    RecordingListener listener;
    rig.stage.add_listener(listener);
    rig.stage.watch_rate(0.1e9 * 1024);
    rig.kernel.start();
    rig.volts(1);
    rig.run(0.1);
    rig.volts(-1);
    rig.run(0.1);
    ASSERT_GE(listener.reported.size(), 3u);
    EXPECT_NEAR(to_seconds(listener.reported[0]), 0.02, 2e-10) << "0.1 m/s at 5 m/s2";
    EXPECT_NEAR(to_seconds(listener.reported[2]), 0.18, 2e-10);
}

TEST(LinearStage, StopsAtItsEndsOfTravelAndMovesAwayFromThem) {
    LinearStageSettings s;
    s.hard_stop_plus_nm = 1'000'000;
    s.hard_stop_minus_nm = -200'000;
    Rig rig(s);
    rig.kernel.start();
    rig.volts(1);
    rig.run(1);
    EXPECT_EQ(rig.count(), 1'000'000 * 1024);
    EXPECT_EQ(rig.stage.blocked(), 1);
    EXPECT_EQ(rig.velocity(), 0);
    ASSERT_EQ(rig.kernel.conditions().size(), 1u);
    EXPECT_NE(describe(rig.kernel.conditions()[0], "x")
                  .find("stage x: at 0.020000 s it hit its plus hard stop at 1000000 nm"),
              std::string::npos);
    rig.volts(2);
    rig.run(1);
    EXPECT_EQ(rig.kernel.conditions().size(), 1u);
    rig.volts(-1);
    rig.run(1e-3);
    EXPECT_EQ(rig.stage.blocked(), 0);
    EXPECT_LT(rig.count(), 1'000'000 * 1024);
    rig.run(1);
    EXPECT_EQ(rig.count(), -200'000 * 1024);
    EXPECT_EQ(rig.kernel.conditions().size(), 2u);
}

TEST(LinearStage, AcceptsFaultsThatStallPushBrakeAndLoadIt) {
    Rig rig;
    rig.kernel.start();
    const auto fault = [&](std::string_view name, double value) {
        return rig.stage.fault(name, value, rig.kernel.now());
    };
    rig.volts(1);
    rig.run(0.01);
    EXPECT_TRUE(fault("motor.stall", 1));
    const std::int64_t there = rig.count();
    rig.run(1);
    EXPECT_EQ(rig.count(), there);
    EXPECT_TRUE(fault("motor.push", -1'000));
    EXPECT_EQ(rig.count(), there - 1'024'000);
    EXPECT_TRUE(fault("motor.stall", 0));
    EXPECT_TRUE(fault("motor.friction", 6));
    rig.run(1);
    EXPECT_EQ(rig.count(), there - 1'024'000) << "5 m/s2 do not overcome 6";
    EXPECT_TRUE(fault("motor.friction", 1));
    EXPECT_TRUE(fault("motor.load", 3));
    rig.run(0.01);
    EXPECT_NEAR(rig.velocity(), 0.01 * (5 - 1) / 4, 1e-9);
    EXPECT_FALSE(fault("motor.load", -1));
    EXPECT_FALSE(fault("motor.friction", std::nan("")));
    EXPECT_FALSE(fault("motor.push", 1e300));
    EXPECT_FALSE(fault("motor.fly", 1));
    for (const char* name : {"motor.stall", "motor.push", "motor.friction", "motor.load"})
        EXPECT_TRUE(fault(name, 0)) << name;
}

TEST(LinearStage, ARestoredSnapshotContinuesIdenticallyWithoutAllocation) {
    LinearStageSettings s;
    s.viscous_friction = 3;
    s.coulomb_friction = 0.1;
    Rig rig(s);
    RecordingListener listener;
    listener.at.reserve(100);
    const int slot = rig.stage.add_listener(listener);
    rig.kernel.start();
    rig.volts(0.5);
    rig.run(0.0123);
    rig.stage.watch(slot, -5, 9'000'000'000);
    const sim::Snapshot snapshot = rig.kernel.snapshot();
    std::int64_t counts[2] = {};
    std::uint64_t hashes[2] = {};
    for (int i = 0; i < 2; ++i) {
        rig.kernel.restore(snapshot);
        listener.rates.clear();
        listener.rates.reserve(100'000);
        listener.reported.reserve(100'000);
        const std::uint64_t before = sim::allocations();
        rig.run(0.1);
        rig.volts(-0.7);
        rig.run(0.2);
        EXPECT_EQ(sim::allocations(), before);
        counts[i] = rig.count();
        hashes[i] = rig.kernel.state_hash();
    }
    EXPECT_EQ(counts[0], counts[1]);
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace motionrack::parts
