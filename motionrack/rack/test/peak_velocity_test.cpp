// A peak velocity is a sustained one. It is found in motions with a known velocity, and the effect of whole pulses on
// the rate of short segments is not.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <motionrack/rack/peak_velocity.hpp>

namespace motionrack::rack {
namespace {

constexpr double jump_hz = 12, period_s = 1e-3;

/// Returns the peak velocity of a motion in segments. Each segment has a whole number of pulses at a constant rate, as
/// drawn by a card that receives the exact `velocity(t)` of its middle.
double top_of_pieces(const std::function<double(double)>& velocity, double piece_s, double seconds) {
    PeakVelocity top(jump_hz, from_seconds(period_s));
    double t = 0, next_poll = period_s, place = 0, rate = 0;
    double wanted = 0;
    while (t < seconds) {
        wanted += velocity(t + piece_s / 2) * piece_s;
        const double pulses = std::floor(wanted + 0.5) - place, before = rate;
        rate = pulses / piece_s;
        if (rate != before) top.changed(before, rate, from_seconds(t));
        for (; next_poll <= t + piece_s; next_poll += period_s)
            top.sample(static_cast<std::int64_t>(std::floor(place + rate * (next_poll - t))), rate,
                       from_seconds(next_poll));
        place += pulses;
        t += piece_s;
    }
    top.finish();
    return top.hz();
}

TEST(PeakVelocity, OfOneLongSegmentIsExactlyItsRate) {
    PeakVelocity top(jump_hz, milliseconds(1));
    top.changed(0, 1'280, milliseconds(10));
    top.changed(1'280, 0, milliseconds(1'010));
    top.finish();
    EXPECT_EQ(top.hz(), 1'280);
}

TEST(PeakVelocity, OfARampIsThatOfItsLastInstant) {
    PeakVelocity top(jump_hz, milliseconds(1));
    double rate = 0;
    for (int i = 1; i <= 3'000; ++i, rate += 10) top.changed(rate, rate + 10, microseconds(16 * i));
    top.changed(rate, 0, microseconds(16 * 3'001));
    top.finish();
    EXPECT_NEAR(top.hz(), 30'000, 30'000.0 / 700);
}

TEST(PeakVelocity, IgnoresASegmentOfAFewPulses) {
    PeakVelocity top(jump_hz, milliseconds(1));
    top.changed(0, 10'000, Instant{} + milliseconds(1));
    top.changed(10'000, 12'500, Instant{} + milliseconds(501));  // 5 pulses in the time of 4
    top.changed(12'500, 10'000, Instant{} + microseconds(501'400));
    top.changed(10'000, 0, Instant{} + milliseconds(900));
    top.finish();
    EXPECT_EQ(top.hz(), 10'000);
}

TEST(PeakVelocity, OfShortSegmentsIsTheirMeanVelocity) {
    for (const double piece : {0.0002, 0.0007, 0.003})
        for (const double truth : {700.0, 9'321.0, 61'234.5}) {
            SCOPED_TRACE(testing::Message() << piece << " s, " << truth << " Hz");
            const double top = top_of_pieces([&](double) { return truth; }, piece, 1.5);
            EXPECT_LE(top, 1.0005 * truth);
            EXPECT_GE(top, truth - 4.5) << "within two pulses of a window of half a second";
        }
}

TEST(PeakVelocity, OfAFewMillisecondsIsFoundInShortSegments) {
    const auto bump = [](double t) { return t > 0.5 && t < 0.508 ? 60'000.0 : 20'000.0; };
    const double top = top_of_pieces(bump, 0.0002, 1);
    EXPECT_LE(top, 60'000.0 * 1.0005);
    EXPECT_GE(top, 60'000.0 - 2 / 0.004);
}

TEST(PeakVelocity, CountsBackwardsToo) {
    const double top = top_of_pieces([](double t) { return t < 0.3 ? 5'000.0 : -9'000.0; }, 0.001, 1);
    EXPECT_NEAR(top, 9'000, 10);
}

}  // namespace
}  // namespace motionrack::rack
