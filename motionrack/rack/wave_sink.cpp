// Formats of a recording.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/wave_sink.hpp>
#include <motionrack/trace/csv_writer.hpp>
#include <motionrack/trace/recording.hpp>
#include <motionrack/trace/vcd_writer.hpp>

namespace motionrack::rack {

namespace {

class VcdSink final : public WaveSink {
  public:
    /// Opens each scope once, in order of first use.
    VcdSink(trace::VcdWriter writer, const std::vector<WaveSignal>& signals)
        : writer_(std::move(writer)), signals_(signals), ids_(signals.size()) {
        std::vector<std::string> scopes;
        for (const WaveSignal& signal : signals)
            if (std::find(scopes.begin(), scopes.end(), signal.scope) == scopes.end()) scopes.push_back(signal.scope);
        for (const std::string& scope : scopes) {
            writer_.push_scope(scope);
            for (std::size_t i = 0; i < signals.size(); ++i)
                if (signals[i].scope == scope) ids_[i] = declare(signals[i]);
            writer_.pop_scope();
        }
    }

    void change(std::size_t index, std::int64_t value, Instant at) override {
        const WaveSignal& signal = signals_[index];
        if (signal.is_number)
            writer_.change_real(ids_[index], signal.shown(value), at);
        else
            writer_.change(ids_[index], value != 0, at);
    }
    Result<void> close(Instant end) override { return writer_.close(end); }

  private:
    trace::VcdWriter::Id declare(const WaveSignal& signal) {
        return signal.is_number ? writer_.add_real(signal.name, signal.shown(signal.initial))
                                : writer_.add_wire(signal.name, signal.initial != 0);
    }

    trace::VcdWriter writer_;
    std::vector<WaveSignal> signals_;
    std::vector<trace::VcdWriter::Id> ids_;
};

class CsvSink final : public WaveSink {
  public:
    CsvSink(trace::CsvWriter writer, const std::vector<WaveSignal>& signals, Instant start)
        : writer_(std::move(writer)) {
        for (const WaveSignal& signal : signals) {
            columns_.push_back({signal.scope + '.' + signal.name, signal, signal.initial});
            write(columns_.back(), start);
        }
    }

    void change(std::size_t index, std::int64_t value, Instant at) override {
        Column& column = columns_[index];
        if (column.value == value) return;
        column.value = value;
        write(column, at);
    }
    Result<void> close(Instant) override { return writer_.close(); }

  private:
    struct Column {
        std::string name;
        WaveSignal signal;
        std::int64_t value = 0;
    };

    void write(const Column& column, Instant at) {
        // Whole ticks of 100 ps are exact, a double of seconds is not.
        writer_.add(fmt::format("{}.{:010}", at.count() / 10'000'000'000, at.count() % 10'000'000'000));
        writer_.add(column.name);
        if (column.signal.unit == 1)
            writer_.add(column.value);
        else
            writer_.add(fmt::format("{}", column.signal.shown(column.value)));
        writer_.end_line();
    }

    trace::CsvWriter writer_;
    std::vector<Column> columns_;
};

class Hdf5Sink final : public WaveSink {
  public:
    explicit Hdf5Sink(trace::RecordingWriter writer) : writer_(std::move(writer)) {}

    void change(std::size_t index, std::int64_t value, Instant at) override {
        if (ended_) writer_.event(index, at, value);
    }
    Result<void> close(Instant end) override {
        if (!ended_) return ended_;
        trace::RecordingEnd what;
        what.at = end;
        ended_ = writer_.close(what);
        return ended_;
    }
    bool can_end_again() const override { return ended_.has_value(); }

  private:
    trace::RecordingWriter writer_;
    Result<void> ended_;  // an error: the file is closed for good
};

Result<std::unique_ptr<WaveSink>> make_hdf5_sink(const WaveSinkSettings& settings,
                                                 const std::vector<WaveSignal>& signals) {
    trace::RecordingHead head;
    head.version = settings.version;
    head.rack_name = settings.rack_name;
    head.sample_period = milliseconds(1);
    for (const WaveSignal& signal : signals)
        head.signals.push_back({signal.scope + '.' + signal.name, "wires/" + signal.scope + '/' + signal.name,
                                trace::SignalKind::levels, signal.unit == 1 ? "" : "V", signal.initial, signal.unit});
    Result<trace::RecordingWriter> writer = trace::RecordingWriter::create(settings.path, head, settings.start);
    if (!writer) return tl::unexpected<Error>(std::move(writer).error());
    return std::make_unique<Hdf5Sink>(std::move(*writer));
}

}  // namespace

Result<WaveFormat> wave_format(const std::string& path) {
    const auto ends_in = [&](std::string_view ending) {
        return path.size() > ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
    };
    if (ends_in(".vcd")) return WaveFormat::vcd;
    if (ends_in(".csv")) return WaveFormat::csv;
    if (ends_in(".h5")) return WaveFormat::hdf5;
    return fail(ErrorKind::refused, fmt::format("'{}': the ending of the name chooses the format of a recording, .vcd, "
                                                ".csv or .h5. Nothing was recorded.",
                                                path));
}

Result<std::unique_ptr<WaveSink>> make_wave_sink(const WaveSinkSettings& settings,
                                                 const std::vector<WaveSignal>& signals) {
    if (settings.format == WaveFormat::hdf5) return make_hdf5_sink(settings, signals);
    if (settings.format == WaveFormat::csv) {
        MOTIONRACK_TRY(trace::CsvWriter writer, trace::CsvWriter::create(settings.path, {"time_s", "signal", "value"}));
        return std::make_unique<CsvSink>(std::move(writer), signals, settings.start);
    }
    trace::VcdSettings vcd;
    vcd.timescale = settings.vcd_unit;
    vcd.full_names = true;
    MOTIONRACK_TRY(trace::VcdWriter writer, trace::VcdWriter::create(settings.path, vcd));
    return std::make_unique<VcdSink>(std::move(writer), signals);
}

}  // namespace motionrack::rack
