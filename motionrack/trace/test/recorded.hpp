// Recordings made of plain lists, and a reference reader based on the lists alone.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <motionrack/trace/recording.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::trace {

struct PlainEvent {
    std::size_t signal = 0;
    std::int64_t at = 0, value = 0;
};

struct PlainSample {
    std::int64_t at = 0;
    double deviation = 0;
    std::vector<AxisSample> axes;
};

/// A recording as lists: X with steps and an encoder, Y a servo with an encoder, a switch and a counter.
struct PlainRecording {
    RecordingHead head;
    std::vector<PlainEvent> events;  ///< in time order
    std::vector<PlainSample> samples;
    RecordingEnd end;

    PlainRecording() {
        head.version = "0.0.0";
        head.program_name = "part.ngc";
        head.program = "G21 G90\nG1 X1 F600\nM2\n";
        head.rack_name = "bench";
        head.rack_file = "bench.toml";
        head.rack = "[rack]\nname = \"bench\"\n";
        head.sample_period = milliseconds(1);
        head.axes = {{"X", "mm", false, 640, 800, 10, 0, 300, 50, 1000},
                     {"Y", "mm", true, 1000, 1000, 0, -5, 5, 20, 500}};
        head.signals = {{"X.steps", "axes/x/steps", SignalKind::steps, "step", 0},
                        {"X.encoder", "axes/x/encoder", SignalKind::counts, "count", 0},
                        {"Y.encoder", "axes/y/encoder", SignalKind::counts, "count", -3},
                        {"X.limit_plus", "wires/X/limit_plus", SignalKind::levels, "", 1},
                        {"motion.lp_x", "cards/motion/lp_x", SignalKind::levels, "step", 6400}};
        end.at = whole_seconds(100);
        end.outcome = {{"ended", "yes"}, {"trace_hash", "0123456789abcdef"}};
        end.report.axes.resize(2);
        end.report.verdict = {true, "As programmed."};
    }

    void write(RecordingWriter& writer) const {
        std::size_t sample = 0;
        for (const PlainEvent& event : events) {
            for (; sample < samples.size() && samples[sample].at <= event.at; ++sample) put(writer, samples[sample]);
            writer.event(event.signal, Instant{event.at}, event.value);
        }
        for (; sample < samples.size(); ++sample) put(writer, samples[sample]);
    }
    Result<void> write(const std::string& path) const {
        MOTIONRACK_TRY(RecordingWriter writer, RecordingWriter::create(path, head, Instant{0}));
        write(writer);
        return writer.close(end);
    }

    /// Returns the expected events of a signal; of a level signal only its changes.
    std::vector<std::pair<std::int64_t, std::int64_t>> expected(std::size_t signal) const {
        std::vector<std::pair<std::int64_t, std::int64_t>> out;
        std::int64_t last = head.signals[signal].initial;
        for (const PlainEvent& event : events) {
            if (event.signal != signal) continue;
            if (head.signals[signal].kind == SignalKind::levels && event.value == last) continue;
            last = event.value;
            out.emplace_back(event.at, event.value);
        }
        return out;
    }

  private:
    static void put(RecordingWriter& writer, const PlainSample& sample) {
        writer.sample(Instant{sample.at}, sample.deviation, sample.axes);
    }
};

inline std::vector<std::pair<std::int64_t, std::int64_t>> events_of(const RecordingReader& reader,
                                                                    const std::string& name) {
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    const RecordedSeries* series = reader.find(name);
    if (series == nullptr) return out;
    const auto columns = reader.columns(*series);
    if (!columns) return out;
    std::vector<std::int64_t> times(columns->size), values(columns->size);
    EXPECT_TRUE(columns->time.read(0, columns->size, times.data()));
    EXPECT_TRUE(columns->value.read(0, columns->size, values.data()));
    for (std::size_t i = 0; i < times.size(); ++i) out.emplace_back(times[i], values[i]);
    return out;
}

/// Returns a recording of `events` events of all signals, about `apart` ticks from one to the next, with a sample every
/// ten events.
inline PlainRecording busy(std::size_t events, std::int64_t apart = 1250) {
    PlainRecording out;
    std::int64_t count[5] = {0, 0, -3, 1, 6400};
    for (std::size_t i = 0; i < events; ++i) {
        const std::size_t signal = i % 7 < 5 ? i % 7 : 0;
        const std::int64_t at = static_cast<std::int64_t>(i) * apart + static_cast<std::int64_t>(i * i % 97),
                           step = i / 1000 % 2 == 0 ? 1 : -1;
        const std::int64_t value = signal == 0   ? step
                                   : signal == 3 ? static_cast<std::int64_t>(i / 350 % 2)
                                                 : (count[signal] += step);
        out.events.push_back({signal, at, value});
        if (i % 10 == 0)
            out.samples.push_back(
                {at,
                 static_cast<double>(i % 13) * 1e-4,
                 {{10 + 0.001 * static_cast<double>(i), 10, 3.5, 0.25F, 0}, {-0.5, -0.5, 0.1, 2, 7.5F}}});
    }
    out.end.at = Instant{static_cast<std::int64_t>(events + 1) * apart + 1000};
    return out;
}

}  // namespace motionrack::trace
