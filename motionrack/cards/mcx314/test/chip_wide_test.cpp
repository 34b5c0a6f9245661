// Tests of the wide ranges of the MCX314As: drives, lines and arcs at the ends of 32 bits, and the arithmetic for them.
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

__extension__ using Wide = __int128;

TEST(ChipWide, TakesFourThousandMillionPulses) {
    Bench b(Variant::mcx314as);
    b.start();
    b.speeds(X, 16'000, 8000, 8000);
    b.data(X, cmd::P, 4'294'967'295);
    b.command(X, 0x20);
    b.advance(whole_seconds(1073));
    ASSERT_TRUE(b.finish(X, whole_seconds(2)));
    EXPECT_EQ(b.count(0), 4'294'967'295);
    EXPECT_EQ(b.lp(X), -1) << "LP has 32 bits";
}

TEST(ChipWide, LinesAndArcsReachTheEndsOfTheirWideRange) {
    Bench b(Variant::mcx314as);
    b.start();
    b.write(5, 0x0004);
    b.speeds(X | Y, 16'000, 8000, 8000);
    b.data(X, cmd::P, 2'147'483'646);
    b.data(Y, cmd::P, -1'431'655'765);
    b.command(0, cmd::LINE2);
    b.advance(whole_seconds(300));
    EXPECT_NEAR(static_cast<double>(b.count(1)), -static_cast<double>(b.count(0)) * 1'431'655'765 / 2'147'483'646, 1);
    b.advance(whole_seconds(236));
    ASSERT_TRUE(b.finish(X | Y, whole_seconds(2)));
    EXPECT_EQ(b.count(0), 2'147'483'646);
    EXPECT_EQ(b.count(1), -1'431'655'765);

    Bench c(Variant::mcx314as);  // a quarter of a circle, begun at its centre's far corner
    c.start();
    c.write(5, 0x0004);
    c.speeds(X | Y, 16'000, 8000, 8000);
    c.data(X, cmd::C, -2'147'483'646);
    c.data(Y, cmd::C, -2'147'483'646);
    c.data(X, cmd::P, -2'147'483'646 + 2'147'483'646 / 2);
    c.data(Y, cmd::P, 889'516'852);  // about the Y at which the circle has that X
    c.command(0, cmd::ARC_CCW);
    c.advance(whole_seconds(900));
    ASSERT_EQ(c.read(0) & (X | Y), 0u);
    const auto x = static_cast<Wide>(c.count(0)) + 2'147'483'646, y = static_cast<Wide>(c.count(1)) + 2'147'483'646;
    const Wide r2 = 2 * static_cast<Wide>(2'147'483'646) * 2'147'483'646, off = x * x + y * y - r2;
    EXPECT_LT(static_cast<double>(off < 0 ? -off : off), 3'037'000'500.0) << "within half a pulse of its radius";
    EXPECT_EQ(c.count(0), -2'147'483'646 + 2'147'483'646 / 2);
}

TEST(ChipWide, TheArithmeticOfPathsIsExactInTheWholeRange) {
    const std::int64_t values[] = {1, 2, 3, 16'777'215, 1'431'655'765, 2'147'483'645, 2'147'483'646, 2'147'483'647};
    for (const std::int64_t max_p : values)
        for (const std::int64_t p : values)
            for (const std::int64_t n : values) {
                if (p > max_p || n > max_p) continue;
                const auto exact = (2 * static_cast<Wide>(n) * p + max_p) / (2 * static_cast<Wide>(max_p));
                ASSERT_EQ(rules::line_steps(n, p, max_p), static_cast<std::int64_t>(exact));
                if (n > p) continue;
                const auto pulse = ((2 * static_cast<Wide>(n) - 1) * max_p + 2 * p - 1) / (2 * static_cast<Wide>(p));
                ASSERT_EQ(rules::line_pulse_of_step(n, p, max_p), static_cast<std::int64_t>(pulse));
                ASSERT_EQ(rules::line_steps(rules::line_pulse_of_step(n, p, max_p), p, max_p), n);
            }
    for (const std::int64_t m : {std::int64_t{1}, std::int64_t{2'147'483'646}, std::int64_t{3'037'000'496}})
        for (std::int64_t q = m * m - 3; q <= m * m + m + 3; q += q < m * m + 3 || q > m * m + m - 4 ? 1 : m - 6) {
            if (q <= 0) continue;
            const std::int64_t root = rules::near(q);
            ASSERT_LE(4 * static_cast<Wide>(root) * root - 4 * root + 1, 4 * static_cast<Wide>(q)) << q;
            ASSERT_GT(4 * static_cast<Wide>(root) * root + 4 * root + 1, 4 * static_cast<Wide>(q)) << q;
        }
}

}  // namespace
}  // namespace motionrack::mcx314::outside
