// Ticks of 10 us per second on the virtual RTC5: dense micro-vectors and short marks with fly and table correction,
// long marks without a sink, and the tick-by-tick twin for comparison.
#include <benchmark/benchmark.h>

#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/cards/rtc5/test/twin.hpp>
#include <motionrack/sim/parts/marking_station.hpp>

namespace {

using namespace motionrack;
using namespace motionrack::rtc5;

constexpr std::int64_t list_size = 4000;

/// Sums the samples, so that the compiler does not remove their computation.
class Last final : public Sink {
  public:
    void samples(const Samples& b) override {
        benchmark::DoNotOptimize(sum_ += b.x[0] + b.y[b.y.size() - 1] + b.laser[0]);
    }

  private:
    std::int64_t sum_ = 0;
};

const CorrectionFile& lens_file() {
    static const CorrectionFile file = *correction_of({});
    return file;
}

enum class Work { micro_vectors, short_marks, long_marks };
enum class Correction { none, encoder, rotary };

/// Returns the commands of lists 1 and 2, which are equal; executed in turn, they run indefinitely.
std::vector<Command> list_of(Work work, Correction correction) {
    std::vector<Command> out;
    const auto put = [&](Op op, std::initializer_list<double> p) { out.push_back(*list_command(op, p)); };
    const auto correct = [&] {
        if (correction == Correction::encoder) put(Op::set_fly_x, {0.5184});
        if (correction == Correction::rotary) put(Op::set_fly_rot, {1'000'000});
    };
    correct();
    put(Op::jump_abs, {0, 0});
    put(Op::set_mark_speed, {2592});
    put(Op::set_scanner_delays, {0, 0, 0});
    while (static_cast<std::int64_t>(out.size()) + 1 < (work == Work::long_marks ? 200 : list_size)) {
        if (work == Work::long_marks && out.size() % 6 == 0) correct();
        const double i = static_cast<double>(out.size()), x = static_cast<double>(out.size() % 256);
        if (work == Work::micro_vectors) put(Op::micro_vector_abs, {x * 1500 - 190'000, i * 90 - 190'000, -1, -1});
        if (work == Work::short_marks)
            put(Op::mark_rel, {out.size() % 2 ? 200.0 : -150.0, out.size() % 3 ? 150.0 : -300.0});
        if (work == Work::long_marks)
            put(Op::mark_abs, {out.size() % 2 ? 100'000.0 : -100'000.0, out.size() % 3 ? 100'000.0 : -100'000.0});
    }
    put(Op::set_end_of_list, {});
    return out;
}

void run_card(benchmark::State& state, Work work, Correction correction, bool table, bool looked_at) {
    Engine card({.list_memory = 3 * list_size, .list1 = list_size, .list2 = list_size});
    for (int list = 1; list <= 2; ++list) {
        (void)card.set_start_list(list);
        for (const Command& c : list_of(work, correction)) (void)card.put(c);
    }
    (void)card.parts().encoders.simulate(1);
    if (table) {
        (void)card.parts().heads.load_table(table_of(lens_file()), 1);
        (void)card.parts().heads.select_tables(1, 0);
    }
    card.parts().execution.start_loop();
    (void)card.execute_list(1);
    Last last;
    const std::int64_t ticks = looked_at ? 1'000'000 : 100'000'000;
    for (auto _ : state) card.run_until(card.tick() + ticks, looked_at ? &last : nullptr);
    state.counters["ticks/s"] = benchmark::Counter(static_cast<double>(ticks) * static_cast<double>(state.iterations()),
                                                   benchmark::Counter::kIsRate);
    state.counters["real time"] = benchmark::Counter(
        1e-5 * static_cast<double>(ticks) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void run_twin(benchmark::State& state, Work work, Correction correction) {
    twin::Twin card(3 * list_size, list_size, list_size);
    const std::vector<Command> list = list_of(work, correction);
    for (const std::int64_t at : {std::int64_t{0}, list_size})
        std::copy(list.begin(), list.end(), card.memory.begin() + at);
    card.encoders[0].simulated = card.loop = true;
    card.tables[0] = &lens_file();
    card.execute(0);
    for (auto _ : state)
        for (int i = 0; i < 10'000; ++i) benchmark::DoNotOptimize(card.tick());
    state.counters["ticks/s"] =
        benchmark::Counter(10'000.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// Card, mirrors, lens, laser and workpiece together.
class Station final : public Sink {
  public:
    explicit Station(const parts::StationSettings& settings) : station_(*parts::MarkingStation::make(settings)) {}
    void samples(const Samples& b) override { station_.block(b.first, b.x, b.y); }
    void laser(std::int64_t half_us, bool on) override { station_.laser(half_us, on); }

  private:
    parts::MarkingStation station_;
};

void run_recorded(benchmark::State& state, Work work, bool real_mirrors, bool lens) {
    Engine card({.list_memory = 3 * list_size, .list1 = list_size, .list2 = list_size});
    for (int list = 1; list <= 2; ++list) {
        (void)card.set_start_list(list);
        for (const Command& c : list_of(work, Correction::encoder)) (void)card.put(c);
    }
    (void)card.parts().encoders.simulate(1);
    (void)card.parts().heads.load_table(table_of(lens_file()), 1);
    (void)card.parts().heads.select_tables(lens ? 1 : 0, 0);
    card.parts().execution.start_loop();
    (void)card.execute_list(1);
    parts::StationSettings settings;
    settings.galvo.ideal_mirrors = !real_mirrors;
    if (lens) settings.lens = sim::ScanLens{};
    settings.workpiece.max_points = 100'000;
    Station station(settings);
    for (auto _ : state) card.run_until(card.tick() + 100'000, &station);
    state.counters["ticks/s"] =
        benchmark::Counter(1e5 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

BENCHMARK_CAPTURE(run_card, micro_vectors_plain, Work::micro_vectors, Correction::none, false, true);
BENCHMARK_CAPTURE(run_card, micro_vectors_fly, Work::micro_vectors, Correction::encoder, false, true);
BENCHMARK_CAPTURE(run_card, micro_vectors_table, Work::micro_vectors, Correction::none, true, true);
BENCHMARK_CAPTURE(run_card, micro_vectors_fly_table, Work::micro_vectors, Correction::encoder, true, true);
BENCHMARK_CAPTURE(run_card, short_marks_fly_table, Work::short_marks, Correction::encoder, true, true);
BENCHMARK_CAPTURE(run_card, long_marks_fly_table, Work::long_marks, Correction::encoder, true, true);
BENCHMARK_CAPTURE(run_card, long_marks_rotary_table, Work::long_marks, Correction::rotary, true, true);
BENCHMARK_CAPTURE(run_card, short_marks_unseen, Work::short_marks, Correction::encoder, true, false);
BENCHMARK_CAPTURE(run_card, long_marks_unseen, Work::long_marks, Correction::encoder, true, false);
BENCHMARK_CAPTURE(run_recorded, short_marks_ideal, Work::short_marks, false, false);
BENCHMARK_CAPTURE(run_recorded, short_marks_mirrors, Work::short_marks, true, false);
BENCHMARK_CAPTURE(run_recorded, short_marks_mirrors_lens, Work::short_marks, true, true);
BENCHMARK_CAPTURE(run_twin, micro_vectors_fly_table, Work::micro_vectors, Correction::encoder);
BENCHMARK_CAPTURE(run_twin, long_marks_fly_table, Work::long_marks, Correction::encoder);

}  // namespace

BENCHMARK_MAIN();
