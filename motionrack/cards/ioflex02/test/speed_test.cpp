// Velocity from time stamps: the stated error bound always holds, and is small where possible.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/cards/ioflex02/driver/speed.hpp>
#include <motionrack/cards/ioflex02/test/rig.hpp>

namespace motionrack::ioflex02 {
namespace {

/// A card whose axis 0 moves at constant velocity; edges are driven at their exact instants, to 100 ps.
struct Turning {
    explicit Turning(double counts_s, double phase = 0.3) : card(rig.port, rig.port), speed(counts_s), at_zero(phase) {
        rig.start();
        card.Init(0x2300);
        a = rig.kernel.find_wire("c1.a0");
        b = rig.kernel.find_wire("c1.b0");
        begin = rig.kernel.now();
    }
    double where(Instant t) const { return at_zero + speed * to_seconds(t - begin); }
    void run(Duration time) {
        const Instant until = rig.kernel.now() + time;
        while (true) {
            const std::int64_t next = speed > 0 ? count + 1 : count;
            const Instant due = begin + from_seconds((static_cast<double>(next) - at_zero) / speed);
            if (due > until) break;
            rig.run(std::max(Duration{0}, due - rig.kernel.now()));
            count += speed > 0 ? 1 : -1;
            rig.kernel.set_wire(a, lines_of_phase(count) & 1);
            rig.kernel.set_wire(b, lines_of_phase(count) >> 1);
            rig.kernel.settle();
        }
        rig.run(until - rig.kernel.now());
    }
    Speed measure() {
        const Reading r = card.read();
        return meter.update(r.axes[0], r.ticks);
    }
    Rig rig{Settings{}};
    Flex2Pos card;
    SpeedMeter meter;
    double speed, at_zero;
    std::int64_t count = 0;
    Instant begin{};
    sim::WireId a{}, b{};
};

void expect_within(const SpeedEstimate& estimate, double speed) {
    if (!estimate.known) return;
    EXPECT_LE(std::abs(estimate.counts_s - speed), estimate.error)
        << speed << " counts/s, estimate " << estimate.counts_s;
}

TEST(SpeedMeter, MeasuresATenthOfACountASecondToAMillionth) {
    Turning t(0.1);
    t.measure();
    for (int i = 0; i < 40; ++i) {
        t.run(whole_seconds(1));
        const Speed s = t.measure();
        expect_within(s.difference, 0.1);
        expect_within(s.edges, 0.1);
        if (i > 20 && s.edge_came) {
            EXPECT_LT(s.best().error, 1e-7);
        }
    }
    EXPECT_EQ(t.count, 4);
}

TEST(SpeedMeter, MeasuresAHundredThousandCountsASecond) {
    for (const double speed : {100'000.0, -100'000.0}) {
        Turning t(speed);
        t.measure();
        t.run(milliseconds(10));
        t.measure();
        t.run(milliseconds(10));
        const Speed s = t.measure();
        ASSERT_TRUE(s.edges.known && s.difference.known);
        expect_within(s.difference, speed);
        expect_within(s.edges, speed);
        EXPECT_LT(s.edges.error, 15);
        EXPECT_LT(s.difference.error, 130);
        EXPECT_EQ(&s.best(), &s.edges);
    }
}

TEST(SpeedMeter, ContinuesOverTheWrapOfTheTime) {
    Turning t(3.7);
    t.measure();
    for (int i = 0; i < 60; ++i) {
        t.run(milliseconds(2'222));  // 133 s, the time wraps after 20.13 s
        if (i % 7 == 0) t.card.ReadTimeClr();
        const Speed s = t.measure();
        ASSERT_TRUE(s.difference.known);
        expect_within(s.difference, 3.7);
        expect_within(s.edges, 3.7);
        if (i > 1) {
            EXPECT_LT(s.best().error, 1e-4);
        }
    }
}

TEST(SpeedMeter, MeasuresBetweenReadingsFartherApartThanTheWrap) {
    Turning t(0.04);  // 25 s per count: the age of the last one is out of range
    t.measure();
    for (int i = 0; i < 12; ++i) {
        t.run(whole_seconds(i % 3 == 0 ? 90 : 7));
        const Speed s = t.measure();
        expect_within(s.difference, 0.04);
        expect_within(s.edges, 0.04);
    }
}

TEST(SpeedMeter, AnAxisThatStopsApproachesZeroWithAFallingBound) {
    Turning t(1000);
    t.measure();
    t.run(milliseconds(50));
    t.measure();
    t.run(milliseconds(50));
    EXPECT_NEAR(t.measure().best().counts_s, 1000, 1);
    double before = 1e9;
    for (const int ms : {10, 100, 1000, 10'000, 30'000}) {
        t.rig.run(milliseconds(ms));  // no edge
        const Speed s = t.measure();
        ASSERT_TRUE(s.edges.known);
        EXPECT_FALSE(s.edge_came);
        EXPECT_LE(std::abs(s.edges.counts_s), s.edges.error);  // 0 is within it
        EXPECT_LT(s.edges.error, before);
        before = s.edges.error;
    }
    EXPECT_LT(before, 0.1);
}

TEST(SpeedMeter, AnAxisThatNeverMovedHasAnErrorBoundFromItsObservedTime) {
    Turning t(1e-9);
    t.measure();
    t.run(milliseconds(500));
    const Speed s = t.measure();
    ASSERT_TRUE(s.edges.known);
    EXPECT_EQ(s.edges.counts_s, 0);
    EXPECT_NEAR(s.edges.error, 2, 0.001);
}

RC_GTEST_PROP(SpeedMeter, TheStatedErrorIsNeverExceededAtAnySpeedAndReadingPattern, ()) {
    const double speed = (*rc::gen::arbitrary<bool>() ? 1 : -1) * std::pow(10.0, *rc::gen::inRange(-20, 50) / 10.0);
    Turning t(speed, *rc::gen::inRange(1, 1000) / 1000.0);
    t.measure();
    const int readings = *rc::gen::inRange(2, 12);
    for (int i = 0; i < readings; ++i) {
        const double edges = std::pow(10.0, *rc::gen::inRange(-10, 15) / 10.0);  // between two readings
        t.run(std::min(from_seconds(edges / std::abs(speed)), whole_seconds(60)));
        const Speed s = t.measure();
        for (const SpeedEstimate* e : {&s.difference, &s.edges})
            RC_ASSERT(!e->known || std::abs(e->counts_s - speed) <= e->error);
    }
}

RC_GTEST_PROP(SpeedMeter, ItHoldsForAnyMotionAsTheMeanOfItsStretch, ()) {
    // Readings of a wandering true position: ticks and ages as the card would give them.
    struct Edge {
        double seconds;
        std::int64_t count;
        bool down;
    };
    double place = 0.5, seconds = 0;
    std::vector<std::pair<double, double>> path = {{0, 0.5}};
    std::vector<Edge> edges;
    SpeedMeter meter;
    const auto at = [&path](double t) {
        std::size_t i = 1;
        while (i + 1 < path.size() && path[i].first < t) ++i;
        const auto &p = path[i - 1], &q = path[i];
        return p.second + (q.second - p.second) * (t - p.first) / (q.first - p.first);
    };
    const auto tick = [](double t) { return static_cast<std::int64_t>(std::floor(t / 1.2e-6)); };
    const int legs = *rc::gen::inRange(1, 15);
    for (int i = 0; i < legs; ++i) {
        const double duration = *rc::gen::inRange(10, 20'000) * 1e-6,
                     to = place + *rc::gen::inRange(-3000, 3001) / 1000.0;
        for (auto n = static_cast<std::int64_t>(std::floor(std::min(place, to))) + 1;
             static_cast<double>(n) <= std::max(place, to); ++n) {
            const double when = seconds + duration * (static_cast<double>(n) - place) / (to - place);
            edges.push_back({when, to > place ? n : n - 1, to < place});
        }
        seconds += duration;
        place = to;
        path.push_back({seconds, place});
        std::stable_sort(edges.begin(), edges.end(),
                         [](const Edge& a, const Edge& b) { return a.seconds < b.seconds; });
        AxisReading r;
        r.raw = static_cast<std::int64_t>(std::floor(place));
        r.age = edges.empty() ? oldest_age : tick(seconds) - tick(edges.back().seconds);
        r.down = !edges.empty() && edges.back().down;
        if (!edges.empty()) RC_ASSERT(r.raw == edges.back().count);
        const Speed s = meter.update(r, tick(seconds));
        // The ends of the interval are known to a tick; the bound applies to the mean over the true interval.
        const auto holds = [](const SpeedEstimate& e, double true_mean) {
            return std::abs(e.counts_s - true_mean) <= e.error * (1 + 1e-9) + 1e-6;
        };
        if (s.difference.known) {
            const double begin = path[path.size() - 2].first, true_mean = (place - at(begin)) / (seconds - begin);
            RC_ASSERT(holds(s.difference, true_mean));
        }
        if (!s.edges.known || edges.empty()) continue;
        const Edge& last = edges.back();
        if (!s.edge_came) {
            RC_ASSERT(holds(s.edges, (place - at(last.seconds)) / (seconds - last.seconds)));
            continue;
        }
        std::size_t first = edges.size();
        while (tick(edges[--first].seconds) != s.edges.from) {
        }
        const double way = static_cast<double>(last.count + last.down - edges[first].count - edges[first].down);
        RC_ASSERT(holds(s.edges, way / (last.seconds - edges[first].seconds)));
    }
}

}  // namespace
}  // namespace motionrack::ioflex02
