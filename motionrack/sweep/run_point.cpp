// Runs a point; defines the columns of its row.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/sweep/point.hpp>

namespace motionrack::sweep {

namespace {

std::string number_text(double value) {
    return std::isfinite(value) ? fmt::format("{}", value == 0 ? 0.0 : value) : std::string();
}

/// Columns of a row for each axis.
struct AxisColumn {
    std::string_view name, unit;  ///< "{u}" is mm or deg
    double (*value)(const rack::AxisOutcome& axis);
};
constexpr std::array<AxisColumn, 4> axis_columns = {{
    {"peak_velocity_{u}_s", "{u}/s", [](const rack::AxisOutcome& axis) { return axis.top.peak_velocity; }},
    {"peak_accel_{u}_s2", "{u}/s2", [](const rack::AxisOutcome& axis) { return axis.top.peak_accel; }},
    {"lost_pulses", "", [](const rack::AxisOutcome& axis) { return static_cast<double>(axis.lost_pulses); }},
    {"rest_error_{u}", "{u}", [](const rack::AxisOutcome& axis) { return axis.actual_end - axis.planned_end; }},
}};

constexpr std::string_view letters = "xyzabc";

std::string with_unit(std::string_view text, std::size_t axis) {
    std::string out(text);
    if (const std::size_t at = out.find("{u}"); at != std::string::npos) out.replace(at, 3, axis < 3 ? "mm" : "deg");
    return out;
}

std::string axis_column_name(std::size_t axis, const AxisColumn& column) {
    return fmt::format("{}_{}", letters[axis], with_unit(column.name, axis));
}

std::string ended_text(const rack::JobOutcome& outcome) {
    if (outcome.ended) return outcome.good() ? "ok" : outcome.position_valid ? "limits_broken" : "lost_steps";
    switch (outcome.ended.error().kind) {
        case ErrorKind::invalid_input:
            return "invalid_input";
        case ErrorKind::refused:
            return "refused";
        case ErrorKind::machine:
            return "machine";
        case ErrorKind::io:
            return "io";
        case ErrorKind::stopped:
            break;
    }
    return "stopped";
}

Row row_of(const rack::JobOutcome& outcome) {
    Row out = {{"ended", ended_text(outcome)},
               {"time_s", number_text(to_seconds(outcome.time))},
               {"max_deviation_mm", number_text(outcome.max_deviation.mm)}};
    for (const rack::AxisOutcome& axis : outcome.axes)
        for (const AxisColumn& column : axis_columns)
            out.emplace_back(axis_column_name(static_cast<std::size_t>(axis.index), column),
                             number_text(column.value(axis)));
    out.emplace_back("trace_hash", fmt::format("{:016x}", outcome.trace_hash));
    return out;
}

/// Row of a point that was rejected before its start.
Row refused(const Error& error) {
    rack::JobOutcome out;
    out.ended = tl::unexpected<Error>(error);
    return {{"ended", ended_text(out)}};
}

}  // namespace

std::span<const ResultColumn> result_columns() {
    static const std::vector<ResultColumn> columns = [] {
        std::vector<ResultColumn> out = {{"ended", "", true}, {"time_s", "s"}, {"max_deviation_mm", "mm"}};
        for (std::size_t axis = 0; axis < letters.size(); ++axis)
            for (const AxisColumn& column : axis_columns)
                out.push_back({axis_column_name(axis, column), with_unit(column.unit, axis)});
        out.push_back({"trace_hash", "", true});
        return out;
    }();
    return columns;
}

std::string_view cell_of(const Row& row, std::string_view column) {
    const auto found = std::find_if(row.begin(), row.end(), [&](const auto& cell) { return cell.first == column; });
    return found == row.end() ? std::string_view() : std::string_view(found->second);
}

Result<Row> run_point(std::string_view text, const std::atomic<bool>* stop) {
    MOTIONRACK_TRY(PointText point, read_point(text));
    rack::RackReading reading = rack::read_rack_text(point.rack, "rack");
    if (!reading.config) return tl::unexpected<Error>(reading.errors.front());
    rack::JobRequest request;
    request.config = std::move(*reading.config);
    request.program = std::move(point.program);
    request.program_name = "program";
    request.block_delete = point.block_delete;
    request.subprograms = std::move(point.subprograms);
    MOTIONRACK_TRY(request.tools, control::gcode::read_tool_table(point.tools, "tools"));
    MOTIONRACK_TRY(request.faults, rack::read_faults(point.faults));
    const control::gcode::ProgramCheck check =
        control::gcode::check_program(request.program, rack::reading_of(request), 1, request.program_name);
    if (!check.problems.empty()) return refused(check.problems.front());
    auto job = rack::RecordedJob::create(request, {});
    if (!job) return refused(job.error());
    const rack::JobOutcome& outcome = (*job)->run(stop, {});
    if (!outcome.ended && outcome.ended.error().kind == ErrorKind::stopped)
        return tl::unexpected<Error>(outcome.ended.error());
    return row_of(outcome);
}

}  // namespace motionrack::sweep
