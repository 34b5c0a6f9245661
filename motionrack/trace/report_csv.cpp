// Finds columns by name and reads them into the series of a report.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <motionrack/base/numbers.hpp>
#include <motionrack/trace/csv_rows.hpp>
#include <motionrack/trace/report_csv.hpp>

namespace motionrack::trace {

namespace {

constexpr std::size_t max_csv_rows = 20'000'000;

using Put = std::function<void(ReportData& data, double value)>;

ReportAxis& axis_of(ReportData& data, char letter, const std::string& unit) {
    const std::string name(1, static_cast<char>(letter - 'a' + 'A'));
    for (ReportAxis& axis : data.axes)
        if (axis.name == name) return axis;
    ReportAxis& made = data.axes.emplace_back();
    made.name = name;
    made.unit = unit;
    return made;
}

/// Returns the handler of a column ("x_velocity_mm_s"); empty if unknown.
Put reader_of(ReportData& data, const std::string& column) {
    if (column == "deviation_mm")
        return [](ReportData& to, double value) { to.deviation_mm.push_back(static_cast<float>(value)); };
    if (column.size() == 11 && column.compare(0, 7, "driven_") == 0 && column.compare(8, 3, "_mm") == 0 &&
        column[7] >= 'x' && column[7] <= 'z')
        return [place = static_cast<std::size_t>(column[7] - 'x')](ReportData& to, double value) {
            to.driven.back()[place] = value;
        };
    const char letter = column.empty() ? '\0' : column[0];
    if (std::string_view("xyzabc").find(letter) == std::string_view::npos || column.size() < 3 || column[1] != '_')
        return {};
    const std::string unit = letter >= 'x' ? "mm" : "deg", what = column.substr(2);
    std::vector<float> ReportAxis::*series = nullptr;
    if (what == "position_" + unit) series = &ReportAxis::position;
    if (what == "velocity_" + unit + "_s") series = &ReportAxis::velocity;
    if (what == "acceleration_" + unit + "_s2") series = &ReportAxis::accel;
    if (what == "drive_v") series = &ReportAxis::volts;
    if (series == nullptr) return {};
    if (series == &ReportAxis::volts) axis_of(data, letter, unit).servo = true;
    axis_of(data, letter, unit);
    return [letter, unit, series](ReportData& to, double value) {
        (axis_of(to, letter, unit).*series).push_back(static_cast<float>(value));
    };
}

/// Returns "x_velocity_mm_s" for "x_speed_mm_s", its former name; empty for others.
std::string present_name(const std::string& column) {
    const std::size_t at = column.find("_speed_");
    return at == 1 ? column.substr(0, 1) + "_velocity_" + column.substr(8) : std::string();
}

struct Columns {
    std::size_t time = 0;
    std::vector<std::pair<std::size_t, Put>> others;
    bool driven = false;
};

Result<Columns> columns_of(const CsvRows& rows, ReportData& data, const std::string& path) {
    Columns out;
    bool timed = false;
    for (std::size_t i = 0; i < rows.head().size(); ++i) {
        const std::string& name = rows.head()[i];
        if (name == "time_s") {
            out.time = i;
            timed = true;
        } else if (Put put = reader_of(data, name)) {
            out.others.emplace_back(i, std::move(put));
            out.driven = out.driven || name.compare(0, 7, "driven_") == 0;
        } else if (reader_of(data, present_name(name))) {
            return fail(ErrorKind::invalid_input,
                        fmt::format("The column '{}' is now '{}'. The file was not read; rename the column.", name,
                                    present_name(name)),
                        {1, 0}, path);
        }
    }
    if (timed && !out.others.empty()) return out;
    return fail(
        ErrorKind::invalid_input,
        "The file has no samples to show: a column time_s is needed, and some like x_position_mm, x_velocity_mm_s "
        "or deviation_mm.",
        {1, 0}, path);
}

/// Computes the peak values of an axis from its samples.
void add_tops(ReportAxis& axis) {
    for (const float velocity : axis.velocity)
        if (std::isfinite(velocity))
            axis.peak_velocity = std::max(axis.peak_velocity, std::fabs(static_cast<double>(velocity)));
    for (const float accel : axis.accel)
        if (std::isfinite(accel)) axis.peak_accel = std::max(axis.peak_accel, std::fabs(static_cast<double>(accel)));
    if (!axis.position.empty()) axis.planned_end = axis.actual_end = axis.position.back();
}

}  // namespace

Result<ReportData> report_from_csv(const std::string& path) {
    MOTIONRACK_TRY(CsvRows rows, CsvRows::open(path));
    ReportData data;
    MOTIONRACK_TRY(const Columns columns, columns_of(rows, data, path));
    std::vector<std::string> row;
    while (true) {
        MOTIONRACK_TRY(const bool more, rows.next(row));
        if (!more) break;
        if (data.seconds.size() == max_csv_rows) {
            data.notes.push_back(fmt::format("The file has more than {} rows; those from line {} on are not shown.",
                                             max_csv_rows, rows.line()));
            break;
        }
        const double seconds = number_of(row[columns.time]);
        if (!std::isfinite(seconds) || (!data.seconds.empty() && seconds < data.seconds.back()))
            return fail(ErrorKind::invalid_input, "The time is not a number, or lies before that of the row above.",
                        {rows.line(), 0}, path);
        data.seconds.push_back(seconds);
        if (columns.driven) data.driven.push_back({});
        for (const auto& [column, put] : columns.others) put(data, number_of(row[column]));
    }
    data.title = data.program_name = path;
    data.program_kind = "Samples";
    data.verdict = {true, fmt::format("{} samples; a CSV file does not have the end of the run.", data.seconds.size())};
    for (ReportAxis& axis : data.axes) add_tops(axis);
    data.notes.push_back(
        "The page was created only from samples: limits, pulses, counts, moves and the programmed path are not in the "
        "file, and the peak values are those of the samples.");
    if (rows.cut()) data.notes.push_back("The file does not end with a whole row: it was cut off.");
    return data;
}

}  // namespace motionrack::trace
