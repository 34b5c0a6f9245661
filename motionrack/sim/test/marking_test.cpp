// Mirrors, conveyors, position words, laser and work piece of a marking machine.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <motionrack/sim/parts/marking_station.hpp>
#include <motionrack/sim/parts/serial_position_source.hpp>

namespace motionrack::parts {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> driven(GalvoPair& galvo, const std::vector<std::int32_t>& x) {
    std::vector<double> to_x(x.size()), to_y(x.size());
    galvo.run(x, x, to_x, to_y);
    EXPECT_EQ(to_x, to_y);
    return to_x;
}

TEST(GalvoPair, IdealMirrorsAreAtTheCommandedPosition) {
    GalvoPair galvo;
    EXPECT_EQ(driven(galvo, {1, -5, 100}), (std::vector<double>{1, -5, 100}));
    EXPECT_EQ(galvo.lag_us(), 0);
}

TEST(GalvoPair, ASteadyMovementIsLateByTheLag) {
    GalvoPair galvo({.ideal_mirrors = false, .dead_time_us = 50, .natural_frequency_hz = 2000, .damping_ratio = 0.9});
    std::vector<std::int32_t> ramp(3000);
    for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<std::int32_t>(i) * 40;
    const auto x = driven(galvo, ramp);
    // At the end of tick i, ideal mirrors are at 40 i bits. Holding a value for a tick of 10 us delays it by 5 us on
    // average.
    EXPECT_NEAR((40.0 * 2999 - x.back()) / 40 * 10, galvo.lag_us() - 5, 0.2);
}

TEST(GalvoPair, AStepSettlesOnItsTargetAndKeepsTheVelocityLimit) {
    GalvoPair galvo(
        {.ideal_mirrors = false, .natural_frequency_hz = 1000, .damping_ratio = 1, .max_velocity_bits_ms = 20'000});
    const auto x = driven(galvo, std::vector<std::int32_t>(2000, 10'000));
    double before = 0;
    for (const double at : x) {
        EXPECT_LE(at - before, 200.0000001);
        EXPECT_LE(at, 10'000.001);
        before = at;
    }
    EXPECT_NEAR(x.back(), 10'000, 1e-6);
    EXPECT_FALSE(check({.ideal_mirrors = false, .dead_time_us = nan}));
    EXPECT_FALSE(check({.ideal_mirrors = false, .natural_frequency_hz = 1}));
}

TEST(Conveyor, TravelIsTheIntegralOfTheProfile) {
    const Conveyor track = *Conveyor::make({.profile = {{0, 0}, {1, 100}, {3, 100}, {4, -100}}, .counts_per_unit = 10});
    EXPECT_DOUBLE_EQ(track.travel(0.5), 12.5);
    EXPECT_DOUBLE_EQ(track.travel(1), 50);
    EXPECT_DOUBLE_EQ(track.travel(3), 250);
    EXPECT_DOUBLE_EQ(track.travel(4), 250);
    EXPECT_DOUBLE_EQ(track.travel(5), 150);
    EXPECT_DOUBLE_EQ(track.velocity(3.5), 0);
    std::int32_t counts[2];
    track.counts(100'000, counts);
    EXPECT_EQ(counts[0], 500);
    double sum = 0;
    for (int i = 0; i < 4500; ++i) sum += track.velocity(0.001 * i + 0.0005) * 0.001;
    EXPECT_NEAR(sum, track.travel(4.5), 1e-6);
}

TEST(Conveyor, CountsOfABlockAreThoseOfItsTicksOneByOne) {
    const Conveyor track = *Conveyor::make({.profile = {{0.00105, 30}, {0.002, 300}, {0.00201, -50}, {0.004, -51}},
                                            .counts_per_unit = 777.7,
                                            .jitter_counts = 0.5});
    std::vector<std::int32_t> block(700), one(1);
    track.counts(-50, block);
    for (std::size_t i = 0; i < block.size(); ++i) {
        track.counts(static_cast<std::int64_t>(i) - 50, one);
        ASSERT_EQ(block[i], one[0]) << i;
        EXPECT_NEAR(block[i], track.travel((static_cast<double>(i) - 50) * 1e-5) * 777.7 - 0.5, 1.01) << i;
    }
}

TEST(Conveyor, SlipAndJitterAreOfTheEncoderNotOfTheTravel) {
    const Conveyor track = *Conveyor::make({.counts_per_unit = 1000, .slip = 0.01, .jitter_counts = 3});
    std::vector<std::int32_t> counts(10'000), again(10'000);
    track.counts(500, counts);
    track.counts(500, again);
    EXPECT_EQ(counts, again);
    bool trembles = false;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double seen = static_cast<double>(i + 500) * 1e-5 * 100 * 990;
        EXPECT_NEAR(counts[i], seen, 4);
        trembles = trembles || std::abs(counts[i] - seen) > 2;
    }
    EXPECT_TRUE(trembles);
    EXPECT_DOUBLE_EQ(track.travel(1), 100);
}

TEST(Conveyor, PartAndFieldAreEachOthersInverse) {
    for (const bool rotary : {false, true}) {
        const Conveyor track =
            *Conveyor::make({.rotary = rotary, .direction_deg = 30, .centre_mm = {-50, 3}, .profile = {{0, 36}}});
        const sim::Spot there = track.on_part({7, 8}, 2.5), back = track.in_field(there, 2.5);
        EXPECT_NEAR(back.x, 7, 1e-12);
        EXPECT_NEAR(back.y, 8, 1e-12);
    }
    const Conveyor quarter = *Conveyor::make({.rotary = true, .profile = {{0, 90}}});
    EXPECT_NEAR(quarter.in_field({10, 0}, 1).y, 10, 1e-12) << "counter-clockwise";
    EXPECT_FALSE(Conveyor::make({.profile = {}}));
    EXPECT_FALSE(Conveyor::make({.profile = {{1, 0}, {1, 5}}}));
    EXPECT_FALSE(Conveyor::make({.profile = {{0, nan}}}));
    EXPECT_FALSE(Conveyor::make({.counts_per_unit = 0}));
}

TEST(SerialPositionSource, WordsHaveResolutionPeriodAndDelay) {
    const Conveyor track = *Conveyor::make({.direction_deg = 90, .profile = {{0, 100}}});
    std::vector<std::uint32_t> words(2000);
    SerialPositionSource::make(track, {.bits_per_mm = 1000, .period_us = 50, .delay_us = 120})->words(0, words);
    EXPECT_EQ(static_cast<std::int32_t>(words[11]), -5);  // read at -0.05 ms
    EXPECT_EQ(words[1000], 985u);                         // read at 9.85 ms, available after 9.97 ms
    EXPECT_EQ(words[1001], 985u);
    EXPECT_EQ(words[1002], 990u);
    SerialPositionSource::make(track, {.bits_per_mm = -100, .two_axes = true})->words(0, words);
    EXPECT_EQ(words[1000], 0xFF9C0000u);
    EXPECT_FALSE(SerialPositionSource::make(track, {.bits_per_mm = 0}));
    EXPECT_FALSE(SerialPositionSource::make(track, {.period_us = nan}));
    EXPECT_FALSE(SerialPositionSource::make(*Conveyor::make({.rotary = true}), {.two_axes = true}));
}

/// Expects the share of each tick, 0 .. 1, in which the laser emits light.
void expect_lights(LaserGate& gate, const std::vector<double>& expected) {
    for (std::size_t t = 0; t < expected.size(); ++t) {
        const auto tick = static_cast<std::int64_t>(t);
        double light = 0;
        if (!gate.dark(tick)) gate.shine(tick, [&](LaserGate::Light l) { light += l.to - l.from; });
        EXPECT_NEAR(light, expected[t], 1e-12) << "tick " << t;
    }
}

TEST(LaserGate, LightIsTheGateWithItsDelays) {
    LaserGate gate = *LaserGate::make({});
    gate.change(5, true);
    gate.change(10, false);
    gate.change(12, true);
    gate.change(45, false);
    expect_lights(gate, {0.65, 1, 0.25, 0});
    LaserGate slow = *LaserGate::make({.on_delay_us = 5, .off_delay_us = 1});
    slow.change(0, true);
    slow.change(6, false);  // 3 us: too short for light
    slow.change(20, true);
    slow.change(40, false);
    expect_lights(slow, {0, 0.5, 0.1});
    EXPECT_FALSE(LaserGate::make({.power_w = nan}));
}

TEST(Workpiece, StraightAndEvenIsOneSegmentAndACircleIsNot) {
    Workpiece piece({.tolerance_mm = 0.001});
    for (int i = 0; i < 1000; ++i) piece.add({i * 0.01, 0}, {(i + 1) * 0.01, 0}, 0.001, i * 1e-5);
    for (int i = 0; i < 1000; ++i) piece.add({10 + i * 0.01, 0}, {10 + (i + 1) * 0.01, 0}, 0.002, 0.01 + i * 1e-5);
    piece.finish();
    ASSERT_EQ(piece.points().size(), 3u);
    EXPECT_NEAR(piece.points()[1].j_per_mm, 0.1, 1e-9);
    EXPECT_NEAR(piece.points()[2].j_per_mm, 0.2, 1e-9);
    EXPECT_NEAR(piece.length_mm(), 20, 1e-9);
    EXPECT_NEAR(piece.energy_j(), 3, 1e-9);
    Workpiece round({.tolerance_mm = 0.001});
    const auto at = [](int i) { return sim::Spot{5 * std::cos(i * 0.001), 5 * std::sin(i * 0.001)}; };
    for (int i = 0; i < 6283; ++i) round.add(at(i), at(i + 1), 0.001, i * 1e-5);
    round.finish();
    EXPECT_GT(round.points().size(), 100u);
    EXPECT_LT(round.points().size(), 1000u);
    for (std::size_t i = 1; i < round.points().size(); ++i) {
        const sim::Spot a = round.points()[i - 1].at, b = round.points()[i].at;
        EXPECT_GT(std::hypot((a.x + b.x) / 2, (a.y + b.y) / 2), 5 - 0.0011);
    }
}

TEST(Workpiece, PointsBeyondItsCapacityAreCounted) {
    Workpiece piece({.max_points = 10});
    for (int i = 0; i < 20; ++i) piece.add({i * 1.0, 0}, {i + 0.5, 0}, 1, i);
    piece.finish();
    EXPECT_EQ(piece.points().size(), 10u);
    EXPECT_EQ(piece.lost_points(), 30u);
    EXPECT_NEAR(piece.length_mm(), 10, 1e-9);
}

TEST(Workpiece, TheDeviationFromADrawingNamesTheMaximumAndMissingParts) {
    const std::vector<DrawnSegment> square = {
        {{0, 0}, {10, 0}}, {{10, 0}, {10, 10}}, {{10, 10}, {0, 10}}, {{0, 10}, {0, 0}}};
    Workpiece piece;
    piece.add({0, 0}, {10, 0.3}, 1, 0);
    piece.add({10, 0.3}, {10, 10}, 1, 1);
    piece.add({10, 10}, {0, 10}, 1, 2);
    piece.finish();
    const Deviation d = piece.compare(square);
    EXPECT_NEAR(d.max_mm, 0.29, 0.011);
    EXPECT_GT(d.max_at.x, 9);
    EXPECT_EQ(d.max_s, 0);
    EXPECT_GT(d.rms_mm, 0.05);
    EXPECT_NEAR(d.missing_mm, 10 + 6.4,
                0.5);  // the left side, and the part of the slanted one with a deviation above 0.1 mm
    EXPECT_DOUBLE_EQ(NearestSegment(square).distance({-30, 5}), 30);
    EXPECT_DOUBLE_EQ(NearestSegment(square).distance({5, 5}), 5);
    for (int i = 0; i < 500; ++i) {
        const sim::Spot p{std::fmod(i * 7.13, 40) - 15, std::fmod(i * 3.77, 40) - 15};
        double best = 1e9;
        for (const DrawnSegment& s : square) best = std::min(best, NearestSegment(std::span(&s, 1)).distance(p));
        EXPECT_DOUBLE_EQ(NearestSegment(square).distance(p), best);
    }
}

TEST(Nearest, IsThatOfASearchThroughAllOfThemToTheLastBit) {
    std::vector<DrawnSegment> many;
    const auto position = [](int i, double size) {
        return sim::Spot{std::fmod(i * 7.13, size), std::fmod(i * i * 0.377, size)};
    };
    for (int i = 0; i < 300; ++i) {
        const sim::Spot at = position(i, 50),
                        to = i % 40 == 0 ? position(i + 7, 50) : sim::Spot{at.x + 0.3, at.y - 0.2};
        many.push_back({at, to});
    }
    const NearestSegment all(many);
    for (int i = 0; i < 2000; ++i) {
        const sim::Spot p = i % 3 == 0 ? many[static_cast<std::size_t>(i) % many.size()].to
                                       : sim::Spot{position(i, 90).x - 20, position(i + 1, 90).y - 20};
        double best = std::numeric_limits<double>::infinity();
        for (const DrawnSegment& s : many) best = std::min(best, NearestSegment(std::span(&s, 1)).distance(p));
        ASSERT_EQ(all.distance(p), best) << p.x << ' ' << p.y;
    }
}

}  // namespace
}  // namespace motionrack::parts
