// Parts of the report page: texts and tables as HTML, drawing data as JSON.
#pragma once

#include <motionrack/trace/report.hpp>
#include <motionrack/trace/svg.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::trace {

inline constexpr std::size_t max_moves = 2000;       ///< rows of the table of moves
inline constexpr std::size_t max_warnings = 500;     ///< rows of the table of warnings
inline constexpr std::size_t max_axes = 16;          ///< axes with charts
inline constexpr std::size_t max_rows = 2000;        ///< rows of every other table
inline constexpr std::size_t max_text_bytes = 2000;  ///< displayed bytes of any text of the run
inline constexpr std::size_t max_source_bytes = 200'000;

/// Truncates `text` to `max_bytes` bytes with "..." and escapes it.
std::string shown(const std::string& text, std::size_t max_bytes = max_text_bytes);

/// Charts of the page: position, velocity and acceleration of each axis that has them, then the deviation and other
/// series.
struct PageChart {
    int axis = -1;  ///< in ReportData::axes; -1: not of an axis
    SvgChart chart;
};
std::vector<PageChart> charts_of(const ReportData& data);

/// Returns the true position at an instant, mm; empty if it was not recorded.
std::optional<Xyz> driven_at(const ReportData& data, double seconds);

std::string header_html(const ReportData& data);
std::string charts_html(const ReportData& data, const std::vector<PageChart>& charts);
/// Charts that do not belong to an axis.
std::string series_html(const std::vector<PageChart>& charts);
std::string pictures_html(const ReportData& data);
std::string tables_html(const ReportData& data);
std::string source_html(const ReportData& data);
std::string axes_html(const ReportData& data);
std::string moves_html(const ReportData& data);
std::string warnings_html(const ReportData& data);
std::string notes_html(const ReportData& data);

/// Data for the script: series, paths and moves, decimated, as integer differences.
std::string drawing_json(const ReportData& data, const std::vector<PageChart>& charts);

}  // namespace motionrack::trace
