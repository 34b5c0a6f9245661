// The three forms of a quadrature counter agree, and the table gives the count of every transition.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>

namespace motionrack::sim {
namespace {

TEST(QuadratureDecoder, EveryTransitionCountsUpDownNothingOrIsIllegal) {
    // Lines B A; up is 00 01 11 10.
    const std::uint8_t up[4] = {0, 1, 3, 2};
    for (int i = 0; i < 4; ++i) {
        const std::uint8_t here = up[i];
        EXPECT_EQ(QuadratureDecoder(Edges::all, here).lines(up[(i + 1) % 4]), +1);
        EXPECT_EQ(QuadratureDecoder(Edges::all, here).lines(up[(i + 3) % 4]), -1);
        EXPECT_EQ(QuadratureDecoder(Edges::all, here).lines(here), 0);
        QuadratureDecoder jumped(Edges::all, here);
        EXPECT_EQ(jumped.lines(up[(i + 2) % 4]), 0);
        EXPECT_EQ(jumped.illegal(), 1u);
    }
}

TEST(QuadratureDecoder, TheIndexLatchesAtItsRisingEdgeAndClearsIfAsked) {
    QuadratureDecoder d;
    for (std::int64_t c = 1; c <= 9; ++c) d.lines(lines_of(c));
    d.index(1);
    d.index(1);
    EXPECT_EQ(d.latched(), 9);
    EXPECT_EQ(d.indices(), 1u);
    EXPECT_EQ(d.count(), 9);
    d.index(0);
    d.index(1, true);
    EXPECT_EQ(d.count(), 0);
    EXPECT_EQ(d.indices(), 2u);
}

RC_GTEST_PROP(QuadratureDecoder, CountsFewerEdgesAsTheClosedFormStates, (std::vector<bool> ups)) {
    for (const Edges edges : {Edges::all, Edges::both_of_a, Edges::rising_a})
        for (int first = 0; first < 4 / static_cast<int>(edges); ++first) {
            QuadratureDecoder d(edges, 0, first);
            const ClosedFormCounter closed(edges, false, first);
            std::int64_t count = 0;
            for (const bool up : ups) {
                count += up ? 1 : -1;
                d.lines(lines_of(count));
                RC_ASSERT(d.count() == divided(count - first, edges));
                RC_ASSERT(d.count() == closed.from_motion(count));
            }
            RC_ASSERT(d.illegal() == 0u);
        }
}

RC_GTEST_PROP(BatchDecoder, DecodesAnyLinesAsTheTableDoes, ()) {
    // Decodes lines from steady motion in one direction to lines with random values in half of the samples, in
    // batches of up to 5999 samples.
    const int noise = *rc::gen::inRange(0, 5);
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    std::uint64_t x = seed;
    auto bits = [&x] { return (x = x * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u) >> 40; };
    QuadratureDecoder reference;
    BatchDecoder batch;
    std::int64_t phase = 0;
    for (int piece = 0; piece < 8; ++piece) {
        std::vector<std::uint8_t> lines(bits() % 6000);
        for (std::uint8_t& l : lines) {
            phase += bits() % 8 < static_cast<std::uint64_t>(noise) ? static_cast<std::int64_t>(bits() % 4) : 1;
            l = lines_of(phase);
            reference.lines(l);
        }
        batch.decode(lines.data(), lines.size());
        RC_ASSERT(batch.count() == reference.count());
        RC_ASSERT(batch.illegal() == reference.illegal());
    }
}

RC_GTEST_PROP(BatchDecoder, FollowsTheEdgesOfAMotion, ()) {
    Kernel kernel;
    std::vector<PulseLaw> laws;
    for (int i = 0; i < 6; ++i)
        laws.push_back(
            {milliseconds(i), Duration{*rc::gen::inRange(1000, 100'000)}, *rc::gen::inRange<std::int64_t>(-1, 2)});
    FakePulses pulses(kernel, laws);
    BatchDecoder decoder;
    kernel.start();
    pulses.set_edge_listener(&decoder);
    for (int i = 1; i <= 12; ++i) {
        kernel.run_until(microseconds(600) * i);
        RC_ASSERT(decoder.count() == pulses.count(kernel.now()));
    }
    RC_ASSERT(decoder.illegal() == 0u);
}

class Watcher final : public PositionListener {
  public:
    void crossed(Instant now) override { at.push_back(now); }
    void rate_changed(double, double, Instant) override {}
    std::vector<Instant> at;
};

RC_GTEST_PROP(ClosedFormCounter, WatchesItsOwnValueThroughDivisionDirectionAndOffset, ()) {
    Kernel kernel;
    const std::int64_t direction = *rc::gen::element<std::int64_t>(-1, 1);
    FakePulses pulses(kernel, {{Instant{0}, microseconds(1), direction}});
    Watcher watcher;
    const int slot = pulses.add_listener(watcher);
    ClosedFormCounter counter(*rc::gen::element(Edges::all, Edges::both_of_a, Edges::rising_a),
                              *rc::gen::arbitrary<bool>());
    kernel.start();
    kernel.run_until(microseconds(*rc::gen::inRange(1, 50)));
    counter.set(*rc::gen::inRange(-100, 100), pulses, kernel.now());
    const std::int64_t value = counter.value(pulses, kernel.now());
    const std::int64_t low = value - *rc::gen::inRange(1, 20), high = value + *rc::gen::inRange(1, 20);
    counter.watch(pulses, slot, low, high);
    while (watcher.at.empty()) kernel.run_until(kernel.now() + microseconds(1));
    RC_ASSERT(watcher.at.size() == 1u);
    const std::int64_t then = counter.value(pulses, watcher.at[0]);
    RC_ASSERT(then == low || then == high);
    const std::int64_t before = counter.from_motion(pulses.count(watcher.at[0]) - direction);
    RC_ASSERT(before > low && before < high);
}

}  // namespace
}  // namespace motionrack::sim
