// Wide decoder of sampled encoder lines, compared with loops over tables of 16 transitions and of 65,536 entries.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <motionrack/decode/channel.hpp>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace motionrack::decode;
using Clock = std::chrono::steady_clock;

/// Returns samples of four encoders that turn back and forth, one count every few samples.
std::vector<std::uint8_t> make_stream(std::size_t size) {
    std::mt19937 random(4);
    std::vector<std::uint8_t> out(size);
    std::array<unsigned, 4> phase{}, sense{1, 1, 3, 1};
    for (std::uint8_t& byte : out) {
        byte = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto luck = random() % 4096;
            if (luck < 1024) phase[i] += sense[i];
            if (luck == 4095) sense[i] ^= 2U;
            byte = static_cast<std::uint8_t>(byte | ((phase[i] ^ (phase[i] & 3U) >> 1) & 3U) << (2 * i));
        }
    }
    return out;
}

/// Returns the samples of a size; they are created once, because a benchmark is called repeatedly until its time is
/// known.
const std::vector<std::uint8_t>& stream_of(std::size_t size) {
    static std::map<std::size_t, std::vector<std::uint8_t>> streams;
    const auto [at, added] = streams.try_emplace(size);
    if (added) at->second = make_stream(size);
    return at->second;
}

/// Baseline: one axis, one sample per byte, through a table of 16 transitions.
std::int64_t by_table_of_16(const std::vector<std::uint8_t>& stream) {
    static constexpr std::array<std::int8_t, 16> table = {0, 1, -1, 0, -1, 0, 0, 1, 1, 0, 0, -1, 0, -1, 1, 0};
    std::int64_t count = 0;
    unsigned before = stream[0] & 3U;
    for (const std::uint8_t byte : stream) {
        const unsigned now = byte & 3U;
        count += table[before << 2 | now];
        before = now;
    }
    return count;
}

/// Baseline for four axes: the previous and the current byte select four counts, each plus 1, in the bytes of a number.
class TableOf64K {
  public:
    TableOf64K() : table_(1 << 16) {
        static constexpr std::array<unsigned, 16> steps = {1, 2, 0, 1, 0, 1, 1, 2, 2, 1, 1, 0, 1, 0, 2, 1};
        for (std::size_t i = 0; i < table_.size(); ++i)
            for (std::size_t axis = 0; axis < 4; ++axis)
                table_[i] |= std::uint32_t{steps[(i >> 8 >> 2 * axis & 3U) << 2 | (i >> 2 * axis & 3U)]} << 8 * axis;
    }
    std::array<std::int64_t, 4> counts(const std::vector<std::uint8_t>& stream) const {
        std::array<std::int64_t, 4> out{};
        std::size_t before = stream[0];
        for (std::size_t at = 0; at < stream.size();) {
            const std::size_t size = std::min<std::size_t>(stream.size() - at, 127);
            std::uint32_t sums = 0;
            for (const std::size_t end = at + size; at < end; ++at) {
                sums += table_[before << 8 | stream[at]];
                before = stream[at];
            }
            for (std::size_t axis = 0; axis < 4; ++axis)
                out[axis] += static_cast<std::int64_t>(sums >> 8 * axis & 0xFFU) - static_cast<std::int64_t>(size);
        }
        return out;
    }

  private:
    std::vector<std::uint32_t> table_;
};

/// Returns the seconds that `work` takes: the minimum of many tries, so that other load does not slow the baseline.
template <class Work>
double seconds_of(const Work& work) {
    double best = 1e9;
    double all = 0;
    for (int i = 0; i < 3 || all < 0.05; ++i) {
        const auto begin = Clock::now();
        benchmark::DoNotOptimize(work());
        const double took = std::chrono::duration<double>(Clock::now() - begin).count();
        best = std::min(best, took), all += took;
    }
    return best;
}

/// Runs `work` and reports its rate, and the ratio to the baseline.
template <class Work, class Baseline>
void compare(benchmark::State& state, std::size_t samples, const Work& work, const Baseline& baseline, bool alike) {
    if (!alike) state.SkipWithError("the decoder and its baseline do not agree");
    const double base = seconds_of(baseline);
    for (auto _ : state) benchmark::DoNotOptimize(work());
    const auto all = static_cast<double>(samples) * static_cast<double>(state.iterations());
    state.counters["samples/s"] = benchmark::Counter(all, benchmark::Counter::kIsRate);
    state.counters["baseline/s"] = static_cast<double>(samples) / base;
    state.counters["ratio"] =
        benchmark::Counter(all * base / static_cast<double>(samples), benchmark::Counter::kIsRate);
}

void one_axis_bytes(benchmark::State& state, const Kernels& kernels) {
    const auto& stream = stream_of(static_cast<std::size_t>(state.range(0)));
    const auto work = [&] {
        ChannelDecoder decoder({}, kernels);
        decoder.bytes(stream.data(), stream.size(), {0, 1, -1});
        return decoder.count();
    };
    const auto baseline = [&] { return by_table_of_16(stream); };
    compare(state, stream.size(), work, baseline, work() == baseline());
}

void one_axis_with_index(benchmark::State& state, const Kernels& kernels) {
    auto stream = stream_of(static_cast<std::size_t>(state.range(0)));
    for (std::size_t i = 0; i < stream.size(); ++i)
        stream[i] = static_cast<std::uint8_t>((stream[i] & 3U) | (i % 40'000 < 8 ? 4U : 0U));
    const auto work = [&] {
        ChannelDecoder decoder({}, kernels);
        decoder.bytes(stream.data(), stream.size(), {0, 1, 2});
        return decoder.count();
    };
    const auto baseline = [&] { return by_table_of_16(stream); };
    compare(state, stream.size(), work, baseline, work() == baseline());
}

void four_axes(benchmark::State& state, const Kernels& kernels) {
    const auto& stream = stream_of(static_cast<std::size_t>(state.range(0)));
    const TableOf64K table;
    const auto work = [&] {
        FourChannelDecoder decoder({{{0, 1}, {2, 3}, {4, 5}, {6, 7}}}, kernels);
        decoder.bytes(stream.data(), stream.size());
        return std::array<std::int64_t, 4>{decoder.count(0), decoder.count(1), decoder.count(2), decoder.count(3)};
    };
    const auto baseline = [&] { return table.counts(stream); };
    compare(state, stream.size(), work, baseline, work() == baseline());
}

void bit_planes(benchmark::State& state, const Kernels& kernels) {
    const auto& stream = stream_of(static_cast<std::size_t>(state.range(0)) * 8);
    std::vector<std::uint64_t> a(stream.size() / 64), b(stream.size() / 64);
    kernels.split(stream.data(), a.size(), 0, a.data());
    kernels.split(stream.data(), b.size(), 1, b.data());
    const auto work = [&] {
        ChannelDecoder decoder({}, kernels);
        decoder.planes(a.data(), b.data(), nullptr, stream.size());
        return decoder.count();
    };
    const auto baseline = [&] { return by_table_of_16(stream); };
    compare(state, stream.size(), work, baseline, work() == baseline());
}

/// Measures the time of reading the bytes alone: no decoder can be faster at this size.
void reading_alone(benchmark::State& state, const Kernels& kernels) {
    const std::vector<std::uint8_t> stream(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(kernels.steady(stream.data(), stream.size() / 64, 3, 0));
    state.SetBytesProcessed(state.range(0) * state.iterations());
}

}  // namespace

int main(int argc, char** argv) {
    for (const Kernels& kernels : available_kernels()) {
        const auto add = [&](const char* name, auto* function) {
            return benchmark::RegisterBenchmark(
                (std::string(name) + "/" + kernels.name).c_str(),
                [function, &kernels](benchmark::State& state) { function(state, kernels); });
        };
        // Bytes in L1 cache, L2 cache and memory; for planes, bytes per line.
        add("one_axis_bytes", one_axis_bytes)->Arg(16 << 10)->Arg(256 << 10)->Arg(64 << 20);
        add("reading_alone", reading_alone)->Arg(64 << 20);
        add("one_axis_with_index", one_axis_with_index)->Arg(256 << 10);
        add("four_axes_in_a_byte", four_axes)->Arg(16 << 10)->Arg(256 << 10)->Arg(64 << 20);
        add("bit_planes", bit_planes)->Arg(8 << 10)->Arg(128 << 10)->Arg(8 << 20);
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
