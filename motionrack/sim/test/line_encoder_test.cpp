// Encoders and resolvers with their lines as wires: geometry, electronics, and each fault.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/parts/line_encoder.hpp>
#include <motionrack/sim/parts/resolver.hpp>
#include <motionrack/sim/test/allocation_count.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>

namespace motionrack::parts {
namespace {

/// Counts the edges of the lines.
class Counter final : public sim::Device {
  public:
    Counter(sim::Kernel& kernel, sim::WireId a, sim::WireId b, sim::WireId z)
        : kernel_(kernel), id_(kernel.add(*this, sim::Phase::observers, "counter")), wires{a, b, z} {
        for (int i = 0; i < 3; ++i) kernel.listen(wires[i], id_, i);
        edges.reserve(100'000);
        index_at.reserve(1000);
    }
    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override {
        if (pin == 2) {
            if (level) index_at.push_back(decoder.count());
            return;
        }
        decoder.lines(static_cast<std::uint8_t>(kernel_.level(wires[0]) | kernel_.level(wires[1]) << 1));
        ++line_edges[pin];
        if (edges.size() < edges.capacity()) edges.push_back(now);
    }
    sim::Kernel& kernel_;
    sim::DeviceId id_;
    sim::WireId wires[3];
    sim::QuadratureDecoder decoder;
    std::int64_t line_edges[2] = {};
    std::vector<Instant> edges;
    std::vector<std::int64_t> index_at;
};

template <class Part, class Settings>
struct World {
    World(const Settings& settings, std::vector<sim::PulseLaw> laws)
        : position(kernel, std::move(laws)),
          part(kernel, "enc", position, settings),
          counter(kernel, part.a(), part.b(), part.z()) {
        kernel.start();
        kernel.run_until(Instant{0});
    }
    void run(Duration time) { kernel.run_until(kernel.now() + time); }
    bool fault(const char* name, double value) {
        const bool done = part.fault(name, value, kernel.now());
        kernel.settle();
        return done;
    }
    std::int64_t counted() const { return counter.decoder.count(); }
    sim::Kernel kernel;
    sim::FakePulses position;
    Part part;
    Counter counter;
};
using Disc = World<LineEncoder, LineEncoderSettings>;
using Winding = World<Resolver, ResolverSettings>;

/// Returns a disc of 400 counts per revolution on a rotor of 4000 microsteps. One microstep each 1 us gives 100,000
/// counts/s.
LineEncoderSettings small_disc() {
    return {.counts_per_turn = 400, .position_per_turn = 4000};
}
const std::vector<sim::PulseLaw> forwards = {{Instant{0}, microseconds(1), 1}};
const std::vector<sim::PulseLaw> to_and_fro = {
    {Instant{0}, microseconds(1), 1}, {milliseconds(6), microseconds(1), -1}, {milliseconds(10), microseconds(1), 0}};

TEST(LineEncoder, CountsTheRotation) {
    Disc w(small_disc(), to_and_fro);
    w.run(milliseconds(6));
    EXPECT_EQ(w.part.count(), 600);
    EXPECT_EQ(w.counted(), 600);
    w.run(milliseconds(14));
    EXPECT_EQ(w.counted(), 200);
    EXPECT_EQ(w.part.lost(), 0);
    EXPECT_EQ(w.counter.decoder.illegal(), 0u);
}

TEST(LineEncoder, EdgesComeExactlyWhenThePositionReachesThem) {
    Disc w(small_disc(), forwards);
    w.run(milliseconds(1));
    ASSERT_EQ(w.counter.edges.size(), 100u);
    for (std::size_t i = 0; i < 100; ++i)
        EXPECT_EQ(w.counter.edges[i], microseconds(10 * static_cast<std::int64_t>(i + 1)));
}

TEST(LineEncoder, TheIndexComesOnceATurnAtTheSamePositionFromBothSides) {
    Disc w(small_disc(), {{Instant{0}, microseconds(1), 1}, {milliseconds(13), microseconds(1), -1}});
    w.run(milliseconds(20));
    EXPECT_EQ(w.counter.index_at, (std::vector<std::int64_t>{400, 800, 1200, 1200, 800}));
}

TEST(LineEncoder, EdgesOfAPositionThatIsCoarserThanTheCountsComeOneAfterTheOther) {
    Disc w({.counts_per_turn = 4000, .position_per_turn = 1000}, {{Instant{0}, microseconds(10), 1}});
    w.run(milliseconds(10));
    w.run(microseconds(9));
    EXPECT_EQ(w.counted(), 4000);
    EXPECT_EQ(w.counter.decoder.illegal(), 0u);
}

// ---- geometry and electronics

TEST(LineEncoder, AnEccentricDiscIsEarlyOnOneSideAndLateOnTheOtherAndRightAfterATurn) {
    LineEncoderSettings s = small_disc();
    s.eccentricity = 5;
    Disc w(s, forwards);
    std::int64_t max_error = 0, min_error = 0;
    for (int i = 1; i <= 4000; ++i) {
        w.run(microseconds(1));
        const double straight = i / 10.0, error = static_cast<double>(w.counted()) - straight;
        EXPECT_LE(std::abs(error - 5 * sin_cos(2 * pi * straight / 400).sin), 1.5) << i;
        max_error = std::max(max_error, static_cast<std::int64_t>(error));
        min_error = std::min(min_error, static_cast<std::int64_t>(error));
    }
    EXPECT_GE(max_error, 4);
    EXPECT_LE(min_error, -4);
    EXPECT_EQ(w.counted(), 400);
    EXPECT_EQ(w.counter.decoder.illegal(), 0u);
    EXPECT_TRUE(w.fault("eccentricity", 0));
    EXPECT_FALSE(w.fault("eccentricity", 60));
    EXPECT_FALSE(w.fault("eccentricity", -1));
}

TEST(LineEncoder, JitterDelaysEdgesButLosesNone) {
    Disc w(small_disc(), to_and_fro);
    EXPECT_TRUE(w.fault("jitter", 4e-6));
    w.run(milliseconds(6) - microseconds(5));
    int late = 0;
    for (std::size_t i = 0; i < w.counter.edges.size(); ++i) {
        const Duration delay = w.counter.edges[i] - microseconds(10 * static_cast<std::int64_t>(i + 1));
        EXPECT_GE(delay, Duration{0});
        EXPECT_LE(delay, microseconds(4));
        late += delay > microseconds(1);
    }
    EXPECT_GT(late, 300);
    w.run(milliseconds(20));
    EXPECT_EQ(w.counted(), 200);
    EXPECT_EQ(w.counter.decoder.illegal(), 0u);
}

TEST(LineEncoder, AboveItsMaximumRateLosesWholeLinesWithoutAReport) {
    Disc w(small_disc(), to_and_fro);
    EXPECT_TRUE(w.fault("overspeed", 30'000));  // counts/s; the disc moves at 100,000 counts/s
    w.run(milliseconds(30));
    EXPECT_GT(w.part.lost(), 100);
    EXPECT_EQ(w.counter.decoder.illegal(), 0u);
    EXPECT_NE(w.counted(), 200);
    EXPECT_EQ((w.counted() - 200) % 4, 0);
    for (std::size_t i = 1; i < w.counter.edges.size(); ++i)
        EXPECT_GE(w.counter.edges[i] - w.counter.edges[i - 1], Duration{333'333});
}

// ---- faults of lines

TEST(LineEncoder, ABrokenLineMakesADecoderOscillate) {
    for (const char* name : {"broken_a", "encoder.broken_b"})
        for (const double level : {1.0, 2.0}) {
            Disc w(small_disc(), forwards);
            EXPECT_TRUE(w.fault(name, level));
            w.run(milliseconds(5));
            EXPECT_LE(std::llabs(w.counted()), 2);
            const bool a = name[7] == 'a';
            EXPECT_LE(w.counter.line_edges[a ? 0 : 1], 1);
            EXPECT_EQ(w.counter.line_edges[a ? 1 : 0], 250);
            EXPECT_TRUE(w.fault(name, 0));
            const std::int64_t before = w.counted();
            w.run(milliseconds(1));
            EXPECT_NEAR(static_cast<double>(w.counted() - before), 100, 1);
        }
}

TEST(LineEncoder, ABrokenIndexIsNotDetected) {
    Disc w(small_disc(), forwards);
    EXPECT_TRUE(w.fault("broken_z", 1));
    w.run(milliseconds(20));
    EXPECT_TRUE(w.counter.index_at.empty());
    EXPECT_EQ(w.counted(), 2000);
}

TEST(LineEncoder, SwappedLinesAndOneInvertedLineCountBackwardsBothTogetherDoNot) {
    for (const std::vector<const char*>& names : {std::vector<const char*>{"swapped"},
                                                  {"inverted_a"},
                                                  {"inverted_b"},
                                                  {"inverted_a", "swapped"},
                                                  {"inverted_a", "inverted_b"}}) {
        Disc w(small_disc(), forwards);
        for (const char* name : names) EXPECT_TRUE(w.fault(name, 1));
        w.run(microseconds(5));
        const std::int64_t before = w.counted();
        w.run(milliseconds(5));
        EXPECT_EQ(w.counted() - before, names.size() == 1 ? -500 : 500) << names[0];
    }
}

TEST(LineEncoder, AnInvertedIndexIsActiveLow) {
    Disc w(small_disc(), forwards);
    EXPECT_TRUE(w.fault("inverted_z", 1));
    w.run(milliseconds(9));
    EXPECT_EQ(w.kernel.level(w.part.z()), 1);
    EXPECT_EQ(w.counter.index_at, (std::vector<std::int64_t>{1, 401, 801}));  // rising edges end the pulses
}

TEST(LineEncoder, MissingAndDoubleIndexes) {
    Disc w(small_disc(), forwards);
    EXPECT_TRUE(w.fault("missing_index", 2));
    w.run(milliseconds(16) + microseconds(5));
    EXPECT_EQ(w.counter.index_at, (std::vector<std::int64_t>{1200, 1600}));
    EXPECT_TRUE(w.fault("double_index", 30));
    w.run(milliseconds(4));
    EXPECT_EQ(w.counter.index_at, (std::vector<std::int64_t>{1200, 1600, 1630, 2000}));
    EXPECT_FALSE(w.fault("double_index", 400));
}

TEST(LineEncoder, DirtHidesItsLinesWithoutAReport) {
    LineEncoderSettings s = small_disc();
    s.dirt_at = 101;
    Disc w(s, {{Instant{0}, microseconds(1), 1}, {milliseconds(12), microseconds(1), -1}});
    EXPECT_TRUE(w.fault("dirt", 6));
    w.run(microseconds(1'020));
    EXPECT_EQ(w.counted(), 101);
    w.run(milliseconds(12) - microseconds(1'020));
    EXPECT_EQ(w.counted(), 1200 - 3 * 24);
    EXPECT_EQ(w.counter.index_at, (std::vector<std::int64_t>{400 - 24, 800 - 48, 1200 - 72}));
    w.run(milliseconds(12));
    EXPECT_EQ(w.counted(), 0);
    EXPECT_EQ(w.counter.decoder.illegal(), 0u);
    EXPECT_FALSE(w.fault("dirt", 100));
}

TEST(LineEncoder, ANoiseBurstMakesPulsesOnAAndBAndThenEnds) {
    Disc w(small_disc(), {});
    w.run(milliseconds(1));
    EXPECT_TRUE(w.fault("noise", 200));
    w.run(milliseconds(1));
    EXPECT_EQ(w.counter.line_edges[0] + w.counter.line_edges[1], 400);
    EXPECT_GT(w.counter.line_edges[0], 100);
    EXPECT_GT(w.counter.line_edges[1], 100);
    EXPECT_EQ(w.counted(), 0);
    const std::uint64_t events = w.kernel.events();
    w.run(whole_seconds(10));
    EXPECT_EQ(w.kernel.events(), events);
}

TEST(LineEncoder, UnknownFaultsAndValuesOutOfRangeAreRejected) {
    Disc w(small_disc(), forwards);
    EXPECT_FALSE(w.fault("no_such", 1));
    EXPECT_FALSE(w.fault("", 1));
    EXPECT_FALSE(w.fault("z", 1));
    for (const char* name :
         {"broken_a", "noise", "jitter", "dirt", "overspeed", "eccentricity", "missing_index", "double_index"})
        for (const double value : {-1.0, 1e300, std::nan("")})
            EXPECT_FALSE(w.fault(name, value)) << name << " " << value;
    w.run(milliseconds(5));
    EXPECT_EQ(w.counted(), 500);
}

// ---- determinism

RC_GTEST_PROP(LineEncoder, GivesTheSameEventTraceForEqualSeedsAndAfterARestoreWithAnyFaults, ()) {
    constexpr const char* names[] = {"broken_a",   "broken_b", "broken_z",  "inverted_a",    "inverted_b",
                                     "inverted_z", "swapped",  "noise",     "missing_index", "double_index",
                                     "jitter",     "dirt",     "overspeed", "eccentricity"};
    LineEncoderSettings s = small_disc();
    s.seed = *rc::gen::arbitrary<std::uint16_t>();
    Disc one(s, to_and_fro), two(s, to_and_fro);
    const int faults = *rc::gen::inRange(1, 20);
    for (int i = 0; i < faults; ++i) {
        const char* name = names[*rc::gen::inRange<std::size_t>(0, std::size(names))];
        const double value = *rc::gen::element(0.0, 1.0, 2.0, 20.0, 3e-6, 20'000.0);
        RC_ASSERT(one.fault(name, value) == two.fault(name, value));
        const Duration time = microseconds(*rc::gen::inRange(0, 900));
        one.run(time);
        const sim::Snapshot saved = two.kernel.snapshot();
        two.run(milliseconds(1));
        two.kernel.restore(saved);
        two.run(time);
    }
    RC_ASSERT(one.kernel.state_hash() == two.kernel.state_hash());
    RC_ASSERT(one.kernel.trace_hash() == two.kernel.trace_hash());
}

RC_GTEST_PROP(LineEncoder, WithoutFaultsItCountsInTheExactRatio, ()) {
    LineEncoderSettings s;
    s.counts_per_turn = 4 * *rc::gen::inRange(1, 2000);
    s.position_per_turn = *rc::gen::inRange<std::int64_t>(1, 30'000);
    std::vector<sim::PulseLaw> laws;
    for (int i = 0; i < 5; ++i)
        laws.push_back(
            {milliseconds(i), microseconds(*rc::gen::inRange(20, 500)), *rc::gen::inRange<std::int64_t>(-1, 2)});
    laws.push_back({milliseconds(5), microseconds(1), 0});
    s.min_edge_interval = nanoseconds(10);
    Disc w(s, laws);
    w.run(milliseconds(20));
    const std::int64_t position = w.position.count(w.kernel.now());
    RC_ASSERT(w.part.count() == floor_div(Wide{position} * s.counts_per_turn, s.position_per_turn));
    if (w.part.lost() == 0) RC_ASSERT(w.counted() == w.part.count());
    RC_ASSERT(w.counter.decoder.illegal() == 0u);
}

TEST(LineEncoder, ARunWithFaultsAllocatesNothing) {
    Disc w(small_disc(), forwards);
    w.fault("jitter", 1e-6);
    w.fault("noise", 1000);
    w.fault("dirt", 3);
    w.fault("eccentricity", 4);
    const std::uint64_t before = sim::allocations();
    w.run(milliseconds(100));
    EXPECT_EQ(sim::allocations(), before);
    EXPECT_GT(w.counter.line_edges[0], 4000);
}

// ---- resolver

ResolverSettings small_resolver() {
    return {.counts_per_turn = 1024, .position_per_turn = 10'240};
}

TEST(Resolver, GivesLinesAndAnIndexAsAnEncoderDoes) {
    Winding w(small_resolver(), {{Instant{0}, microseconds(1), 1},
                                 {milliseconds(25), microseconds(1), -1},
                                 {milliseconds(40), microseconds(1), 0}});
    w.run(milliseconds(25));
    EXPECT_EQ(w.counted(), 2500);
    w.run(milliseconds(25));
    EXPECT_EQ(w.counted(), 1000);
    EXPECT_EQ(w.counter.index_at, (std::vector<std::int64_t>{1024, 2048, 2048, 1024}));
    EXPECT_EQ(w.kernel.level(w.part.los()), 0);
}

TEST(Resolver, UnequalWindingsCauseErrorsTwicePerRevolutionAndOffsetsOnce) {
    struct Case {
        const char* fault;
        double value;
    };
    for (const Case& c : {Case{"gain", 0.1}, {"offset_sin", 0.05}, {"offset_cos", -0.05}}) {
        Winding w(small_resolver(), forwards);
        EXPECT_TRUE(w.fault(c.fault, c.value));
        for (int i = 1; i <= 10'240; ++i) {
            w.run(microseconds(1));
            if (i < 50) continue;  // after the fault the output moves to the new angle, one count in 1 us
            const SinCos at = sin_cos(2 * pi * i / 10'240);
            const std::string name = c.fault;
            double angle = atan2(at.sin * (name == "gain" ? 1 + c.value : 1) + (name == "offset_sin" ? c.value : 0),
                                 at.cos + (name == "offset_cos" ? c.value : 0));
            double counts = angle / (2 * pi) * 1024;
            counts += std::round((i / 10.0 - counts) / 1024) * 1024;
            ASSERT_NEAR(static_cast<double>(w.counted()) + 0.5, counts, 1.2) << c.fault << " at " << i;
        }
        EXPECT_EQ(w.counter.decoder.illegal(), 0u);
    }
}

TEST(Resolver, AboveItsMaximumRateLagsAndLosesNothing) {
    Winding w(small_resolver(), to_and_fro);
    EXPECT_TRUE(w.fault("overspeed", 40'000));
    w.run(milliseconds(6));
    EXPECT_LT(w.counted(), 250);
    w.run(milliseconds(40));
    EXPECT_EQ(w.counted(), 200);
    EXPECT_EQ(w.part.lost(), 0);
}

TEST(Resolver, WithoutASignalHoldsTheLinesAndThenTakesTheShorterDirection) {
    for (const char* winding : {"broken_sin", "encoder.broken_cos"}) {
        Winding w(small_resolver(), {{Instant{0}, microseconds(1), 1}, {milliseconds(40), microseconds(1), 0}});
        w.run(milliseconds(5));
        EXPECT_TRUE(w.fault(winding, 1));
        EXPECT_EQ(w.kernel.level(w.part.los()), 1);
        w.run(milliseconds(45));  // to 4000 counts: 3 revolutions and 928
        EXPECT_EQ(w.counted(), 500);
        EXPECT_TRUE(w.fault(winding, 0));
        w.run(milliseconds(5));
        EXPECT_EQ(w.kernel.level(w.part.los()), 0);
        EXPECT_EQ(w.counted(), 928);
        EXPECT_EQ(w.part.count(), 4000);
        EXPECT_EQ(w.counter.decoder.illegal(), 0u);
    }
}

}  // namespace
}  // namespace motionrack::parts
