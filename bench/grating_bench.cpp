// Frames of the grating bus a second of one core: the clocked simulation that verilator makes of tests/verilog/grating.
//
// N = 8 moving scales, a host and ten slaves, 200 us a period: 20,000 clocks of 100 MHz. `frames/s` counts periods, each of which
// publishes a frame on every card.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>

#include "VGrating.h"

namespace motionrack::bench {
namespace {

using benchmark::Counter;

constexpr int cards = 11, words = 8, period_clocks = 20'000;

class Clocked {
  public:
    Clocked() {
        context_.threads(1);
        system_ = std::make_unique<VGrating>(&context_);
    }
    /// Counts the clocks at which all cards had their frame at once.
    void run(int clocks) {
        for (int i = 0; i < clocks; ++i) {
            system_->clock = 1;
            system_->eval();
            frames_ += system_->frame_done == (1 << cards) - 1;
            system_->clock = 0;
            system_->eval();
        }
    }
    std::int64_t frames() const { return frames_; }
    bool conflict() const { return system_->conflict != 0; }
    /// Claims the last frame; whether it is the same on all cards, of that time in clocks, and scale 0 where it must be.
    bool holds_frame_of(std::int64_t clock) {
        system_->claim = 1;
        run(1);
        system_->claim = 0;
        for (int word = 0; word < words; ++word) {
            system_->word_asked = static_cast<std::uint8_t>(word);
            system_->eval();
            for (int card = 1; card < cards; ++card)
                if (system_->words_read[card] != system_->words_read[0] || system_->crcs_read[card] != system_->crcs_read[0]) return false;
            if (word == 0 && system_->words_read[0] != static_cast<std::uint32_t>((clock - 1) * 13'107 / 65'536)) return false;
        }
        return system_->times_read[0] == static_cast<std::uint32_t>(clock * 100);
    }

  private:
    VerilatedContext context_;
    std::unique_ptr<VGrating> system_;
    std::int64_t frames_ = 0;
};

void frames_clocked(benchmark::State& state) {
    Clocked clocked;
    std::int64_t periods = 0;
    for (auto _ : state) {
        clocked.run(period_clocks);
        ++periods;
    }
    if (clocked.frames() != periods || clocked.conflict()) state.SkipWithError("a frame was lost");
    if (!clocked.holds_frame_of((periods - 1) * period_clocks + 2)) state.SkipWithError("the cards hold other frames than they must");
    state.counters["frames/s"] = Counter(static_cast<double>(periods), Counter::kIsRate);
    state.counters["card_frames/s"] = Counter(static_cast<double>(periods * cards), Counter::kIsRate);
    state.counters["clocks/s"] = Counter(static_cast<double>(periods * period_clocks), Counter::kIsRate);
}
BENCHMARK(frames_clocked);

}  // namespace
}  // namespace motionrack::bench

BENCHMARK_MAIN();
