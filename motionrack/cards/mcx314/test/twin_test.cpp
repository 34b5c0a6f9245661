// Tests of the twin against the maker's documents: formulas, accuracy classes and the sample program's closed contour.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/cards/mcx314/test/twin_host.hpp>
#include <random>
#include <string>
#include <tests/environment.hpp>
#include <vector>

namespace motionrack::mcx314::twin {
namespace {

constexpr unsigned x = 1, y = 2, z = 4;
constexpr double second = 8e6;

// Returns the positions of the four axes after each tick with a pulse.
std::vector<std::array<std::int64_t, 4>> places(const std::vector<Pulse>& pulses) {
    std::vector<std::array<std::int64_t, 4>> out(1);
    std::int64_t tick = -1;
    for (const Pulse& p : pulses) {
        if (p.tick != tick) out.push_back(out.back());
        tick = p.tick;
        out.back()[static_cast<std::size_t>(p.axis)] += p.direction;
    }
    return out;
}

TEST(Mcx314Twin, DrivesTheDocumentedTrapezoidInTheTimeOfTheFormula) {
    // R 800,000 (M = 10), A = 200: 250,000 pps/s from 1,000 to 40,000 pps in 0.156 s and 3,198 pulses; 80,000 pulses
    // in 2.1521 s. Fewer pulses shorten the time at 40,000 pps.
    const std::int64_t pulses = thorough() ? 80'000 : 10'000;
    Host host;
    host.speeds(x, 800'000, 4000, 100, 200, 200, 1010, 0);
    host.data(x, 0x06, pulses);
    host.command(x, 0x20);
    std::int64_t accelerating = 0;
    while (host.twin.axis(0).gen.speed < 4000) host.twin.tick(), ++accelerating;
    EXPECT_NEAR(static_cast<double>(accelerating) / second, 0.156, 1e-5);
    EXPECT_NEAR(static_cast<double>(host.twin.count(0)), 3198, 2);
    const std::int64_t rest = host.until_idle(100'000'000);
    EXPECT_NEAR(static_cast<double>(accelerating + rest) / second,
                2.1521 - static_cast<double>(80'000 - pulses) / 40'000, 0.002);
    EXPECT_EQ(host.twin.count(0), pulses);
}

TEST(Mcx314Twin, DrivesTheDocumentedSCurveInTheTimeOfTheFormula) {
    // K 1010, M = 10: 618,812 pps/s2 a second; a complete S from 1,000 to 40,000 pps takes 0.50209 s and 10,292.9
    // pulses.
    Host host;
    host.speeds(x, 800'000, 4000, 100, 200, 200, 1010, 0);
    host.mode(x, 3, 4);
    host.command(x, 0x22);
    std::int64_t accelerating = 0, max_rate = 0;
    while (host.twin.axis(0).gen.speed < 4000 && accelerating < 10'000'000) {
        host.twin.tick(), ++accelerating;
        max_rate = std::max(max_rate, host.twin.axis(0).gen.rate);
    }
    EXPECT_NEAR(static_cast<double>(accelerating) / second, 0.50209, 0.01);
    EXPECT_NEAR(static_cast<double>(host.twin.count(0)), 10'292.9, 200);
    EXPECT_NEAR(static_cast<double>(max_rate), 124.3, 1);
}

TEST(Mcx314Twin, MakesExactlyTheFixedPulsesWhateverTheParameters) {
    std::mt19937 random(static_cast<std::uint32_t>(seed_from_environment(20'240'314)));
    const auto count = static_cast<int>(trials("MOTIONRACK_PROGRAMS", 60, 400));
    const auto pick = [&](std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
    };
    for (int run = 0; run < count; ++run) {
        Host host;
        host.speeds(x, pick(16'000, 400'000), pick(1000, 8000), pick(400, 8000), pick(1, 8000), pick(1, 8000),
                    pick(1, 300), pick(0, 20));
        host.mode(x, 3, static_cast<unsigned>(pick(0, 7)));
        const std::int64_t pulses = pick(0, 2000);
        host.data(x, 0x06, pulses);
        host.data(x, 0x07, pick(0, 2500));
        host.command(x, run % 2 ? 0x21 : 0x20);
        host.until_idle(20'000'000);
        ASSERT_FALSE(host.twin.any_driving()) << "run " << run;
        ASSERT_EQ(host.twin.count(0), run % 2 ? -pulses : pulses) << "run " << run;
        ASSERT_EQ(static_cast<std::int64_t>(host.twin.pulses().size()), pulses) << "run " << run;
    }
}

TEST(Mcx314Twin, ClosesTheDocumentedContour) {
    Host host;
    host.speeds(x | y, 16'000, 8000, 8000, 8000, 8000, 1, 0);
    struct Row {
        int code;
        std::int64_t cx, cy, px, py;
    };
    const std::vector<Row> rows{
        {0x30, 0, 0, 4500, 0},  {0x33, 0, 1500, 1500, 1500},    {0x30, 0, 0, 0, 1500},  {0x33, -1500, 0, -1500, 1500},
        {0x30, 0, 0, -4500, 0}, {0x33, 0, -1500, -1500, -1500}, {0x30, 0, 0, 0, -1500}, {0x33, 1500, 0, 1500, -1500}};
    const std::vector<std::array<std::int64_t, 2>> nodes{{4500, 0}, {6000, 1500},  {6000, 3000},  {4500, 4500},
                                                         {0, 4500}, {-1500, 3000}, {-1500, 1500}, {0, 0}};
    host.twin.write(10, 0x0004);
    std::size_t node = 0;
    for (const Row& row : rows) {
        while (host.twin.any_driving() && !(host.twin.peek(0) & 0x0200)) host.twin.tick();
        if (&row - rows.data() >= 2) {
            EXPECT_EQ(host.twin.count(0), nodes[node][0]) << "node " << node;
            EXPECT_EQ(host.twin.count(1), nodes[node][1]) << "node " << node;
            ++node;
        }
        host.data(x, 0x08, row.cx);
        host.data(y, 0x08, row.cy);
        host.data(x, 0x06, row.px);
        host.data(y, 0x06, row.py);
        host.command(0, row.code);
    }
    host.until_idle(1'000'000);
    EXPECT_EQ(host.twin.count(0), 0);
    EXPECT_EQ(host.twin.count(1), 0);
    // The chain has no gap: at R / V = 2 every second tick has a pulse, from the first to the last.
    const std::vector<Pulse>& pulses = host.twin.pulses();
    for (std::size_t i = 1; i < pulses.size(); ++i) ASSERT_LE(pulses[i].tick - pulses[i - 1].tick, 2);
}

TEST(Mcx314Twin, KeepsALineWithinHalfAPulse) {
    std::mt19937 random(7);
    for (int run = 0; run < 200; ++run) {
        Host host;
        host.speeds(x | y | z, 16'000, 8000, 8000, 1, 1, 1, 0);
        host.twin.write(10, 0x0024);
        std::array<std::int64_t, 3> finish{};
        std::int64_t max_finish = 0;
        for (unsigned a = 0; a < 3; ++a) {
            finish[a] = static_cast<std::int64_t>(random() % 601) - 300;
            max_finish = std::max<std::int64_t>(max_finish, std::abs(finish[a]));
            host.data(1u << a, 0x06, finish[a]);
        }
        host.command(0, 0x31);
        host.until_idle(10'000);
        const auto at = places(host.twin.pulses());
        ASSERT_EQ(static_cast<std::int64_t>(at.size()), max_finish + 1);
        for (std::size_t n = 0; n < at.size(); ++n)
            // |place - n * finish / max_finish| <= 1/2, in integers
            for (std::size_t a = 0; a < 3 && max_finish > 0; ++a)
                ASSERT_LE(std::abs(2 * (at[n][a] * max_finish - static_cast<std::int64_t>(n) * finish[a])), max_finish);
        for (std::size_t a = 0; a < 3; ++a) ASSERT_EQ(at.back()[a], finish[a]);
    }
}

TEST(Mcx314Twin, KeepsACircleWithinHalfAPulseAndReturnsToItsStart) {
    for (std::int64_t cx = -12; cx <= 60; cx += 3) {
        for (std::int64_t cy = -40; cy <= 9; cy += 7) {
            for (int code : {0x32, 0x33}) {
                Host host;
                host.speeds(x | y, 16'000, 8000, 8000, 1, 1, 1, 0);
                host.twin.write(10, 0x0004);
                host.data(x, 0x08, cx);
                host.data(y, 0x08, cy);
                host.command(0, code);
                host.until_idle(10'000);
                const double r = std::sqrt(static_cast<double>(cx * cx + cy * cy));
                ASSERT_EQ(host.twin.count(0), 0) << cx << ' ' << cy;
                ASSERT_EQ(host.twin.count(1), 0) << cx << ' ' << cy;
                double turned = 0;
                const auto at = places(host.twin.pulses());
                for (std::size_t n = 0; n < at.size(); ++n) {
                    const auto px = static_cast<double>(at[n][0] - cx), py = static_cast<double>(at[n][1] - cy);
                    ASSERT_LT(std::abs(std::hypot(px, py) - r), 0.5 + 1e-9) << cx << ' ' << cy << " pulse " << n;
                    if (n == 0) continue;
                    const auto qx = static_cast<double>(at[n - 1][0] - cx), qy = static_cast<double>(at[n - 1][1] - cy);
                    turned += std::atan2(qx * py - qy * px, qx * px + qy * py);
                }
                if (r > 0) {
                    ASSERT_NEAR(turned, code == 0x33 ? 2 * M_PI : -2 * M_PI, 1e-6) << cx << ' ' << cy;
                }
            }
        }
    }
}

TEST(Mcx314Twin, StretchesThePulsePeriodWhenAxesStepTogether) {
    // On a line at 45 degrees both axes step at every basic pulse, so the constant vector speed uses R2 = 1.41421 R1
    // from the second pulse on.
    Host host;
    host.data(x | y, 0x00, 800'000);
    host.speeds(x, 800'000, 8000, 8000, 1, 1, 1, 0);
    host.data(y, 0x00, 1'131'371);
    host.twin.write(10, 0x0104);
    host.data(x | y, 0x06, 1000);
    host.command(0, 0x30);
    const std::int64_t ticks = host.until_idle(1'000'000);
    EXPECT_NEAR(static_cast<double>(ticks), 1000 * 141.421, 60);
}

TEST(Mcx314Twin, EndsAFixedDriveInTheSameTickAsItsLastPulse) {
    Host host;
    host.speeds(x, 16'000, 8000, 8000, 1, 1, 1, 0);
    host.data(x, 0x06, 1);
    host.command(x, 0x20);
    host.twin.run(3);
    EXPECT_EQ(host.twin.count(0), 0);
    EXPECT_EQ(host.twin.peek(0), 1);
    host.twin.tick();
    EXPECT_EQ(host.twin.count(0), 1);
    EXPECT_EQ(host.twin.peek(0), 0);
}

}  // namespace
}  // namespace motionrack::mcx314::twin
