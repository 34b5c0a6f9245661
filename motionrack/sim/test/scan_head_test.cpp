// A scan head on wires: ticks from changes of lines, idle without cost, no allocation in a run.
#include <gtest/gtest.h>

#include <motionrack/sim/parts/scan_head.hpp>
#include <motionrack/sim/test/allocation_count.hpp>

namespace motionrack::parts {
namespace {

/// Returns a scan head with 1000 bits/mm above a stationary part.
StationSettings plain_head() {
    StationSettings out;
    out.bits_per_mm = 1000;
    out.track.profile = {{0, 0}};
    return out;
}

struct Bench {
    explicit Bench(const StationSettings& settings = plain_head())
        : x(kernel.add_wire("x", 0, 20)),
          y(kernel.add_wire("y", 0, 20)),
          laser(kernel.add_wire("laser", 0)),
          head(kernel, "head", {x, y, laser}, *MarkingStation::make(settings)) {
        kernel.start();
        head.begin();
    }
    /// Runs up to an instant, in half microseconds, and forces a wire at it.
    void at(std::int64_t half_us, sim::WireId wire, int level) {
        kernel.run_until(nanoseconds(500 * half_us));
        kernel.force(wire, level);
        kernel.settle();
    }
    sim::Kernel kernel;
    sim::WireId x, y, laser;
    ScanHead head;
};

TEST(ScanHead, MarksThePathOfTheMirrorsWhileTheGateIsOn) {
    Bench bench;
    bench.at(205, bench.laser, 1);  // in tick 10
    for (int i = 1; i <= 100; ++i) bench.at(20 * (10 + i), bench.x, 10 * i);
    bench.at(20 * 111 + 10, bench.laser, 0);
    bench.kernel.run_until(milliseconds(2));
    const Workpiece& marked = bench.head.station().workpiece();
    EXPECT_NEAR(marked.length_mm(), 1, 1e-9);
    EXPECT_NEAR(marked.energy_j(), 20 * (20 * 111 + 10 - 205) * 0.5e-6, 1e-12);
    EXPECT_FALSE(bench.head.gate());
    EXPECT_DOUBLE_EQ(bench.head.station().spot().x, 1);
}

TEST(ScanHead, IsTheSameHoweverARunIsDivided) {
    Bench whole, cut;
    for (Bench* bench : {&whole, &cut}) {
        bench->at(100, bench->laser, 1);
        bench->at(200, bench->x, 5'000);
    }
    whole.kernel.run_until(whole_seconds(7));
    for (int i = 1; i <= 7'000; ++i) cut.kernel.run_until(milliseconds(i));
    whole.at(14'000'200, whole.laser, 0);
    cut.at(14'000'200, cut.laser, 0);
    whole.kernel.run_until(whole_seconds(20));
    for (int i = 71; i <= 200; ++i) cut.kernel.run_until(milliseconds(100 * i));
    EXPECT_EQ(whole.head.station().workpiece().energy_j(), cut.head.station().workpiece().energy_j());
    EXPECT_EQ(whole.kernel.state_hash(), cut.kernel.state_hash());
}

TEST(ScanHead, AllocatesNothingInARunAndCountsPointsBeyondItsCapacity) {
    StationSettings settings = plain_head();
    settings.galvo.ideal_mirrors = false;
    settings.galvo.dead_time_us = 70;
    settings.laser.on_delay_us = 20;
    settings.laser.off_delay_us = 30;
    settings.workpiece.max_points = 100;
    Bench bench(settings);
    const std::uint64_t before = sim::allocations();
    for (int i = 0; i < 2'000; ++i) {
        bench.at(200 * i + 1, bench.laser, i % 2);
        bench.at(200 * i + 20, i % 3 ? bench.x : bench.y, 37 * i % 2'000);
    }
    EXPECT_EQ(sim::allocations(), before);
    EXPECT_EQ(bench.head.station().workpiece().points().size(), 100u);
    EXPECT_GT(bench.head.station().workpiece().lost_points(), 0u);
}

}  // namespace
}  // namespace motionrack::parts
