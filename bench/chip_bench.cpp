// Virtual time per second of one core on the virtual MCX314, compared with its tick-by-tick twin.
#include <benchmark/benchmark.h>

#include "chip_work.hpp"

namespace motionrack::bench {
namespace {

using benchmark::Counter;

void count_time(benchmark::State& state, double seconds, double pulses) {
    state.counters["sim_s/s"] = Counter(seconds, Counter::kIsRate);
    state.counters["pulses/s"] = Counter(pulses, Counter::kIsRate);
}

// ---- cruising: four axes at 4 Mpps, without edge listeners

/// All axes cruise; the host polls every `slice`.
void cruise(benchmark::State& state, Duration slice, bool machines) {
    Stage stage(machines);
    set_speeds(stage.host, {});
    stage.host.command(all_axes, 0x22);
    stage.host.advance(milliseconds(1));
    const double begin = stage.seconds();
    const auto pulses = static_cast<double>(stage.pulses());
    for (auto _ : state) {
        stage.host.advance(slice);
        benchmark::DoNotOptimize(stage.host.chip.lp(0));
    }
    count_time(state, stage.seconds() - begin, static_cast<double>(stage.pulses()) - pulses);
}
BENCHMARK_CAPTURE(cruise, look_each_second, whole_seconds(1), false);
BENCHMARK_CAPTURE(cruise, look_each_second_machines, whole_seconds(1), true);
BENCHMARK_CAPTURE(cruise, look_each_ms, milliseconds(1), false);
BENCHMARK_CAPTURE(cruise, look_each_ms_machines, milliseconds(1), true);

void cruise_twin(benchmark::State& state) {
    mcx314::twin::Host host;
    host.twin.record(false);
    set_speeds(host, {});
    host.command(all_axes, 0x22);
    host.twin.run(8'000);
    const std::int64_t begin = host.twin.now(), first = host.twin.count(0);
    for (auto _ : state) host.twin.run(8'000);
    count_time(state, static_cast<double>(host.twin.now() - begin) / 8e6,
               4 * static_cast<double>(host.twin.count(0) - first));
}
BENCHMARK(cruise_twin);

// ---- whole moves with their ramps

void moves(benchmark::State& state, const Move& move, bool machines) {
    Stage stage(machines);
    prepare(stage.host, move);
    stage.host.advance(milliseconds(1));
    const double begin = stage.seconds();
    const auto pulses = static_cast<double>(stage.pulses());
    const std::uint64_t events = stage.host.kernel.events();
    bool plus = true;
    for (auto _ : state) {
        drive_fixed(stage.host, move.pulses, plus);
        stage.finish();
        plus = !plus;
    }
    count_time(state, stage.seconds() - begin, static_cast<double>(stage.pulses()) - pulses);
    state.counters["events/s"] = Counter(static_cast<double>(stage.host.kernel.events() - events), Counter::kIsRate);
}
void moves_twin(benchmark::State& state, const Move& move) {
    mcx314::twin::Host host;
    host.twin.record(false);
    prepare(host, move);
    std::int64_t ticks = 0;
    bool plus = true;
    for (auto _ : state) {
        drive_fixed(host, move.pulses, plus);
        ticks += host.until_idle(1'000'000'000);
        plus = !plus;
    }
    count_time(state, static_cast<double>(ticks) / 8e6, 4 * static_cast<double>(state.iterations() * move.pulses));
}
BENCHMARK_CAPTURE(moves, servo, servo, false);
BENCHMARK_CAPTURE(moves, servo_machines, servo, true);
BENCHMARK_CAPTURE(moves_twin, servo, servo);
BENCHMARK_CAPTURE(moves, servo_s, servo_s, false);
BENCHMARK_CAPTURE(moves_twin, servo_s, servo_s);
BENCHMARK_CAPTURE(moves, stepper, stepper, false);
BENCHMARK_CAPTURE(moves, stepper_machines, stepper, true);
BENCHMARK_CAPTURE(moves_twin, stepper, stepper);
BENCHMARK_CAPTURE(moves, stepper_s, stepper_s, false);
BENCHMARK_CAPTURE(moves_twin, stepper_s, stepper_s);

/// Executes a drive of one axis that accelerates and decelerates throughout; returns its number of kernel events.
std::uint64_t ramps(Stage& stage, bool plus) {
    const std::uint64_t before = stage.host.kernel.events();
    drive_fixed(stage.host, 50'000, plus, 1);
    stage.finish();
    return stage.host.kernel.events() - before;
}

/// Cost of a velocity step. With a machine it is a kernel event that notifies the machine; without, an iteration of a
/// loop.
void speed_steps(benchmark::State& state, bool s_curve, bool machines) {
    Stage stage(machines), heard(true);
    for (Stage* each : {&stage, &heard}) {
        prepare(each->host, {{800'000, 1, 8'000, 100, 100}, 0, s_curve});
        each->host.advance(milliseconds(1));
    }
    const auto steps = static_cast<double>(ramps(heard, true));
    bool plus = true;
    for (auto _ : state) {
        ramps(stage, plus);
        plus = !plus;
    }
    const double all = steps * static_cast<double>(state.iterations());
    state.counters["steps/s"] = Counter(all, Counter::kIsRate);
    state.counters["each"] = Counter(all, Counter::kIsRate | Counter::kInvert);
}
BENCHMARK_CAPTURE(speed_steps, t_curve, false, false);
BENCHMARK_CAPTURE(speed_steps, t_curve_machines, false, true);
BENCHMARK_CAPTURE(speed_steps, s_curve, true, false);
BENCHMARK_CAPTURE(speed_steps, s_curve_machines, true, true);

// ---- every edge delivered and decoded

template <class Decoder>
void count_edges(benchmark::State& state, Stage& stage, std::int64_t before, const std::array<Decoder, 4>& decoders) {
    const std::int64_t edges = stage.pulses() - before;
    state.counters["edges/s"] = Counter(static_cast<double>(edges), Counter::kIsRate);
    state.counters["each"] = Counter(static_cast<double>(edges), Counter::kIsRate | Counter::kInvert);
    for (int a = 0; a < 4; ++a)
        if (decoders[static_cast<std::size_t>(a)].illegal() != 0 ||
            decoders[static_cast<std::size_t>(a)].count() != stage.host.count(a))
            state.SkipWithError("an edge was lost");
}

/// Four axes cruise; the host polls every 10 ms.
template <class Decoder>
void edges(benchmark::State& state, const Speeds& speeds) {
    Stage stage(true);
    std::array<Decoder, 4> decoders;
    for (int a = 0; a < 4; ++a) stage.listen(a, decoders[static_cast<std::size_t>(a)]);
    set_speeds(stage.host, speeds);
    stage.host.command(all_axes, 0x22);
    stage.host.advance(milliseconds(1));
    const double begin = stage.seconds();
    const std::int64_t before = stage.pulses();
    for (auto _ : state) stage.host.advance(milliseconds(10));
    state.counters["sim_s/s"] = Counter(stage.seconds() - begin, Counter::kIsRate);
    count_edges(state, stage, before, decoders);
}
constexpr Speeds at_20_kpps{640'000, 1'600, 1'600, 400, 100}, at_100_kpps{640'000, 8'000, 8'000, 400, 100},
    at_4_mpps{16'000, 8'000, 8'000, 400, 100}, at_3_997_mpps{16'000, 7'993, 7'993, 400, 100};
void edges_in_batches(benchmark::State& state, const Speeds& speeds) {
    edges<sim::BatchDecoder>(state, speeds);
}
void edges_one_by_one(benchmark::State& state, const Speeds& speeds) {
    edges<OneByOne>(state, speeds);
}
BENCHMARK_CAPTURE(edges_in_batches, 20_kpps, at_20_kpps);
BENCHMARK_CAPTURE(edges_in_batches, 100_kpps, at_100_kpps);
BENCHMARK_CAPTURE(edges_in_batches, 4_Mpps, at_4_mpps);
BENCHMARK_CAPTURE(edges_in_batches, 3_997_Mpps, at_3_997_mpps);
BENCHMARK_CAPTURE(edges_one_by_one, 20_kpps, at_20_kpps);
BENCHMARK_CAPTURE(edges_one_by_one, 100_kpps, at_100_kpps);
BENCHMARK_CAPTURE(edges_one_by_one, 4_Mpps, at_4_mpps);

/// Runs only a decoder, on prepared edges.
template <class Decoder>
void decode_only(benchmark::State& state) {
    Decoder decoder;
    sim::EdgeBatch batch;
    batch.size = sim::EdgeBatch::capacity;
    batch.first_count = 1;
    for (std::uint32_t i = 0; i < batch.size; ++i) batch.at[i] = 2 * i;
    for (auto _ : state) {
        decoder.edges(batch);
        benchmark::DoNotOptimize(decoder);
        batch.first_count += batch.size;
    }
    const double edges = static_cast<double>(state.iterations()) * batch.size;
    state.counters["edges/s"] = Counter(edges, Counter::kIsRate);
    state.counters["each"] = Counter(edges, Counter::kIsRate | Counter::kInvert);
}
BENCHMARK_TEMPLATE(decode_only, sim::BatchDecoder);
BENCHMARK_TEMPLATE(decode_only, OneByOne);

/// Executes interpolations in sequence, at 4 Mpps, and decodes every edge.
template <class Start>
void path_edges(benchmark::State& state, const Start& start) {
    Stage stage(true);
    std::array<sim::BatchDecoder, 4> decoders;
    for (int a = 0; a < 4; ++a) stage.listen(a, decoders[static_cast<std::size_t>(a)]);
    set_speeds(stage.host, {});
    stage.host.advance(milliseconds(1));
    const double begin = stage.seconds();
    const std::int64_t before = stage.pulses();
    int turn = 0;
    for (auto _ : state) {
        start(stage.host, turn++ % 2 == 0 ? 1 : -1);
        stage.finish();
    }
    state.counters["sim_s/s"] = Counter(stage.seconds() - begin, Counter::kIsRate);
    count_edges(state, stage, before, decoders);
}
void line(mcx314::outside::Bench& host, std::int64_t sign) {
    host.write(5, 0x04);  // AX1 X, AX2 Y
    host.data(1, 0x06, sign * 4'000'000);
    host.data(2, 0x06, sign * 2'471'000);
    host.command(0, 0x30);
}
void arc(mcx314::outside::Bench& host, std::int64_t) {
    host.write(5, 0x04);
    host.data(1, 0x08, -1'000'000);
    host.data(2, 0x08, 0);
    host.data(3, 0x06, 0);
    host.command(0, 0x33);
}
void arc_at_constant_vector_speed(mcx314::outside::Bench& host, std::int64_t) {
    host.data(2, 0x00, 22'627);
    host.write(5, 0x0104);
    host.data(1, 0x08, -1'000'000);
    host.data(2, 0x08, 0);
    host.data(3, 0x06, 0);
    host.command(0, 0x33);
}
BENCHMARK_CAPTURE(path_edges, line, line);
BENCHMARK_CAPTURE(path_edges, arc, arc);
BENCHMARK_CAPTURE(path_edges, arc_at_constant_vector_speed, arc_at_constant_vector_speed);

// ---- rewinding

void snapshot(benchmark::State& state) {
    Stage stage(true);
    set_speeds(stage.host, {});
    stage.host.command(all_axes, 0x22);
    stage.host.advance(milliseconds(1));
    std::size_t bytes = 0;
    for (auto _ : state) {
        const sim::Snapshot taken = stage.host.kernel.snapshot();
        benchmark::DoNotOptimize(taken.bytes.data());
        bytes = taken.bytes.size();
    }
    state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(snapshot);

void restore(benchmark::State& state) {
    Stage stage(true);
    set_speeds(stage.host, {});
    stage.host.command(all_axes, 0x22);
    stage.host.advance(milliseconds(1));
    const sim::Snapshot taken = stage.host.kernel.snapshot();
    for (auto _ : state) stage.host.kernel.restore(taken);
}
BENCHMARK(restore);

}  // namespace
}  // namespace motionrack::bench

BENCHMARK_MAIN();
