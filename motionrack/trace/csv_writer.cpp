// CSV writer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <motionrack/trace/csv_writer.hpp>
#include <motionrack/trace/report_parts.hpp>
#include <optional>
#include <utility>

namespace motionrack::trace {

namespace {

constexpr std::size_t csv_buffer_size = 256 * 1024;

/// Converts "X" to the start of a column name: lower-case letters, digits and '_'.
std::string column_name(const std::string& axis, const std::string& quantity, const std::string& unit) {
    std::string out;
    for (const char c : axis + "_" + quantity + "_" + unit) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        out += plain ? c : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : '_';
    }
    return out;
}

struct Event {
    std::optional<double> seconds;
    std::string_view name;
    int line = 0;
    std::optional<Xyz> at;
    std::string text;
};

std::optional<double> instant(double seconds) {
    if (seconds >= 0 && std::isfinite(seconds)) return seconds;
    return std::nullopt;
}

std::vector<Event> events_of(const ReportData& data) {
    std::vector<Event> events;
    const auto add = [&](double seconds, std::string_view name, int line, std::string text) {
        const std::optional<double> when = instant(seconds);
        events.push_back({when, name, line, when ? driven_at(data, *when) : std::nullopt, std::move(text)});
    };
    for (const ReportMove& move : data.moves) add(move.start, "move", move.line, move.kind);
    for (const ReportWarning& warning : data.warnings) add(warning.seconds, "warning", warning.line, warning.text);
    if (data.max_deviation) {
        const ReportMaxDeviation& max_deviation = *data.max_deviation;
        const std::string text = std::isfinite(max_deviation.mm) ? fmt::format("{} mm", max_deviation.mm) : "";
        events.push_back({instant(max_deviation.seconds), "max deviation", max_deviation.line, max_deviation.at, text});
    }
    if (data.stop)
        events.push_back({instant(data.stop->seconds), "stop", data.stop->line, data.stop->at, data.stop->text});
    std::stable_sort(events.begin(), events.end(),
                     [](const Event& a, const Event& b) { return a.seconds < b.seconds; });
    return events;
}

}  // namespace

Result<CsvWriter> CsvWriter::create(const std::string& path, const std::vector<std::string>& columns) {
    return begin(disk::NewFile::create(path, disk::NewFile::Incomplete::keep), path, columns);
}

Result<CsvWriter> CsvWriter::create_log(const std::string& path, const std::vector<std::string>& columns) {
    return begin(disk::NewFile::create_in_place(path), path, columns);
}

Result<CsvWriter> CsvWriter::begin(Result<disk::NewFile> file, const std::string& path,
                                   const std::vector<std::string>& columns) {
    MOTIONRACK_ASSERT(!columns.empty());
    if (!file) {
        return fail(ErrorKind::io,
                    fmt::format("The CSV file could not be created: {}. Choose another place.", file.error().message),
                    {}, path);
    }
    CsvWriter writer;
    writer.file_ = std::move(*file);
    writer.buffer_.reserve(csv_buffer_size + 4096);
    writer.columns_ = columns.size();
    for (const std::string& column : columns) writer.add(std::string_view(column));
    writer.end_line();
    return writer;
}

CsvWriter::CsvWriter(CsvWriter&& other) noexcept {
    *this = std::move(other);
}

CsvWriter& CsvWriter::operator=(CsvWriter&& other) noexcept {
    if (this == &other) return *this;
    if (file_) write_out();
    file_ = std::move(other.file_);
    gave_up_ = other.gave_up_;
    buffer_ = std::move(other.buffer_);
    columns_ = other.columns_;
    fields_ = other.fields_;
    return *this;
}

// Not closed, because an exception is active: the incomplete file does not replace the final name.
CsvWriter::~CsvWriter() {
    if (file_) write_out();
}

void CsvWriter::separate() {
    MOTIONRACK_ASSERT(fields_ < columns_);
    if (fields_++ > 0) buffer_ += ',';
}

void CsvWriter::add(double value) {
    separate();
    if (std::isfinite(value)) fmt::format_to(std::back_inserter(buffer_), "{}", value == 0 ? 0.0 : value);
}

void CsvWriter::add(float value) {
    separate();
    if (std::isfinite(value)) fmt::format_to(std::back_inserter(buffer_), "{}", value == 0 ? 0.0F : value);
}

void CsvWriter::add(std::int64_t value) {
    separate();
    fmt::format_to(std::back_inserter(buffer_), "{}", value);
}

void CsvWriter::add(std::string_view text) {
    separate();
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
        buffer_ += text;
        return;
    }
    buffer_ += '"';
    for (const char c : text) {
        if (c == '"') buffer_ += '"';
        buffer_ += c;
    }
    buffer_ += '"';
}

void CsvWriter::end_line() {
    MOTIONRACK_ASSERT(fields_ == columns_);
    fields_ = 0;
    buffer_ += "\r\n";
    if (buffer_.size() < csv_buffer_size) return;
    write_out();
    gave_up_ = gave_up_ || !buffer_.empty();
    buffer_.clear();
}

/// Unwritten data stays in the buffer.
void CsvWriter::write_out() {
    if (!gave_up_) file_.try_again();
    const std::uint64_t before = file_.written();
    (void)file_.write(buffer_);
    buffer_.erase(0, file_.written() - before);
}

Result<void> CsvWriter::flush() {
    MOTIONRACK_ASSERT(fields_ == 0);
    write_out();
    return file_.reported("CSV");
}

Result<void> CsvWriter::close() {
    write_out();
    (void)file_.commit();
    return file_.reported("CSV");
}

Result<void> write_csv(const ReportData& data, const std::string& path) {
    std::vector<std::string> columns = {"time_s"};
    std::vector<std::span<const float>> series;
    const auto add = [&](const std::string& name, const std::vector<float>& values) {
        if (values.empty()) return;
        columns.push_back(name);
        series.emplace_back(values);
    };
    for (const ReportAxis& axis : data.axes) {
        add(column_name(axis.name, "position", axis.unit), axis.position);
        add(column_name(axis.name, "velocity", axis.unit + "_s"), axis.velocity);
        add(column_name(axis.name, "acceleration", axis.unit + "_s2"), axis.accel);
        if (axis.servo) add(column_name(axis.name, "drive", "v"), axis.volts);
    }
    add("deviation_mm", data.deviation_mm);
    if (!data.driven.empty()) columns.insert(columns.end(), {"driven_x_mm", "driven_y_mm", "driven_z_mm"});
    MOTIONRACK_TRY(CsvWriter csv, CsvWriter::create(path, columns));
    for (std::size_t i = 0; i < data.seconds.size(); ++i) {
        csv.add(data.seconds[i]);
        for (const std::span<const float> values : series) {
            if (i < values.size()) {
                csv.add(values[i]);
            } else {
                csv.add(std::string_view());
            }
        }
        for (std::size_t c = 0; c < 3 && !data.driven.empty(); ++c) {
            if (i < data.driven.size()) {
                csv.add(data.driven[i][c]);
            } else {
                csv.add(std::string_view());
            }
        }
        csv.end_line();
    }
    return csv.close();
}

Result<void> write_events_csv(const ReportData& data, const std::string& path) {
    const double none = std::numeric_limits<double>::quiet_NaN();  // an empty field
    MOTIONRACK_TRY(CsvWriter csv, CsvWriter::create(path, {"time_s", "event", "line", "x_mm", "y_mm", "z_mm", "text"}));
    for (const Event& event : events_of(data)) {
        csv.add(event.seconds.value_or(none));
        csv.add(event.name);
        csv.add(event.line > 0 ? std::to_string(event.line) : std::string());
        for (std::size_t c = 0; c < 3; ++c) csv.add(event.at ? (*event.at)[c] : none);
        csv.add(event.text);
        csv.end_line();
    }
    return csv.close();
}

}  // namespace motionrack::trace
