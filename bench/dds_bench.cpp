// Frames over Cyclone DDS between two processes on one computer: rate, and age at arrival. Also the validator alone.
#include <benchmark/benchmark.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <motionrack/dds/clock.hpp>
#include <motionrack/dds/frame_pacer.hpp>
#include <motionrack/dds/publisher.hpp>
#include <motionrack/dds/subscriber.hpp>
#include <string>
#include <vector>

namespace {

using namespace motionrack;
using dds::Frame;

/// Network restricted to this computer.
constexpr const char* loopback =
    "<Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain>";

/// Fills frame `number`, which carries its send time in its first two counts.
void stamp(Frame& frame, std::uint32_t number, Duration period, std::uint32_t scales) {
    frame.sequence = number;
    frame.time = std::int64_t{number} * period.count();
    frame.words = scales;
    const auto now = static_cast<std::uint64_t>(dds::monotonic_now().count());
    frame.counts[0] = static_cast<std::uint32_t>(now);
    frame.counts[1] = static_cast<std::uint32_t>(now >> 32);
    frame.crc = crc_of(frame);
}

Instant stamp_of(const Frame& frame) {
    return Instant{static_cast<std::int64_t>(std::uint64_t{frame.counts[1]} << 32 | frame.counts[0])};
}

/// Runs the other process: publishes every `pace`, or at maximum rate (0), until it is killed.
[[noreturn]] void publish_forever(const std::string& bus, Duration pace, std::uint32_t scales) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    const Duration period = pace == Duration{0} ? microseconds(200) : pace;
    const auto publisher = dds::Publisher::open({bus, 0, period, period});
    if (!publisher) ::_exit(1);
    dds::FramePacer pacer(1, period);
    Frame frame;
    for (std::uint32_t number = 0;; ++number) {
        if (pace != Duration{0})
            for (const Instant due = pacer.due(std::int64_t{number} * period, dds::monotonic_now());
                 dds::monotonic_now() < due;)
                dds::sleep_until(due);
        stamp(frame, number, period, scales);
        (*publisher)->publish(frame);
    }
}

class OtherProcess {
  public:
    OtherProcess(const std::string& bus, Duration pace, std::uint32_t scales) : process_(::fork()) {
        if (process_ == 0) publish_forever(bus, pace, scales);
    }
    ~OtherProcess() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    OtherProcess(const OtherProcess&) = delete;
    OtherProcess& operator=(const OtherProcess&) = delete;

  private:
    pid_t process_;
};

double percentile(const std::vector<double>& sorted, double part) {
    return sorted.empty() ? 0
                          : sorted[std::min(sorted.size() - 1,
                                            static_cast<std::size_t>(part * static_cast<double>(sorted.size())))];
}

/// Receives valid frames and appends their ages in us until `ages` has `frames` of them. Returns false if none arrives
/// for 10 s.
bool hear(dds::Subscriber& subscriber, std::size_t frames, std::vector<double>& ages) {
    while (ages.size() < frames) {
        if (!subscriber.wait(whole_seconds(10))) return false;
        subscriber.poll([&](const dds::Sample& sample, dds::Validation verdict, Instant received) {
            if (verdict == dds::Validation::used && ages.size() < frames)
                ages.push_back(to_seconds(received - stamp_of(sample.frame)) * 1e6);
        });
    }
    return true;
}

/// Receives frames of the other process. Arguments: period in us (0: maximum rate), number of scales.
void network(benchmark::State& state) {
    ::setenv("CYCLONEDDS_URI", loopback, 0);
    const std::string bus = "bench-" + std::to_string(::getpid());
    const OtherProcess other(bus, microseconds(state.range(0)), static_cast<std::uint32_t>(state.range(1)));
    dds::SubscriberSettings settings;
    settings.bus = bus;
    settings.queue = 8192;
    const auto subscriber = dds::Subscriber::open(settings);
    if (!subscriber) return state.SkipWithError(subscriber.error().text().c_str());
    std::vector<double> ages;
    ages.reserve(10'000'000);
    if (!hear(**subscriber, 1000, ages)) return state.SkipWithError("no frame came over the loopback");
    ages.clear();
    const std::uint64_t lost = (*subscriber)->judge().counts().lost, dropped = (*subscriber)->overruns();
    std::size_t wanted = 0;
    for (auto _ : state)
        if (!hear(**subscriber, wanted += 5000, ages)) return state.SkipWithError("the frames ceased");
    state.SetItemsProcessed(static_cast<std::int64_t>(ages.size()));
    state.counters["lost"] = static_cast<double>((*subscriber)->judge().counts().lost - lost);
    state.counters["dropped"] = static_cast<double>((*subscriber)->overruns() - dropped);
    std::sort(ages.begin(), ages.end());
    state.counters["p50_us"] = percentile(ages, 0.5);
    state.counters["p99_us"] = percentile(ages, 0.99);
    state.counters["p999_us"] = percentile(ages, 0.999);
    state.counters["max_us"] = ages.empty() ? 0 : ages.back();
}
BENCHMARK(network)
    ->ArgNames({"period_us", "scales"})
    ->Args({200, 8})
    ->Args({200, 128})
    ->UseRealTime()
    ->MinTime(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(network)
    ->ArgNames({"period_us", "scales"})
    ->Args({0, 8})
    ->Args({0, 128})
    ->UseRealTime()
    ->MinTime(3)
    ->Unit(benchmark::kMillisecond);

/// Validates frames, including their CRC.
void judging(benchmark::State& state) {
    dds::FrameValidator judge;
    dds::Sample sample;
    sample.source = dds::new_source();
    sample.period = sample.pace = microseconds(200).count();
    std::vector<dds::Sample> samples;
    for (std::uint32_t i = 0; i < 1024; ++i) {
        stamp(sample.frame, i, microseconds(200), static_cast<std::uint32_t>(state.range(0)));
        sample.check = check_of(sample);
        samples.push_back(sample);
    }
    Instant now{};
    std::size_t i = 0;
    for (auto _ : state) {
        if (i == samples.size()) {
            i = 0;
            judge = dds::FrameValidator{};
        }
        benchmark::DoNotOptimize(judge.take(samples[i++], now += microseconds(200)));
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(judging)->ArgName("scales")->Arg(8)->Arg(128);

}  // namespace

BENCHMARK_MAIN();
