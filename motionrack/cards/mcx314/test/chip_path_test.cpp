// Tests of lines, arcs and chains of them through registers and pins.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

constexpr unsigned xyz = 0x0024;  // WR5: AX1 = X, AX2 = Y, AX3 = Z

struct PathSegment {
    unsigned code;
    int cx, cy, fx, fy;
};

void command_segment(Bench& b, const PathSegment& s) {
    b.data(X, 0x08, s.cx);
    b.data(Y, 0x08, s.cy);
    b.data(X, 0x06, s.fx);
    b.data(Y, 0x06, s.fy);
    b.command(0, s.code);
}

// The sample of the maker: a closed contour of four lines and four quarter circles of 1,500 pulses, without a stop at
// the junctions.
TEST(ChipPath, TheDocumentedContourCloses) {
    const PathSegment track[] = {
        {0x30, 0, 0, 4500, 0},  {0x33, 0, 1500, 1500, 1500},    {0x30, 0, 0, 0, 1500},  {0x33, -1500, 0, -1500, 1500},
        {0x30, 0, 0, -4500, 0}, {0x33, 0, -1500, -1500, -1500}, {0x30, 0, 0, 0, -1500}, {0x33, 1500, 0, 1500, -1500}};
    const int nodes[][2] = {{4500, 0}, {6000, 1500},  {6000, 3000},  {4500, 4500},
                            {0, 4500}, {-1500, 3000}, {-1500, 1500}, {0, 0}};
    Bench b;
    b.start();
    b.speeds(X | Y, 800'000, 1000, 100);
    b.write(5, xyz | 0x4000);  // an interrupt at each node
    for (std::size_t i = 0; i < 8; ++i) {
        command_segment(b, track[i]);
        if (i == 0) continue;
        ASSERT_TRUE(b.wait(whole_seconds(10))) << i;
        EXPECT_EQ(b.lp(X), nodes[i - 1][0]);
        EXPECT_EQ(b.lp(Y), nodes[i - 1][1]);
        EXPECT_TRUE(b.read(0) & 0x0200u);
        b.command(0, 0x3D);
        EXPECT_FALSE(b.interrupt());
    }
    ASSERT_TRUE(b.finish(X | Y));
    EXPECT_EQ(b.lp(X), 0);
    EXPECT_EQ(b.lp(Y), 0);
    EXPECT_EQ(b.read(0), 0u);
    EXPECT_TRUE(b.kernel.conditions().empty());
}

TEST(ChipPath, TheQueueIsOneDeepAsCnextShows) {
    Bench b;
    b.start();
    b.speeds(X | Y, 80'000, 1000, 1000);
    b.write(5, xyz);
    EXPECT_FALSE(b.read(0) & 0x0200u);
    command_segment(b, {0x30, 0, 0, 100, 50});
    EXPECT_EQ(b.read(0) & 0x0300u, 0x0300u);
    command_segment(b, {0x30, 0, 0, 10, 10});
    EXPECT_EQ(b.read(0) & 0x0300u, 0x0100u);
    command_segment(b, {0x30, 0, 0, 7, 7});
    EXPECT_EQ(b.kernel.conditions().size(), 1u);
    ASSERT_TRUE(b.finish(X | Y));
    EXPECT_EQ(b.lp(X), 110);
    EXPECT_EQ(b.lp(Y), 60);
}

TEST(ChipPath, StartsAHeldLineWhenAx1IsReleased) {
    Bench b;
    b.start();
    b.speeds(X | Y, 800'000, 100, 100);
    b.write(5, xyz);
    b.command(X, 0x24);
    command_segment(b, {0x30, 0, 0, 20, 10});
    b.advance(milliseconds(10));
    EXPECT_EQ(b.read(0) & 0x0103u, 0u);
    b.command(Y, 0x25);
    b.advance(milliseconds(10));
    EXPECT_EQ(b.read(0) & 0x0103u, 0u) << "AX1 is held, not AX2";
    b.command(X, 0x25);
    EXPECT_EQ(b.read(0) & 0x0103u, 0x0103u);
    ASSERT_TRUE(b.finish(X | Y));
    EXPECT_EQ(b.lp(X), 20);
    EXPECT_EQ(b.lp(Y), 10);
}

TEST(ChipPath, TheInterruptAtAJunctionIsClearedByTheNextSegmentOr3Dh) {
    Bench b;
    b.start();
    b.speeds(X | Y, 800'000, 100, 100);
    b.write(5, xyz | 0x4000);
    command_segment(b, {0x30, 0, 0, 20, 10});
    command_segment(b, {0x30, 0, 0, 20, 10});
    EXPECT_FALSE(b.interrupt()) << "a command alone is no joint";
    ASSERT_TRUE(b.wait(milliseconds(100)));
    EXPECT_EQ(b.lp(X), 20) << "it comes with the last pulse of the first";
    command_segment(b, {0x30, 0, 0, 20, 10});
    EXPECT_FALSE(b.interrupt());
    ASSERT_TRUE(b.wait(milliseconds(100)));
    b.status(X, 3);
    EXPECT_TRUE(b.interrupt()) << "it is not in RR3";
    b.command(0, 0x3D);
    EXPECT_FALSE(b.interrupt());
    ASSERT_TRUE(b.finish(X | Y));
    EXPECT_EQ(b.lp(X), 60);
    EXPECT_FALSE(b.interrupt());
}

RC_GTEST_PROP(ChipPath, AnyLineStaysWithinHalfAPulseOfTheIdealOne, ()) {
    const auto px = *rc::gen::inRange(-400, 401), py = *rc::gen::inRange(-400, 401), pz = *rc::gen::inRange(-400, 401);
    const int max_p = std::max({std::abs(px), std::abs(py), std::abs(pz)});
    Bench b;
    std::array<EdgeLog, 3> log;
    b.start();
    for (int a = 0; a < 3; ++a) b.chip.pulses(a).set_edge_listener(&log[static_cast<std::size_t>(a)]);
    b.speeds(X, 16'000, 4000, 8000, 8000);
    b.write(5, xyz);
    b.data(X, 0x06, px);
    b.data(Y, 0x06, py);
    b.data(Z, 0x06, pz);
    b.command(0, 0x31);
    RC_ASSERT(b.finish(X | Y | Z));
    RC_ASSERT(b.lp(X) == px);
    RC_ASSERT(b.lp(Y) == py);
    RC_ASSERT(b.lp(Z) == pz);
    // The long axis steps at every basic pulse; the others are at the pulses nearest to the ideal line.
    const int p[3] = {px, py, pz};
    const EdgeLog* master = nullptr;
    for (std::size_t a = 0; a < 3; ++a)
        if (std::abs(p[a]) == max_p) master = &log[a];
    for (std::size_t a = 0; a < 3; ++a) {
        std::size_t made = 0;
        for (std::size_t n = 0; n < master->list.size(); ++n) {
            if (made < log[a].list.size() && log[a].list[made].tick == master->list[n].tick) ++made;
            const double ideal = static_cast<double>(n + 1) * std::abs(p[a]) / max_p;
            RC_ASSERT(std::fabs(static_cast<double>(made) - ideal) <= 0.5);
        }
        RC_ASSERT(made == log[a].list.size());
    }
}

RC_GTEST_PROP(ChipPath, AnyFullCircleStaysWithinAPulseAndReturns, ()) {
    const auto cx = *rc::gen::inRange(-300, 301), cy = *rc::gen::inRange(-300, 301);
    const bool clockwise = *rc::gen::arbitrary<bool>();
    const double radius = std::sqrt(static_cast<double>(cx * cx + cy * cy));
    Bench b;
    std::array<EdgeLog, 2> log;
    b.start();
    for (int a = 0; a < 2; ++a) b.chip.pulses(a).set_edge_listener(&log[static_cast<std::size_t>(a)]);
    b.speeds(X, 16'000, 8000, 8000);
    b.write(5, xyz);
    command_segment(b, {clockwise ? 0x32u : 0x33u, cx, cy, 0, 0});
    RC_ASSERT(b.finish(X | Y));
    RC_ASSERT(b.lp(X) == 0);
    RC_ASSERT(b.lp(Y) == 0);
    std::size_t i = 0, j = 0, pulses = 0;
    double x = -cx, y = -cy, area = 0;
    while (i < log[0].list.size() || j < log[1].list.size()) {
        const std::int64_t next = std::min(i < log[0].list.size() ? log[0].list[i].tick : INT64_MAX,
                                           j < log[1].list.size() ? log[1].list[j].tick : INT64_MAX);
        const double x0 = x, y0 = y;
        if (i < log[0].list.size() && log[0].list[i].tick == next) x += log[0].list[i++].step;
        if (j < log[1].list.size() && log[1].list[j].tick == next) y += log[1].list[j++].step;
        area += x0 * y - x * y0;
        ++pulses;
        RC_ASSERT(std::fabs(std::sqrt(x * x + y * y) - radius) <= 1);
    }
    if (radius > 3) RC_ASSERT((area > 0) != clockwise);
    RC_ASSERT(static_cast<std::int64_t>(pulses) == rules::end_of_arc(cx, cy, 0, 0, clockwise).basic_pulses);
}

TEST(ChipPath, AnArcWithAnOffCircleFinishPointEndsWhereTheShortAxisPassesIt) {
    // The maker's example: centre (-200, 500), finish (-702, 299), octant 4; the finish is 2 pulses off the circle.
    Bench b;
    b.start();
    b.speeds(X, 80'000, 8000, 8000);
    b.write(5, xyz);
    command_segment(b, {0x33, -200, 500, -702, 299});
    ASSERT_TRUE(b.finish(X | Y));
    EXPECT_EQ(b.lp(Y), 299);
    EXPECT_EQ(b.lp(X), -700);
}

TEST(ChipPath, DeceleratesOnlyIfEnabled) {
    for (const bool enabled : {false, true}) {
        Bench b;
        EdgeLog log;
        b.start();
        b.chip.pulses(0).set_edge_listener(&log);
        b.speeds(X | Y, 80'000, 100, 2000, 2000);
        b.write(5, xyz);
        b.command(0, enabled ? 0x3B : 0x3C);
        command_segment(b, {0x30, 0, 0, 100'000, 33'333});
        ASSERT_TRUE(b.finish(X | Y));
        b.advance(tick);
        ASSERT_EQ(log.list.size(), 100'000u);
        const std::int64_t last = log.list[99'999].tick - log.list[99'998].tick;
        if (enabled)
            EXPECT_GT(last, 400);
        else
            EXPECT_EQ(last, 40);
        EXPECT_EQ(b.lp(Y), 33'333);
    }
}

TEST(ChipPath, ConstantVectorSpeedLengthensDiagonalPulsePeriodsByRootTwo) {
    Bench b;
    EdgeLog log;
    b.start();
    b.chip.pulses(0).set_edge_listener(&log);
    b.speeds(X | Y, 800'000, 1000, 1000);
    b.data(Y, 0x00, 1'131'371);
    b.write(5, xyz | 0x0100);
    command_segment(b, {0x30, 0, 0, 10'000, 10'000});
    ASSERT_TRUE(b.finish(X | Y));
    b.advance(tick);
    ASSERT_EQ(log.list.size(), 10'000u);
    const double ticks = static_cast<double>(log.list.back().tick - log.list.front().tick) / 9999;
    EXPECT_NEAR(ticks, 1131.371, 0.001);
}

TEST(ChipPath, AStopOfAnyAxisStopsTheWholeChain) {
    Bench b;
    b.start();
    b.speeds(X | Y, 80'000, 100, 2000, 2000);
    b.write(5, xyz);
    command_segment(b, {0x30, 0, 0, 100'000, 50'000});
    command_segment(b, {0x30, 0, 0, -100'000, 50'000});
    b.advance(milliseconds(100));
    b.command(Y, 0x26);
    ASSERT_TRUE(b.finish(X | Y, whole_seconds(1)));
    EXPECT_LT(b.lp(X), 100'000);
    EXPECT_NEAR(b.lp(Y), b.lp(X) / 2.0, 1);
    EXPECT_EQ(b.read(0), 0u);
}

TEST(ChipPath, ALimitOfASlaveAxisStopsTheLine) {
    Bench b;
    b.start();
    b.speeds(X | Y, 80'000, 1000, 1000);
    b.write(5, xyz);
    command_segment(b, {0x30, 0, 0, 10'000, -5000});
    b.advance(milliseconds(10));
    b.wire("ylmtm", 0);
    b.advance(tick);
    EXPECT_EQ(b.read(0) & 0x0103u, 0u);
    EXPECT_TRUE(b.status(Y, 1) & 0x2000u);
    EXPECT_FALSE(b.status(X, 1) & 0xFF00u);
}

}  // namespace
}  // namespace motionrack::mcx314::outside
