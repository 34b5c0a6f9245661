// One drive of one axis of the MCX314. Compares the virtual chip, which computes it in closed form, with the clocked
// simulation that verilator makes of tests/verilog/mcx314_axis.v, if installed. Before the measurement, both are
// checked to give the same pulses in the same ticks.
//
//  chip       command ─► ramp ─► cruise ─► ramp          a few hundred events; with an edge listener,
//                                                         one batch for each 2,048 edges
//   verilator  clock 0 1 0 1 0 1 0 1 0 1 0 1 0 1 ...      10 million clocks of 125 ns for the same 4.5 million pulses
#include <benchmark/benchmark.h>

#include "chip_work.hpp"

#ifdef MOTIONRACK_VERILATED
#include "VAxis.h"
#endif

namespace motionrack::bench {
namespace {

using benchmark::Counter;

constexpr unsigned axis_x = 1;

/// Pulses of one drive from either generator: their number, and the sum of their instants from the first one on.
class Pulses final : public sim::EdgeListener {
  public:
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) pulse(batch.origin + batch.tick * std::int64_t{batch.at[i]});
    }
    void pulse(Instant at) {
        if (made_++ == 0) first_ = at;
        sum_ += static_cast<std::uint64_t>((at - first_).count());
    }
    std::int64_t made() const { return made_; }
    friend bool operator==(const Pulses& a, const Pulses& b) { return a.made_ == b.made_ && a.sum_ == b.sum_; }

  private:
    std::int64_t made_ = 0;
    Instant first_{};
    std::uint64_t sum_ = 0;
};

void count_pulses(benchmark::State& state, const Move& move, std::int64_t made) {
    const std::int64_t asked = static_cast<std::int64_t>(state.iterations()) * move.pulses;
    if (made != asked) state.SkipWithError("pulses were lost");
    state.counters["pulses/s"] = Counter(static_cast<double>(asked), Counter::kIsRate);
    state.counters["each"] = Counter(static_cast<double>(asked), Counter::kIsRate | Counter::kInvert);
}

// ---- the virtual chip

/// Executes one drive after the other; the host polls every 10 ms. `heard`: the chip computes the instant of every
/// pulse and delivers it to a listener.
void drive(benchmark::State& state, const Move& move, bool heard) {
    Stage stage(false);
    Pulses pulses;
    if (heard) stage.host.chip.pulses(0).set_edge_listener(&pulses);
    prepare(stage.host, move, axis_x);
    stage.host.advance(milliseconds(1));
    bool plus = true;
    for (auto _ : state) {
        drive_fixed(stage.host, move.pulses, plus, axis_x);
        stage.finish();
        plus = !plus;
    }
    stage.host.chip.pulses(0).deliver_edges();
    count_pulses(state, move, heard ? pulses.made() : stage.pulses());
}
BENCHMARK_CAPTURE(drive, servo, servo, false);
BENCHMARK_CAPTURE(drive, servo_heard, servo, true);
BENCHMARK_CAPTURE(drive, servo_s, servo_s, false);
BENCHMARK_CAPTURE(drive, servo_s_heard, servo_s, true);
BENCHMARK_CAPTURE(drive, stepper, stepper, false);
BENCHMARK_CAPTURE(drive, stepper_heard, stepper, true);

// ---- clocked

#ifdef MOTIONRACK_VERILATED

class Clocked {
  public:
    explicit Clocked(const Move& move) {
        context_.threads(1);
        axis_ = std::make_unique<VAxis>(&context_);
        axis_->r = static_cast<std::uint32_t>(move.speeds.range);
        axis_->v = static_cast<std::uint16_t>(move.speeds.speed);
        axis_->sv = static_cast<std::uint16_t>(move.speeds.start);
        axis_->a = axis_->d = static_cast<std::uint16_t>(move.speeds.accel);
        axis_->k = static_cast<std::uint16_t>(move.speeds.jerk);
        axis_->p = static_cast<std::uint32_t>(move.pulses);
        axis_->ao = 0;
        axis_->dp = 0;
        axis_->manld = axis_->dsnde = axis_->continuous = axis_->start = axis_->stop = axis_->clock = 0;
        axis_->sacc = move.s_curve;
        axis_->eval();  // initial state, so that the first clock edge is seen
    }
    /// Runs one drive from its command to its end.
    void drive(Pulses& pulses) {
        axis_->start = 1;
        do {
            ++clock_;
            axis_->clock = 1;
            axis_->eval();
            if (axis_->pulse) pulses.pulse(mcx314::outside::tick * clock_);
            axis_->clock = 0;
            axis_->eval();
            axis_->start = 0;
        } while (axis_->busy);
    }
    std::int64_t clocks() const { return clock_; }

  private:
    VerilatedContext context_;
    std::unique_ptr<VAxis> axis_;
    std::int64_t clock_ = 0;
};

bool alike(const Move& move) {
    Pulses of_chip, of_clocked;
    Stage stage(false);
    stage.host.chip.pulses(0).set_edge_listener(&of_chip);
    prepare(stage.host, move, axis_x);
    drive_fixed(stage.host, move.pulses, true, axis_x);
    stage.finish();
    stage.host.chip.pulses(0).deliver_edges();
    Clocked(move).drive(of_clocked);
    return of_chip.made() == move.pulses && of_chip == of_clocked;
}

void drive_clocked(benchmark::State& state, const Move& move) {
    if (!alike(move)) return state.SkipWithError("the chip and the clocked simulation make other pulses");
    Clocked clocked(move);
    Pulses pulses;
    for (auto _ : state) clocked.drive(pulses);
    count_pulses(state, move, pulses.made());
    state.counters["clocks/s"] = Counter(static_cast<double>(clocked.clocks()), Counter::kIsRate);
}
BENCHMARK_CAPTURE(drive_clocked, servo, servo);
BENCHMARK_CAPTURE(drive_clocked, servo_s, servo_s);
BENCHMARK_CAPTURE(drive_clocked, stepper, stepper);

#endif

}  // namespace
}  // namespace motionrack::bench

BENCHMARK_MAIN();
