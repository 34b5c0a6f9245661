// The encoder of an axis: counts, lines, index, edges, watches and broken wiring, against decoders that count edge by
// edge.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/test/allocation_count.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>

namespace motionrack::parts {
namespace {

using sim::FakePulses;
using sim::Kernel;
using sim::PulseLaw;

class EdgeRecorder final : public sim::EdgeListener {
  public:
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            const Instant at = batch.origin + batch.tick * batch.at[i];
            ordered = ordered && at >= last;
            last = at;
            const std::int64_t next = batch.first_count + batch.step * static_cast<std::int64_t>(i);
            joined = joined && next == count + batch.step;
            count = next;
            ++edge_count;
        }
    }
    std::int64_t count = 0;
    std::int64_t edge_count = 0;
    Instant last{};
    bool ordered = true;
    bool joined = true;
};

class CrossingListener final : public sim::PositionListener {
  public:
    explicit CrossingListener(sim::PositionFunction& motion) : motion_(motion), slot_(motion.add_listener(*this)) {}
    void crossed(Instant now) override {
        at.push_back(now);
        counts.push_back(motion_.count(now));
    }
    void rate_changed(double, double new_rate, Instant) override { rate = new_rate; }
    void watch(std::int64_t below, std::int64_t above) { motion_.watch(slot_, below, above); }
    std::vector<Instant> at;
    std::vector<std::int64_t> counts;
    double rate = 0;

  private:
    sim::PositionFunction& motion_;
    int slot_;
};

class WireListener final : public sim::Device {
  public:
    explicit WireListener(Kernel& kernel) : id(kernel.add(*this, sim::Phase::cards, "ear")) {}
    void on_scheduled(Instant) override {}
    void on_wire(int, int level, Instant now) override { heard.emplace_back(level, now); }
    sim::DeviceId id;
    std::vector<std::pair<int, Instant>> heard;
};

AxisMechanicsSettings with_counts(std::int64_t counts_per_rev) {
    AxisMechanicsSettings s;
    s.motor.start_stop_hz = 1e6;
    s.motor.pull_out_hz = 2e6;
    s.encoder.counts_per_rev = counts_per_rev;
    return s;
}

rc::Gen<std::int64_t> some_counts() {
    return rc::gen::element<std::int64_t>(400, 3200, 4000, 1024, 10'000, 777, 100'000);
}

std::vector<PulseLaw> some_laws(int size, int min_period_us = 2) {
    std::vector<PulseLaw> laws;
    for (int i = 0; i < size; ++i)
        laws.push_back({milliseconds(10 * i), microseconds(*rc::gen::inRange(min_period_us, 100)),
                        *rc::gen::inRange<std::int64_t>(-1, 2)});
    return laws;
}

struct EncoderWorld {
    EncoderWorld(const AxisMechanicsSettings& settings, std::vector<PulseLaw> laws)
        : pulses(kernel, std::move(laws)), machine(kernel, "X", settings), listener(kernel) {
        machine.connect(pulses);
        kernel.listen(machine.index_wire(), listener.id, 0);
    }
    std::int64_t encoder() { return machine.encoder().count(kernel.now()); }
    std::int64_t rotor() { return machine.rotor().count(kernel.now()); }
    Kernel kernel;
    FakePulses pulses;
    AxisMechanics machine;
    WireListener listener;
};

// ---- Counts and watches

RC_GTEST_PROP(Encoder, ShowsTheFloorOfTheRatioInBothDirections, ()) {
    const std::int64_t counts = *some_counts();
    EncoderWorld w(with_counts(counts), some_laws(5));
    w.kernel.start();
    for (int i = 1; i <= 10; ++i) {
        w.kernel.run_until(milliseconds(6 * i));
        const std::int64_t rotor = w.pulses.count(w.kernel.now());
        const std::int64_t exact = rotor * counts;
        const std::int64_t shown = w.encoder();
        RC_ASSERT(shown * 3200 <= exact && exact < (shown + 1) * 3200);
        const QuadratureLevels lines = w.machine.encoder_lines(w.kernel.now());
        RC_ASSERT(lines.a + 2 * lines.b == sim::lines_of(shown));
    }
}

RC_GTEST_PROP(Encoder, AWatchIsReportedAtTheVeryPulse, ()) {
    const std::int64_t direction = *rc::gen::element<std::int64_t>(-1, 1);
    EncoderWorld w(with_counts(*some_counts()), {{Instant{0}, microseconds(10), direction}});
    CrossingListener listener(w.machine.encoder());
    w.kernel.start();
    const std::int64_t bound = direction * *rc::gen::inRange(1, 500);
    listener.watch(direction < 0 ? bound : -1'000'000, direction > 0 ? bound : 1'000'000);
    w.kernel.run_until(milliseconds(50));
    if (listener.at.empty()) {
        RC_ASSERT(w.encoder() * direction < bound * direction);
        return;
    }
    RC_ASSERT(listener.at.size() == 1u);
    RC_ASSERT(listener.at[0] % microseconds(10) == Duration{0});
    RC_ASSERT(listener.counts[0] * direction >= bound * direction);
    const std::int64_t pulse = listener.at[0] / microseconds(10) * direction;
    const std::int64_t counts = w.machine.settings().encoder.counts_per_rev;
    RC_ASSERT(floor_div((pulse - direction) * counts, 3200) * direction < bound * direction);
}

TEST(Encoder, AWatchedRangeThatIsAlreadyLeftIsReportedAtTheNextInstantEvenAtStandstill) {
    EncoderWorld w(with_counts(4000), {});
    CrossingListener listener(w.machine.encoder());
    w.kernel.start();
    w.kernel.run_until(Instant{100});
    listener.watch(0, 10);
    w.kernel.run_until(Instant{200});
    EXPECT_EQ(listener.at, std::vector<Instant>{Instant{101}});
}

TEST(Encoder, ManyListenersShareOneSlotOfThePulses) {
    EncoderWorld w(with_counts(4000), {{Instant{0}, microseconds(10), 1}});
    std::vector<std::unique_ptr<CrossingListener>> listeners;
    for (int i = 0; i < 12; ++i)
        listeners.push_back(std::make_unique<CrossingListener>(i % 2 ? w.machine.encoder() : w.machine.rotor()));
    w.kernel.start();
    for (int i = 0; i < 12; ++i)
        listeners[static_cast<std::size_t>(i)]->watch(-5, i % 2 ? 125 * (i + 1) : 100 * (i + 1));
    w.kernel.run_until(milliseconds(100));
    for (int i = 0; i < 12; ++i)
        EXPECT_EQ(listeners[static_cast<std::size_t>(i)]->at, std::vector<Instant>{milliseconds(i + 1)});
    EXPECT_EQ(listeners[1]->rate, 125'000);
    EXPECT_EQ(listeners[0]->rate, 100'000);
}

// ---- Index

TEST(Encoder, TheIndexIsOneCountWidePerRevolutionAndCostsNoEventsWithoutASubscriber) {
    EncoderWorld w(with_counts(3200),
                   {{Instant{0}, microseconds(1000), 1}, {milliseconds(4000), microseconds(1000), -1}});
    w.kernel.start();
    w.kernel.subscribe(w.machine.index_wire(), w.listener.id, true);
    EXPECT_EQ(w.kernel.level(w.machine.index_wire()), 1);
    w.kernel.run_until(milliseconds(5000));
    EXPECT_EQ(w.listener.heard, (std::vector<std::pair<int, Instant>>{{0, milliseconds(1)},
                                                                      {1, milliseconds(3200)},
                                                                      {0, milliseconds(3201)},
                                                                      {1, milliseconds(4800)},
                                                                      {0, milliseconds(4801)}}));
    w.kernel.subscribe(w.machine.index_wire(), w.listener.id, false);
    const std::uint64_t events = w.kernel.events();
    w.kernel.run_until(milliseconds(20'000));
    EXPECT_EQ(w.kernel.events(), events);
}

TEST(Encoder, AnIndexPassedWithinOneMicrostepIsDetected) {
    AxisMechanicsSettings s = with_counts(4001);  // revolutions end between microsteps, counts are skipped
    s.motor.microsteps = 1;                       // 20 counts a pulse
    EncoderWorld w(s, {{Instant{0}, milliseconds(1), 1}});
    w.kernel.start();
    w.kernel.subscribe(w.machine.index_wire(), w.listener.id, true);
    w.kernel.run_until(milliseconds(2010));
    int rises = 0;
    for (const auto& [level, at] : w.listener.heard) rises += level;
    EXPECT_EQ(rises, 10);
    EXPECT_EQ(w.listener.heard[1], (std::pair{1, milliseconds(200)}));
}

// ---- Edges

RC_GTEST_PROP(Encoder, EdgesOneByOneComeToTheSameCountAsTheClosedForm, ()) {
    AxisMechanicsSettings s = with_counts(*some_counts());
    s.motor.start_stop_hz = *rc::gen::element(20'000.0, 1e6);
    EncoderWorld w(s, some_laws(6));
    EdgeRecorder listener, rotor;
    w.kernel.start();
    w.machine.encoder().set_edge_listener(&listener);
    w.machine.rotor().set_edge_listener(&rotor);
    for (int i = 1; i <= 10; ++i) {
        w.kernel.run_until(milliseconds(7 * i));
        if (i == 4) w.machine.fault("push", *rc::gen::inRange(-300, 300), w.kernel.now());
        if (i == 6) w.machine.fault("stall", 1, w.kernel.now());
        if (i == 7) w.machine.fault("stall", 0, w.kernel.now());
        RC_ASSERT(listener.count == w.encoder());
        RC_ASSERT(rotor.count == w.rotor());
        RC_ASSERT(listener.joined && rotor.joined);
        RC_ASSERT(listener.ordered && rotor.ordered);
    }
}

TEST(Encoder, EdgesStopAtTheEndOfTravel) {
    AxisMechanicsSettings s = with_counts(4000);
    s.axle.end_plus = 1.0;
    EncoderWorld w(s, {{Instant{0}, microseconds(10), 1}, {milliseconds(20), microseconds(10), -1}});
    EdgeRecorder listener, rotor;
    w.kernel.start();
    w.machine.encoder().set_edge_listener(&listener);
    w.machine.rotor().set_edge_listener(&rotor);
    w.kernel.run_until(milliseconds(15));
    EXPECT_EQ(rotor.count, 640);
    EXPECT_EQ(listener.count, 800);
    w.kernel.run_until(milliseconds(25));
    EXPECT_EQ(rotor.count, w.rotor());
    EXPECT_EQ(listener.count, w.encoder());
    EXPECT_TRUE(listener.joined && rotor.joined && listener.ordered && rotor.ordered);
    EXPECT_LT(rotor.count, 640);
}

TEST(Encoder, PulseEdgesAreForwardedUnchanged) {
    EncoderWorld w(with_counts(4000), {{Instant{0}, microseconds(10), 1}});
    EdgeRecorder pulses, encoder;
    w.kernel.start();
    w.machine.listen_pulse_edges(&pulses);
    w.kernel.run_until(milliseconds(1));
    w.machine.encoder().set_edge_listener(&encoder);
    encoder.count = w.encoder();
    w.kernel.run_until(milliseconds(10));
    EXPECT_EQ(pulses.count, 1000);
    EXPECT_EQ(pulses.last, milliseconds(10));
    EXPECT_EQ(encoder.count, 1250);
    w.machine.listen_pulse_edges(nullptr);
    w.kernel.run_until(milliseconds(11));
    EXPECT_EQ(pulses.count, 1000);
    EXPECT_EQ(encoder.count, 1375);
    w.machine.encoder().set_edge_listener(nullptr);
    w.kernel.run_until(milliseconds(12));
    EXPECT_EQ(encoder.count, 1375);
}

// ---- Broken wiring

RC_GTEST_PROP(Encoder, BrokenAndSwappedLinesCountWhatADecoderOfThoseLinesCounts, ()) {
    const std::string name = *rc::gen::element<std::string>("broken_a", "encoder.broken_b", "swapped");
    EncoderWorld w(with_counts(800), some_laws(8, 20));  // sampled often enough to see every edge
    EdgeRecorder edges;
    w.kernel.start();
    w.machine.encoder().set_edge_listener(&edges);
    sim::QuadratureDecoder decoder;
    std::uint64_t both_changed = 0;
    bool broken = false;
    for (int i = 1; i <= 4000; ++i) {
        w.kernel.run_until(microseconds(20) * i - (i % 2 ? Duration{0} : Duration{1}));
        if (i % 1000 == 400 || i % 1000 == 800) {
            broken = !broken;
            const QuadratureLevels before = w.machine.encoder_lines(w.kernel.now());
            decoder.lines(static_cast<std::uint8_t>(before.a + 2 * before.b));
            RC_ASSERT(w.machine.fault(name, broken, w.kernel.now()));
            if (name == "swapped" && before.a != before.b) {  // both lines change at once: the machine counts two
                ++both_changed;
                decoder.set_count(decoder.count() + 2);
            }
        }
        const QuadratureLevels lines = w.machine.encoder_lines(w.kernel.now());
        decoder.lines(static_cast<std::uint8_t>(lines.a + 2 * lines.b));
        RC_ASSERT(decoder.illegal() == both_changed);
        RC_ASSERT(decoder.count() == w.encoder());
        RC_ASSERT(edges.count == w.encoder());
        RC_ASSERT(edges.joined);
    }
}

TEST(Encoder, ABrokenLineMakesTheCountOscillateWithinTheWatchedRange) {
    EncoderWorld w(with_counts(3200), {{Instant{0}, microseconds(10), 1}});
    CrossingListener listener(w.machine.encoder());
    w.kernel.start();
    EXPECT_TRUE(w.machine.fault("broken_a", 1, w.kernel.now()));
    EXPECT_EQ(w.machine.encoder().rate(w.kernel.now()), 0);
    listener.watch(-2, 1);
    w.kernel.run_until(milliseconds(100));
    EXPECT_TRUE(listener.at.empty());
    EXPECT_LE(w.kernel.events(), 2u);
    EXPECT_EQ(w.encoder(), 0);
    listener.watch(-1, 1);
    w.kernel.run_until(milliseconds(200));
    EXPECT_EQ(listener.at, std::vector<Instant>{milliseconds(100) + microseconds(20)});
    EXPECT_TRUE(w.machine.fault("broken_a", 0, w.kernel.now()));
    const std::int64_t before = w.encoder();
    w.kernel.run_until(milliseconds(201));
    EXPECT_EQ(w.encoder(), before + 100);
}

TEST(Encoder, SwappedLinesCountBackwards) {
    EncoderWorld w(with_counts(3200), {{Instant{0}, microseconds(10), 1}});
    CrossingListener listener(w.machine.encoder());
    w.kernel.start();
    EXPECT_TRUE(w.machine.fault("swapped", 1, w.kernel.now()));
    listener.watch(-100, 100);
    w.kernel.run_until(milliseconds(2));
    EXPECT_EQ(w.encoder(), -200);
    EXPECT_EQ(listener.at, std::vector<Instant>{milliseconds(1)});
    EXPECT_EQ(listener.rate, -100'000);
}

TEST(AxisMechanics, AMoveWithEdgesSwitchesAndIndexAllocatesNothing) {
    AxisMechanicsSettings s = with_counts(4000);
    s.limit_plus.position = 2;
    s.home.position = 1;
    s.motor.start_stop_hz = 150'000;
    EncoderWorld w(s, {{Instant{0}, microseconds(10), 1},
                       {milliseconds(100), microseconds(10), -1},
                       {milliseconds(150), microseconds(10), 0}});
    EdgeRecorder listener;
    w.kernel.start();
    w.machine.encoder().set_edge_listener(&listener);
    w.kernel.subscribe(w.machine.index_wire(), w.listener.id, true);
    w.listener.heard.reserve(1000);
    const std::uint64_t before = sim::allocations();
    w.kernel.run_until(milliseconds(200));
    EXPECT_EQ(sim::allocations(), before);
    EXPECT_GT(listener.edge_count, 12'000);
    EXPECT_FALSE(w.listener.heard.empty());
    EXPECT_NE(w.machine.lost_steps(), 0);
}

}  // namespace
}  // namespace motionrack::parts
