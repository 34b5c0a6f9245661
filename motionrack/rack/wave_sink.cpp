// Sinks that write VCD, CSV and HDF5 files.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/wave_sink.hpp>
#include <motionrack/trace/csv_writer.hpp>
#include <motionrack/trace/recording.hpp>
#include <motionrack/trace/vcd_writer.hpp>

namespace motionrack::rack {

namespace {

class VcdSink final : public ChangeSink {
  public:
    /// Opens each scope once, in order of first use.
    VcdSink(trace::VcdWriter writer, const std::vector<Channel>& channels)
        : writer_(std::move(writer)), channels_(channels), ids_(channels.size()) {
        std::vector<std::string> scopes;
        for (const Channel& channel : channels)
            if (std::find(scopes.begin(), scopes.end(), channel.scope()) == scopes.end())
                scopes.push_back(channel.scope());
        for (const std::string& scope : scopes) {
            writer_.push_scope(scope);
            for (std::size_t i = 0; i < channels.size(); ++i)
                if (channels[i].scope() == scope) ids_[i] = declare(channels[i]);
            writer_.pop_scope();
        }
    }

    void change(std::size_t index, std::int64_t value, Instant at) override {
        const Channel& channel = channels_[index];
        if (channel.is_level())
            writer_.change(ids_[index], value != 0, at);
        else
            writer_.change_real(ids_[index], channel.shown(value), at);
    }
    Result<void> close(Instant end) override { return writer_.close(end); }
    bool can_end_again() const override { return !writer_.gave_up(); }

  private:
    trace::VcdWriter::Id declare(const Channel& channel) {
        return channel.is_level() ? writer_.add_wire(channel.short_name(), channel.initial != 0)
                                  : writer_.add_real(channel.short_name(), channel.shown(channel.initial));
    }

    trace::VcdWriter writer_;
    std::vector<Channel> channels_;
    std::vector<trace::VcdWriter::Id> ids_;
};

class CsvSink final : public ChangeSink {
  public:
    CsvSink(trace::CsvWriter writer, const Declaration& declared) : writer_(std::move(writer)) {
        for (const Channel& channel : declared.channels) {
            columns_.push_back({channel.scope() + '.' + channel.short_name(), channel, channel.initial});
            write(columns_.back(), declared.start);
        }
    }

    void change(std::size_t index, std::int64_t value, Instant at) override {
        Column& column = columns_[index];
        if (column.value == value) return;
        column.value = value;
        write(column, at);
    }
    Result<void> close(Instant) override { return writer_.close(); }
    bool can_end_again() const override { return !writer_.gave_up(); }

  private:
    struct Column {
        std::string name;
        Channel channel;
        std::int64_t value = 0;
    };

    void write(const Column& column, Instant at) {
        // Whole ticks of 100 ps are exact, a double of seconds is not.
        writer_.add(fmt::format("{}.{:010}", at.count() / 10'000'000'000, at.count() % 10'000'000'000));
        writer_.add(column.name);
        if (column.channel.is_exact())
            writer_.add(column.value);
        else
            writer_.add(fmt::format("{}", column.channel.shown(column.value)));
        writer_.end_line();
    }

    trace::CsvWriter writer_;
    std::vector<Column> columns_;
};

class Hdf5Sink final : public ChangeSink {
  public:
    explicit Hdf5Sink(trace::RecordingWriter writer) : writer_(std::move(writer)) {}

    void change(std::size_t index, std::int64_t value, Instant at) override { writer_.event(index, at, value); }
    void settle(Instant at) override { writer_.settle(at); }
    Result<void> close(Instant end) override {
        trace::RecordingEnd what;
        what.at = end;
        return writer_.close(what);
    }
    bool can_end_again() const override { return writer_.is_open(); }

  private:
    trace::RecordingWriter writer_;
};

Result<std::shared_ptr<ChangeSink>> make_hdf5_sink(const WaveFile& file, const Declaration& declared) {
    trace::RecordingHead head;
    head.version = file.version;
    head.rack_name = declared.rack_name;
    head.sample_period = milliseconds(1);
    for (const Channel& channel : declared.channels)
        head.signals.push_back({channel.scope() + '.' + channel.short_name(),
                                "wires/" + channel.scope() + '/' + channel.short_name(), trace::SignalKind::levels,
                                channel.kind == ChannelKind::number ? std::string(channel.unit) : "", channel.initial,
                                channel.scale});
    MOTIONRACK_TRY(trace::RecordingWriter writer, trace::RecordingWriter::create(file.path, head, declared.start));
    return std::make_shared<Hdf5Sink>(std::move(writer));
}

Result<std::shared_ptr<ChangeSink>> make_wave_sink(const WaveFile& file, const Declaration& declared) {
    if (file.format == WaveFormat::hdf5) return make_hdf5_sink(file, declared);
    if (file.format == WaveFormat::csv) {
        MOTIONRACK_TRY(trace::CsvWriter writer, trace::CsvWriter::create(file.path, {"time_s", "signal", "value"}));
        return std::make_shared<CsvSink>(std::move(writer), declared);
    }
    trace::VcdSettings vcd;
    vcd.timescale = file.unit > Duration{0} ? file.unit : declared.edge_unit;
    vcd.full_names = true;
    MOTIONRACK_TRY(trace::VcdWriter writer, trace::VcdWriter::create(file.path, vcd));
    return std::make_shared<VcdSink>(std::move(writer), declared.channels);
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

SinkMaker wave_sink(WaveFile file) {
    return [file = std::move(file)](const Declaration& declared) { return make_wave_sink(file, declared); };
}

}  // namespace motionrack::rack
