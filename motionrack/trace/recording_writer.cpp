// Writes a recording: one buffer per column, written to the file when full or on flush.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/trace/recording.hpp>
#include <motionrack/trace/recording_parts.hpp>
#include <motionrack/trace/report_json.hpp>

namespace motionrack::trace {

namespace {

constexpr double tick_s = 1e-10;
// Data lost when the program is killed: the last tenth of the recorded time, or this number of events.
constexpr std::uint64_t max_unflushed = 1'000'000;
constexpr Duration min_flush_period = whole_seconds(1);
// A chunk flushed before it is full is rewritten elsewhere; smaller chunks waste less space.
constexpr std::size_t edge_chunk = 1 << 12, level_chunk = 1 << 9, sample_chunk = 1 << 10;
constexpr std::size_t edge_buffer = 1 << 12, level_buffer = 1 << 7, sample_buffer = 1 << 9;

/// Elements waiting to be written.
template <class T>
class Buffered {
  public:
    Buffered() = default;
    Buffered(hdf5::Hdf5File& file, const std::string& path, std::size_t chunk, std::size_t max_waiting,
             const std::string& unit, double scale = 1)
        : writer_(file.make_column(path, {hdf5::type_of<T>, 0, chunk, unit, scale})), max_waiting_(max_waiting) {}

    bool add(T value) {
        waiting_.push_back(value);
        return waiting_.size() < max_waiting_ || write();
    }
    bool write() {
        const bool good = writer_.append(waiting_.data(), waiting_.size());
        waiting_.clear();
        return good;
    }

  private:
    hdf5::Writer writer_;
    std::vector<T> waiting_;
    std::size_t max_waiting_ = 1;
};

}  // namespace

struct RecordingWriter::Signal {
    SignalKind kind = SignalKind::levels;
    std::int64_t last = 0;
    Buffered<std::int64_t> times;
    Buffered<std::int8_t> directions;  // of steps
    Buffered<std::int64_t> values;     // of other signals

    bool write() { return times.write() && (kind == SignalKind::steps ? directions.write() : values.write()); }
};

struct RecordingWriter::Samples {
    struct Axis {
        bool servo = false;
        Buffered<double> position, commanded, velocity;
        Buffered<float> accel, volts;
    };
    Buffered<std::int64_t> times;
    Buffered<double> deviation;
    std::vector<Axis> axes;

    bool write() {
        bool good = times.write() && deviation.write();
        for (Axis& axis : axes)
            good = good && axis.position.write() && axis.commanded.write() && axis.velocity.write() &&
                   axis.accel.write() && (!axis.servo || axis.volts.write());
        return good;
    }
};

RecordingWriter::RecordingWriter() = default;
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter& RecordingWriter::operator=(RecordingWriter&&) noexcept = default;
RecordingWriter::~RecordingWriter() = default;

Result<RecordingWriter> RecordingWriter::create(const std::string& path, const RecordingHead& head, Instant began) {
    RecordingWriter out;
    out.began_ = began;
    out.next_flush_ = began + min_flush_period;
    MOTIONRACK_TRY(out.file_, hdf5::Hdf5File::create(path));
    hdf5::Hdf5File& file = out.file_;
    file.set("/", "format", "motionrack recording");
    file.set("/", "format_version", recording_format);
    file.set("/", "written_by", "motionrack " + head.version);
    file.set("/", "program", head.program_name);
    file.set("/", "rack", head.rack_name);
    file.set("/", "tick_s", tick_s);
    file.set("/", "began_ticks", began.count());
    file.write_text("run/program", head.program);
    file.write_text("run/rack", head.rack);
    file.write_text("run/head", head_json(head));
    std::size_t max_length = 64;
    for (const RecordedInput& input : head.inputs) max_length = std::max(max_length, input.text.size());
    out.input_times_ = file.make_column("inputs/time", {hdf5::Type::int64, 0, 256, "s", tick_s});
    out.input_texts_ = file.make_column("inputs/text", {hdf5::Type::text, max_length, 64, "", 1});
    out.flushed_ = file.make_column("run/flushed", {hdf5::Type::int64, 0, 64, "s", tick_s});
    out.write_axes(head);
    out.make_signals(head);
    out.make_samples(head);
    file.begin_streaming();
    for (const RecordedInput& input : head.inputs) out.input(input);
    out.flush(began);
    if (file.trouble().empty()) return out;
    return tl::unexpected<Error>(Error{
        ErrorKind::io,
        fmt::format("The recording {}. Choose another place or make room; nothing was moved.", file.trouble()), path});
}

void RecordingWriter::write_axes(const RecordingHead& head) {
    for (const RecordedAxis& axis : head.axes) {
        const std::string group = "axes/" + axis_folder(axis.name);
        file_.make_group(group);
        file_.set(group, "unit", axis.unit);
        each_number_of_axis(axis, [&](const char* name, double value) { file_.set(group, name, value); });
    }
}

void RecordingWriter::make_signals(const RecordingHead& head) {
    signals_.reserve(head.signals.size());
    for (const RecordedSignal& signal : head.signals) {
        const bool edges = signal.kind != SignalKind::levels;
        const std::size_t chunk = edges ? edge_chunk : level_chunk, max_waiting = edges ? edge_buffer : level_buffer;
        Signal one;
        one.kind = signal.kind;
        one.last = signal.initial;
        one.times = {file_, signal.path + "/time", chunk, max_waiting, "s", tick_s};
        const std::string column = signal.path + "/" + value_column(signal.kind);
        if (signal.kind == SignalKind::steps)
            one.directions = {file_, column, chunk, max_waiting, signal.unit};
        else
            one.values = {file_, column, chunk, max_waiting, signal.unit, signal.scale};
        file_.set(signal.path, "initial", signal.initial);
        signals_.push_back(std::move(one));
    }
}

void RecordingWriter::make_samples(const RecordingHead& head) {
    samples_ = std::make_unique<Samples>();
    const auto column = [&](auto& buffered, const std::string& path, const std::string& unit, double scale = 1) {
        buffered = {file_, "samples/" + path, sample_chunk, sample_buffer, unit, scale};
    };
    column(samples_->times, "time", "s", tick_s);
    column(samples_->deviation, "deviation", "mm");
    for (const RecordedAxis& axis : head.axes) {
        const std::string name = axis_folder(axis.name);
        Samples::Axis one;
        one.servo = axis.servo;
        column(one.position, name + "/position", axis.unit);
        column(one.commanded, name + "/commanded", axis.unit);
        column(one.velocity, name + "/velocity", axis.unit + "/s");
        column(one.accel, name + "/acceleration", axis.unit + "/s2");
        if (axis.servo) column(one.volts, name + "/drive", "V");
        samples_->axes.push_back(std::move(one));
    }
}

void RecordingWriter::event(std::size_t signal, Instant at, std::int64_t value) {
    if (!is_open()) return;
    Signal& one = signals_[signal];
    if (one.kind == SignalKind::levels && one.last == value) return;
    one.last = value;
    ++events_;
    const bool times = one.times.add(at.count());
    const bool values =
        one.kind == SignalKind::steps ? one.directions.add(static_cast<std::int8_t>(value)) : one.values.add(value);
    good_ = good_ && times && values;
}

void RecordingWriter::sample(Instant at, double deviation_mm, std::span<const AxisSample> axes) {
    if (!is_open()) return;
    MOTIONRACK_ASSERT(axes.size() == samples_->axes.size());
    const auto note = [this](bool added) { good_ = good_ && added; };
    note(samples_->times.add(at.count()));
    note(samples_->deviation.add(deviation_mm));
    for (std::size_t i = 0; i < axes.size(); ++i) {
        Samples::Axis& axis = samples_->axes[i];
        note(axis.position.add(axes[i].position));
        note(axis.commanded.add(axes[i].commanded));
        note(axis.velocity.add(axes[i].velocity));
        note(axis.accel.add(axes[i].accel));
        if (axis.servo) note(axis.volts.add(axes[i].volts));
    }
}

void RecordingWriter::input(const RecordedInput& input) {
    if (!is_open()) return;
    const std::int64_t at = input.at.count();
    std::string text = input.text;
    text.resize(std::max<std::size_t>(text.size(), input_texts_.text_bytes()));
    good_ = input_times_.append(&at, 1) && input_texts_.append(text.data(), 1) && good_;
}

void RecordingWriter::flush(Instant now) {
    if (!is_open()) return;
    for (Signal& signal : signals_) good_ = signal.write() && good_;
    good_ = samples_->write() && good_;
    file_.flush();
    const std::int64_t at = now.count();
    good_ = flushed_.append(&at, 1) && good_;
    file_.flush();
}

void RecordingWriter::settle(Instant now) {
    if (now < next_flush_ && events_ - flushed_events_ < max_unflushed) return;
    flush(now);
    flushed_events_ = events_;
    next_flush_ = now + std::max(min_flush_period, (now - began_) / 10);
}

Result<void> RecordingWriter::close(const RecordingEnd& end) {
    if (!is_open()) return ended_;
    flush(end.at);
    signals_.clear();
    samples_.reset();
    ended_ = complete(end);
    return ended_;
}

Result<void> RecordingWriter::complete(const RecordingEnd& end) {
    for (hdf5::Writer* writer : {&input_times_, &input_texts_, &flushed_}) *writer = hdf5::Writer();
    if (!good_) file_.set_trouble("could not be written, perhaps because the disk is full");
    MOTIONRACK_CHECK(file_.reopen());
    file_.make_group("outcome");
    for (const OutcomeField& fact : end.outcome) file_.set("outcome", fact.name.c_str(), fact.text);
    file_.write_text("run/report", report_json(end.report));
    file_.set("/", "max_samples", static_cast<std::int64_t>(end.max_samples));
    file_.set("/", "ended_ticks", end.at.count());  // last: its presence marks a complete file
    return file_.close();
}

}  // namespace motionrack::trace
