// Frames of the grating bus per second and core: the virtual cards, against the clocked simulation that verilator makes
// of hdl/grating_bus, if installed.
//
// Eight moving scales, a host and ten slaves, 200 us per period, which is 20,000 clocks of 100 MHz. `frames/s` counts
// periods, in each of which every card publishes its frame with its CRC; `baseline/s` is the clocked simulation,
// `ratio` their quotient.
#include <benchmark/benchmark.h>

#include <motionrack/cards/grating_bus/test/rig.hpp>

#ifdef MOTIONRACK_VERILATED
#include <chrono>

#include "VGrating.h"
#endif

namespace motionrack::bench {
namespace {

using benchmark::Counter;
using namespace grating_bus;

constexpr int slaves = 10, words = 8, period_clocks = 20'000;
constexpr Duration period = microseconds(200);

// ---- clocked

#ifdef MOTIONRACK_VERILATED

class Clocked {
  public:
    Clocked() {
        context_.threads(1);
        system_ = std::make_unique<VGrating>(&context_);
    }
    /// Simulates `clocks` clocks; counts those at which all cards complete a frame together.
    void run(int clocks) {
        for (int i = 0; i < clocks; ++i) {
            system_->clock = 1;
            system_->eval();
            frames_ += system_->frame_done == (1 << (slaves + 1)) - 1;
            system_->clock = 0;
            system_->eval();
        }
    }
    std::int64_t frames() const { return frames_; }
    /// Claims the last frame. Returns true if all cards hold the same frame, its time is `clock` clocks, scale 0 is at
    /// its expected count, and no line has a conflict.
    bool holds_frame_of(std::int64_t clock) {
        system_->claim = 1;
        run(1);
        system_->claim = 0;
        for (int word = 0; word < words; ++word) {
            system_->word_asked = static_cast<std::uint8_t>(word);
            run(1);
            for (int card = 1; card <= slaves; ++card)
                if (system_->words_read[card] != system_->words_read[0] ||
                    system_->crcs_read[card] != system_->crcs_read[0])
                    return false;
            if (word == 0 && system_->words_read[0] != static_cast<std::uint32_t>((clock - 1) * 13'107 / 65'536))
                return false;
        }
        return system_->times_read[0] == static_cast<std::uint32_t>(clock * 100) && !system_->conflict &&
               !system_->clk_conflict;
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
    if (clocked.frames() != periods) state.SkipWithError("a frame was lost");
    if (!clocked.holds_frame_of((periods - 1) * period_clocks + 2))
        state.SkipWithError("the cards hold other frames than they must");
    state.counters["frames/s"] = Counter(static_cast<double>(periods), Counter::kIsRate);
    state.counters["clocks/s"] = Counter(static_cast<double>(periods * period_clocks), Counter::kIsRate);
}
BENCHMARK(frames_clocked);

/// Returns frames per second: the maximum of many tries, so that other load does not slow the baseline.
double clocked_rate() {
    static const double rate = [] {
        Clocked clocked;
        double best = 0;
        for (int i = 0; i < 100; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            clocked.run(period_clocks);
            best = std::max(best, 1 / std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
        return best;
    }();
    return rate;
}

void count_ratio(benchmark::State& state, double frames) {
    state.counters["baseline/s"] = clocked_rate();
    state.counters["ratio"] = Counter(frames / clocked_rate(), Counter::kIsRate);
}

#else

void count_ratio(benchmark::State&, double) {}

#endif

// ---- the virtual cards

/// Runs cards without wire listeners unless `wires_watched`; `claims`: each processor claims and validates each frame.
void frames_of_cards(benchmark::State& state, bool wires_watched, bool claims) {
    sim::Kernel kernel;
    Bus bus(kernel);
    Watcher watcher(kernel);
    grating_bus::DecoderSettings decoder_settings;
    decoder_settings.scales = words;
    Decoder decoder(kernel, "decoder", bus, decoder_settings);
    std::vector<std::unique_ptr<EvenMotion>> motions;
    for (const std::int64_t speed : speeds(words)) {
        motions.push_back(std::make_unique<EvenMotion>(0, speed));
        decoder.connect(static_cast<int>(motions.size()) - 1, motions.back().get());
    }
    std::vector<std::unique_ptr<Card>> cards;
    for (const CardSettings& settings : crew(slaves, words))
        cards.push_back(
            std::make_unique<Card>(kernel, std::string("c").append(std::to_string(cards.size())), bus, settings));
    watcher.connect();
    kernel.start();
    watcher.watch(wires_watched);
    std::int64_t periods = 0, bad = 0;
    const auto run_to = [&](Instant at) {
        while (kernel.run_until(at) == sim::RunEnd::broken) {
        }
    };
    for (auto _ : state) {
        run_to(++periods * period - microseconds(100));
        if (claims)
            for (const auto& card : cards) {
                card->write(offset("CONTROL"), 1);
                bad += card->peek(offset("SEQUENCE_L")) != ((periods - 1) & 0xFFFF);
            }
    }
    for (const auto& card : cards) {
        const Frame* last = card->last();
        bad += card->frames() != periods || !last || !sound(*last) || !same(*last, *cards[0]->last());
        for (int k = 0; last && k < words; ++k)
            bad += last->counts[static_cast<std::size_t>(k)] !=
                   static_cast<std::uint32_t>(motions[static_cast<std::size_t>(k)]->count(last->instant()));
    }
    if (bad != 0) state.SkipWithError("the cards hold other frames than they must");
    state.counters["frames/s"] = Counter(static_cast<double>(periods), Counter::kIsRate);
    count_ratio(state, static_cast<double>(periods));
}
BENCHMARK_CAPTURE(frames_of_cards, alone, false, false);
BENCHMARK_CAPTURE(frames_of_cards, every_card_claims, false, true);
BENCHMARK_CAPTURE(frames_of_cards, every_wire_watched, true, false);

}  // namespace
}  // namespace motionrack::bench

BENCHMARK_MAIN();
