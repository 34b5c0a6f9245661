// Conveyors in virtual time: instants at which ranges are left, manual velocity changes, parts at a sensor, words on
// wires.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <motionrack/sim/parts/conveyor_drive.hpp>
#include <motionrack/sim/parts/conveyor_position.hpp>
#include <motionrack/sim/parts/part_sensor.hpp>
#include <motionrack/sim/parts/serial_word_source.hpp>
#include <vector>

namespace motionrack::parts {
namespace {

constexpr double never_s = std::numeric_limits<double>::infinity();

Conveyor track_of(std::vector<VelocityPoint> profile) {
    return *Conveyor::make({.profile = std::move(profile)});
}

TEST(Conveyor, ReportsWhenItLeavesARange) {
    const Conveyor even = track_of({{0, 100}});
    EXPECT_DOUBLE_EQ(even.leaves(0, -1, 5), 0.05);
    EXPECT_DOUBLE_EQ(even.leaves(0.02, -1, 5), 0.05);
    EXPECT_EQ(even.leaves(0, -1, never_s), never_s);
    const Conveyor back = track_of({{0, 0}, {1, 100}, {3, -100}});  // reverses at 2 s, after 100 mm
    EXPECT_DOUBLE_EQ(back.leaves(0, -1, 50), 1);
    EXPECT_DOUBLE_EQ(back.leaves(2, 50, 101), 3);
    EXPECT_DOUBLE_EQ(back.leaves(0, -100, 101), 4.5) << "it never comes to 101";
    const Conveyor stationary = track_of({{0, 0}});
    EXPECT_EQ(stationary.leaves(0, -1e-9, 1e-9), never_s);
}

TEST(Conveyor, ContinuesFromItsPositionWhenItsVelocityChanges) {
    Conveyor track = track_of({{0, 100}});
    track.drive(1, -20);
    EXPECT_DOUBLE_EQ(track.travel(1), 100);
    EXPECT_DOUBLE_EQ(track.travel(2), 80);
    EXPECT_DOUBLE_EQ(track.velocity(2), -20);
    EXPECT_DOUBLE_EQ(track.leaves(2, 70, 90), 2.5);
    track.follow_profile(2);
    EXPECT_DOUBLE_EQ(track.travel(3), 180);
    EXPECT_DOUBLE_EQ(track.velocity(3), 100);
}

TEST(Conveyor, StopsWithItsDeceleration) {
    for (const double way : {1.0, -1.0}) {
        Conveyor track = *Conveyor::make({.profile = {{0, 100 * way}}, .deceleration = 200});
        track.stop(1);  // decelerates for 0.5 s, over 25 mm
        EXPECT_DOUBLE_EQ(track.velocity(1), 100 * way);
        EXPECT_DOUBLE_EQ(track.velocity(1.25), 50 * way);
        EXPECT_DOUBLE_EQ(track.travel(1.25), 118.75 * way);
        EXPECT_DOUBLE_EQ(track.velocity(1.5), 0);
        EXPECT_DOUBLE_EQ(track.travel(1.5), 125 * way);
        EXPECT_DOUBLE_EQ(track.travel(9), 125 * way);
        EXPECT_DOUBLE_EQ(track.leaves(1, way > 0 ? -1 : -118.75, way > 0 ? 118.75 : 1), 1.25);
        EXPECT_EQ(track.leaves(1, -126, 126), never_s);
        track.follow_profile(2);
        EXPECT_DOUBLE_EQ(track.travel(3), 225 * way);
    }
}

struct Edges final : sim::EdgeListener {
    struct Edge {
        Instant at;
        std::int64_t count;
    };
    std::vector<Edge> all;
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i)
            all.push_back({batch.origin + batch.at[i] * batch.tick,
                           batch.first_count + static_cast<std::int64_t>(i) * batch.step});
    }
};

TEST(ConveyorPosition, MakesEveryEdgeAtItsInstantThereAndBack) {
    for (const double per_unit : {37.0, -37.0}) {
        sim::Kernel world;
        ConveyorDrive drive(world, "belt", track_of({{0, 0}, {0.1, 100}, {0.3, -100}}));
        ConveyorPosition motion(world, "counts", drive.track(), per_unit);
        Edges edges;
        world.start();
        motion.set_edge_listener(&edges);
        for (int i = 1; i <= 40; ++i) world.run_until(milliseconds(10 * i));
        ASSERT_GT(edges.all.size(), 700u);
        std::int64_t before = motion.count(Instant{0});
        Instant last{0};
        for (const Edges::Edge& edge : edges.all) {
            EXPECT_EQ(std::llabs(edge.count - before), 1);
            EXPECT_GE(edge.at, last);
            EXPECT_EQ(motion.count(edge.at), edge.count);
            EXPECT_EQ(motion.count(edge.at - Duration{1}), before);
            before = edge.count;
            last = edge.at;
        }
        EXPECT_EQ(before, motion.count(world.now()));
    }
}

TEST(ConveyorPosition, ListenersReceiveBothRatesInCountsPerSecondWhenTheVelocityChanges) {
    struct RatesListener final : sim::PositionListener {
        void crossed(Instant) override {}
        void rate_changed(double from, double to, Instant) override { before = from, after = to; }
        double before = 0, after = 0;
    };
    sim::Kernel kernel;
    ConveyorDrive drive(kernel, "belt", track_of({{0, 100}}));
    ConveyorPosition fine(kernel, "fine", drive.track(), 1000), turned(kernel, "turned", drive.track(), -10);
    drive.add(fine);
    drive.add(turned);
    RatesListener of_fine, of_turned;
    fine.add_listener(of_fine);
    turned.add_listener(of_turned);
    kernel.start();
    kernel.run_until(milliseconds(5));
    ASSERT_TRUE(drive.fault("drive.speed", 20, kernel.now()));
    EXPECT_DOUBLE_EQ(of_fine.before, 100'000);
    EXPECT_DOUBLE_EQ(of_fine.after, 20'000);
    EXPECT_DOUBLE_EQ(of_turned.before, -1'000);
    EXPECT_DOUBLE_EQ(of_turned.after, -200);
}

TEST(PartSensor, IsLowWhileAPartIsPresentAndCountsParts) {
    sim::Kernel kernel;
    ConveyorDrive drive(kernel, "belt", track_of({{0, 100}}));
    ConveyorPosition position(kernel, "place", drive.track(), 1000);
    drive.add(position);
    PartSensor sensor(kernel, "sensor", "belt.sensor_n", position, {5'000, 20'000, 8'000});
    kernel.start();
    const sim::WireId wire = kernel.find_wire("belt.sensor_n");
    const auto at = [&](int ms) {
        kernel.run_until(milliseconds(ms));
        return kernel.level(wire);
    };
    EXPECT_EQ(at(49), 1);
    EXPECT_EQ(sensor.parts(kernel.now()), 0);
    EXPECT_EQ(at(51), 0);
    EXPECT_EQ(at(129), 0);
    EXPECT_EQ(at(131), 1);
    EXPECT_EQ(at(251), 0);
    EXPECT_EQ(sensor.parts(kernel.now()), 2);
    ASSERT_TRUE(drive.fault("drive.speed", -100, kernel.now()));
    EXPECT_EQ(at(253), 1) << "the part goes back out of the light";
    EXPECT_EQ(sensor.parts(kernel.now()), 1);
    EXPECT_FALSE(drive.fault("drive.speed", 2e5, kernel.now()));
    EXPECT_FALSE(drive.fault("drive.height", 1, kernel.now()));
}

TEST(SerialWordSource, AWordIsCompleteTheDelayAfterItsReading) {
    sim::Kernel kernel;
    ConveyorDrive drive(kernel, "belt", track_of({{0, 1000}}));
    const SerialPositionSource sender =
        *SerialPositionSource::make(drive.track(), {.bits_per_mm = 1000, .period_us = 50, .delay_us = 120});
    SerialWordSource source(kernel, "sender", "belt", sender);
    kernel.start();
    const sim::WireId word = kernel.find_wire("belt.mcbsp"), frame = kernel.find_wire("belt.mcbsp_frame");
    kernel.run_until(microseconds(169));
    EXPECT_EQ(kernel.level(word), 0);
    kernel.run_until(microseconds(170));
    EXPECT_EQ(kernel.level(word), 50) << "the reading at 50 us";
    EXPECT_EQ(kernel.level(frame), 1) << "the first word was 0 again";
    // The wire carries the words that SerialPositionSource returns for ticks of 10 us.
    std::vector<std::uint32_t> words(100);
    sender.words(0, words);
    for (std::size_t tick = 18; tick < words.size(); ++tick) {
        kernel.run_until(microseconds(static_cast<std::int64_t>(tick) * 10));
        EXPECT_EQ(static_cast<std::uint32_t>(kernel.level(word)), words[tick]) << tick;
    }
}

}  // namespace
}  // namespace motionrack::parts
