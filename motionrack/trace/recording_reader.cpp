// Reads a recording, complete or truncated.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/trace/decimating_buffer.hpp>
#include <motionrack/trace/former_version.hpp>
#include <motionrack/trace/recording.hpp>
#include <motionrack/trace/recording_parts.hpp>
#include <motionrack/trace/report_json.hpp>

namespace motionrack::trace {

namespace {

constexpr std::size_t read_block = 1 << 14;
constexpr std::uint64_t max_inputs = 1'000'000;
/// Fields of the outcome, in display order.
constexpr const char* fact_names[] = {
    "ended",          "message",       "line",       "duration_s",     "path_mm",          "moves",
    "lines",          "chip_segments", "trace_hash", "position_valid", "max_deviation_mm", "pulse_positions",
    "encoder_counts", "actual_ends"};

}  // namespace

Result<RecordingReader> RecordingReader::open(const std::string& path) {
    RecordingReader out;
    MOTIONRACK_TRY(out.file_, hdf5::Hdf5File::open(path));
    const hdf5::Hdf5File& file = out.file_;
    MOTIONRACK_TRY(const std::string format, file.attribute_text("format"));
    if (format != "motionrack recording")
        return fail(ErrorKind::invalid_input, "The file is an HDF5 file, but not a recording of motionrack.", {}, path);
    MOTIONRACK_TRY(const std::int64_t version, file.attribute_number("format_version"));
    if (version != recording_format)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("The recording has format {}, this program reads format {}. It was not read. Take {}.", version,
                        recording_format,
                        version == 1 ? fmt::format("motionrack {}, or the version that wrote it", format_1_version)
                                     : "the version that wrote it, or a later one"),
            {}, path);
    const auto named = [&](Result<void> done) -> Result<void> {
        if (!done && done.error().file.empty()) done.error().file = path;
        return done;
    };
    MOTIONRACK_CHECK(named(out.read_head()));
    MOTIONRACK_CHECK(named(out.read_end()));
    MOTIONRACK_CHECK(named(out.read_inputs()));
    return out;
}

Result<void> RecordingReader::read_head() {
    MOTIONRACK_TRY(const std::string json, file_.text("run/head"));
    MOTIONRACK_TRY(head_, head_from_json(json));
    MOTIONRACK_TRY(head_.program, file_.text("run/program"));
    MOTIONRACK_TRY(head_.rack, file_.text("run/rack"));
    MOTIONRACK_TRY(const std::int64_t began, file_.attribute_number("began_ticks"));
    began_ = Instant{began};
    for (const RecordedSignal& signal : head_.signals)
        series_.push_back(
            {signal.name, signal.unit, true, signal.path + "/time", signal.path + "/" + value_column(signal.kind)});
    const auto sampled = [&](const std::string& name, const std::string& unit, const std::string& path) {
        series_.push_back({name, unit, false, "samples/time", "samples/" + path});
    };
    for (const RecordedAxis& axis : head_.axes) {
        const std::string folder = axis_folder(axis.name);
        sampled(axis.name + ".position", axis.unit, folder + "/position");
        sampled(axis.name + ".commanded", axis.unit, folder + "/commanded");
        sampled(axis.name + ".velocity", axis.unit + "/s", folder + "/velocity");
        sampled(axis.name + ".acceleration", axis.unit + "/s2", folder + "/acceleration");
        if (axis.servo) sampled(axis.name + ".drive", "V", folder + "/drive");
    }
    sampled("deviation", "mm", "deviation");
    return {};
}

Result<void> RecordingReader::read_end() {
    MOTIONRACK_TRY(const std::int64_t ended, file_.attribute_number("ended_ticks"));
    MOTIONRACK_TRY(const bool reported, file_.has("run/report"));
    whole_ = !file_.unfinished() && ended > 0 && reported;
    if (whole_) {
        known_to_ = Instant{ended};
        MOTIONRACK_TRY(const std::int64_t samples, file_.attribute_number("max_samples"));
        max_samples_ = static_cast<std::size_t>(std::clamp<std::int64_t>(samples, 16, 10'000'000));
        MOTIONRACK_TRY(report_, file_.text("run/report"));
        for (const char* name : fact_names) {
            MOTIONRACK_TRY(std::string text, file_.attribute_text(name, "outcome"));
            if (!text.empty()) outcome_.push_back({name, std::move(text)});
        }
        return {};
    }
    MOTIONRACK_TRY(const hdf5::Reader flushed, file_.column("run/flushed"));
    std::int64_t last = began_.count();
    if (flushed.size() > 0) MOTIONRACK_CHECK(flushed.read(flushed.size() - 1, 1, &last));
    known_to_ = Instant{last};
    return {};
}

Result<void> RecordingReader::read_inputs() {
    MOTIONRACK_TRY(const hdf5::Reader times, file_.column("inputs/time"));
    MOTIONRACK_TRY(const hdf5::Reader texts, file_.column("inputs/text"));
    const std::uint64_t size = std::min({times.size(), texts.size(), max_inputs});
    for (std::uint64_t i = 0; i < size; ++i) {
        std::int64_t at = 0;
        MOTIONRACK_CHECK(times.read(i, 1, &at));
        MOTIONRACK_TRY(std::string text, texts.text(i));
        inputs_.push_back({Instant{at}, std::move(text)});
    }
    return {};
}

std::string RecordingReader::cut_sentence() const {
    return fmt::format(
        "{} was cut off, or is still being written: it is complete up to {:.6f} s; the rest and the end of the run are "
        "missing.",
        path(), to_seconds(known_to_ - began_));
}

const RecordedSeries* RecordingReader::find(std::string_view name) const {
    const auto found =
        std::find_if(series_.begin(), series_.end(), [&](const RecordedSeries& one) { return one.name == name; });
    return found == series_.end() ? nullptr : &*found;
}

Result<RecordingReader::Columns> RecordingReader::columns(const RecordedSeries& series) const {
    Columns out;
    MOTIONRACK_TRY(out.time, file_.column(series.time));
    MOTIONRACK_TRY(out.value, file_.column(series.value));
    out.size = std::min(out.time.size(), out.value.size());
    if (whole_ && out.time.size() != out.value.size())
        return fail(ErrorKind::invalid_input,
                    fmt::format("The recording is damaged: {} has {} times, but {} values.", series.name,
                                out.time.size(), out.value.size()),
                    {}, path());
    if (!whole_) MOTIONRACK_CHECK(out.end_before(known_to_));
    return out;
}

/// Finds the last time by bisection, as times increase.
Result<void> RecordingReader::Columns::end_before(Instant until) {
    std::uint64_t low = 0, high = size;
    while (low < high) {
        const std::uint64_t middle = low + (high - low) / 2;
        std::int64_t at = 0;
        MOTIONRACK_CHECK(time.read(middle, 1, &at));
        if (at < until.count())
            low = middle + 1;
        else
            high = middle;
    }
    size = low;
    return {};
}

// ---- the report

namespace {

struct Kept {
    std::int64_t at = 0;
    std::array<AxisSample, 6> axes = {};
};

/// Columns of one axis, with a block of each.
struct AxisBlock {
    hdf5::Reader position, velocity, accel, volts;
    bool servo = false;
    std::array<double, read_block> positions, velocities;
    std::array<float, read_block> accels, voltages;

    Result<void> read(std::uint64_t from, std::size_t count) {
        MOTIONRACK_CHECK(position.read(from, count, positions.data()));
        MOTIONRACK_CHECK(velocity.read(from, count, velocities.data()));
        MOTIONRACK_CHECK(accel.read(from, count, accels.data()));
        return servo ? volts.read(from, count, voltages.data()) : Result<void>();
    }
};

/// Index of a path axis X, Y, Z; -1: another axis.
int path_axis(const std::string& name) {
    return name.size() == 1 && name[0] >= 'X' && name[0] <= 'Z' ? name[0] - 'X' : -1;
}

/// Copies the stored samples into the report.
void put(ReportData& data, const DecimatingBuffer<Kept>& keeper, const std::vector<RecordedAxis>& axes) {
    const std::vector<Kept>& kept = keeper.samples();
    for (const Kept& sample : kept) {
        data.seconds.push_back(to_seconds(Duration{sample.at - kept.front().at}));
        Xyz place{};
        for (std::size_t i = 0; i < axes.size(); ++i) {
            ReportAxis& axis = data.axes[i];
            axis.position.push_back(static_cast<float>(sample.axes[i].position));
            axis.velocity.push_back(static_cast<float>(sample.axes[i].velocity));
            axis.accel.push_back(sample.axes[i].accel);
            if (axes[i].servo) axis.volts.push_back(sample.axes[i].volts);
            if (const int along = path_axis(axes[i].name); along >= 0)
                place[static_cast<std::size_t>(along)] = sample.axes[i].position;
        }
        data.driven.push_back(place);
    }
    for (const double off : keeper.deviations()) data.deviation_mm.push_back(static_cast<float>(off));
}

}  // namespace

Result<void> RecordingReader::read_samples(ReportData& data) const {
    MOTIONRACK_TRY(const Columns first, columns(*find("deviation")));
    std::vector<std::unique_ptr<AxisBlock>> axes;
    std::uint64_t size = first.size;
    for (const RecordedAxis& axis : head_.axes) {
        const std::string folder = "samples/" + axis_folder(axis.name);
        auto one = std::make_unique<AxisBlock>();
        one->servo = axis.servo;
        MOTIONRACK_TRY(one->position, file_.column(folder + "/position"));
        MOTIONRACK_TRY(one->velocity, file_.column(folder + "/velocity"));
        MOTIONRACK_TRY(one->accel, file_.column(folder + "/acceleration"));
        if (axis.servo) {
            MOTIONRACK_TRY(one->volts, file_.column(folder + "/drive"));
        }
        size = std::min({size, one->position.size(), one->velocity.size(), one->accel.size()});
        if (axis.servo) size = std::min(size, one->volts.size());
        axes.push_back(std::move(one));
    }
    DecimatingBuffer<Kept> keeper(max_samples_);
    std::vector<std::int64_t> times(read_block);
    std::vector<double> deviations(read_block);
    for (std::uint64_t from = 0; from < size; from += read_block) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(read_block, size - from));
        MOTIONRACK_CHECK(first.time.read(from, count, times.data()));
        MOTIONRACK_CHECK(first.value.read(from, count, deviations.data()));
        for (const auto& axis : axes) MOTIONRACK_CHECK(axis->read(from, count));
        for (std::size_t i = 0; i < count; ++i) {
            Kept one{times[i], {}};
            for (std::size_t k = 0; k < axes.size(); ++k)
                one.axes[k] = {axes[k]->positions[i], 0, axes[k]->velocities[i], axes[k]->accels[i],
                               axes[k]->servo ? axes[k]->voltages[i] : 0};
            keeper.add(one, deviations[i]);
        }
    }
    put(data, keeper, head_.axes);
    return {};
}

ReportData RecordingReader::report_of_cut() const {
    ReportData data;
    data.title = data.program_name = head_.program_name;
    data.rack_name = head_.rack_name;
    data.verdict = {false, cut_sentence()};
    for (const RecordedAxis& axis : head_.axes) {
        ReportAxis one;
        one.name = axis.name;
        one.unit = axis.unit;
        one.servo = axis.servo;
        one.min_position = axis.min_position;
        one.max_position = axis.max_position;
        one.max_velocity = axis.max_velocity;
        one.max_accel = axis.max_accel;
        data.axes.push_back(std::move(one));
    }
    data.notes = {
        "Pulses, counts, blocks and peak values are written at the end of a run, so an incomplete recording has none "
        "of them."};
    return data;
}

Result<ReportData> RecordingReader::report() const {
    ReportData data = report_of_cut();
    if (whole_) {
        MOTIONRACK_TRY(data, report_from_json(report_));
        if (data.axes.size() != head_.axes.size())
            return fail(ErrorKind::invalid_input, "The recording is damaged: its report has other axes than its run.",
                        {}, path());
    }
    MOTIONRACK_CHECK(read_samples(data));
    return data;
}

}  // namespace motionrack::trace
