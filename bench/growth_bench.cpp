// Growth of the work of a rack with the axes of a card, its cards, and the cards and scales of a grating bus. Times are
// per pulse and per frame: constant down a column means linear growth. Memory is that of the process, so each size is
// best run alone: --benchmark_filter=^cards/8$
#include <benchmark/benchmark.h>

#include <motionrack/cards/grating_bus/test/rig.hpp>
#include <vector>

#include "chip_work.hpp"

namespace motionrack::bench {
namespace {

using benchmark::Counter;

/// One of several chips in a kernel, with a machine on each axis.
class Card : public mcx314::Commands<Card> {
  public:
    Card(sim::Kernel& kernel, const std::string& name) : chip_(kernel, name), machines_(kernel, name, chip_) {}
    void write(int number, unsigned value) {
        chip_.write(static_cast<std::uint32_t>(2 * number), static_cast<std::uint16_t>(value));
    }
    bool drives() { return (chip_.read(0) & all_axes) != 0; }

  private:
    mcx314::Chip chip_;
    Machines machines_;
};

void count(benchmark::State& state, const char* what, double all, double seconds) {
    state.counters[what] = Counter(all, Counter::kIsRate);
    state.counters["each"] = Counter(all, Counter::kIsRate | Counter::kInvert);
    state.counters["sim_s/s"] = Counter(seconds, Counter::kIsRate);
}

/// Drives the given number of axes of one card, each with a machine, through the stepper's move together.
void axes(benchmark::State& state) {
    const unsigned mask = (1u << state.range(0)) - 1;
    Stage stage(true);
    prepare(stage.host, stepper, mask);
    stage.host.advance(milliseconds(1));
    const double begin = stage.seconds();
    bool plus = true;
    for (auto _ : state) {
        drive_fixed(stage.host, stepper.pulses, plus, mask);
        stage.finish();
        plus = !plus;
    }
    const auto pulses = static_cast<double>(stage.pulses());
    if (pulses != static_cast<double>(state.range(0) * stepper.pulses) * static_cast<double>(state.iterations()))
        state.SkipWithError("pulses were lost");
    count(state, "pulses/s", pulses, stage.seconds() - begin);
}
BENCHMARK(axes)->DenseRange(1, 4);

/// Drives all four axes of the given number of cards in one kernel through the same move.
void cards(benchmark::State& state) {
    sim::Kernel kernel;
    std::vector<std::unique_ptr<Card>> all;
    for (std::int64_t i = 0; i < state.range(0); ++i)
        all.push_back(std::make_unique<Card>(kernel, std::string("c").append(std::to_string(i))));
    kernel.start();
    for (const auto& card : all) prepare(*card, stepper);
    mcx314::outside::advance(kernel, milliseconds(1));
    const Instant begin = kernel.now();
    bool plus = true;
    for (auto _ : state) {
        for (const auto& card : all) drive_fixed(*card, stepper.pulses, plus);
        for (const auto& card : all)
            while (card->drives()) mcx314::outside::advance(kernel, milliseconds(10));
        plus = !plus;
    }
    const double pulses =
        4.0 * static_cast<double>(state.range(0) * stepper.pulses) * static_cast<double>(state.iterations());
    count(state, "pulses/s", pulses, to_seconds(kernel.now() - begin));
    state.counters["snapshot_bytes"] = static_cast<double>(kernel.snapshot().bytes.size());
}
BENCHMARK(cards)->Arg(1)->Arg(2)->Arg(4)->Arg(8)->Arg(16)->Arg(32);

/// Runs a grating bus with the given numbers of slaves and scales, without observers; `each` is the time per frame of
/// one card.
void frames(benchmark::State& state) {
    const auto slaves = static_cast<int>(state.range(0)), scales = static_cast<int>(state.range(1));
    grating_bus::Crate crate(grating_bus::crew(slaves, scales), scales, {}, false);
    std::int64_t periods = 0;
    for (auto _ : state) crate.run_to(++periods * microseconds(200) - microseconds(100));
    for (const auto& card : crate.cards)
        if (card->frames() != periods) state.SkipWithError("a frame was lost");
    count(state, "frames/s", static_cast<double>(periods) * static_cast<double>(crate.cards.size()),
          to_seconds(crate.kernel.now() - Instant{0}));
}
BENCHMARK(frames)
    ->ArgNames({"slaves", "scales"})
    ->Args({1, 8})
    ->Args({2, 8})
    ->Args({5, 8})
    ->Args({10, 8})
    ->Args({20, 8});
BENCHMARK(frames)->ArgNames({"slaves", "scales"})->Args({10, 1})->Args({10, 64})->Args({10, 128});

}  // namespace
}  // namespace motionrack::bench

BENCHMARK_MAIN();
