// The parts of the report's page: texts and tables as HTML, the drawings' numbers as JSON.
#pragma once

#include <motionrack/trace/report.hpp>
#include <motionrack/trace/svg.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::trace {

inline constexpr std::size_t max_blocks = 2000;      ///< rows of the table of blocks
inline constexpr std::size_t max_warnings = 500;     ///< rows of the table of warnings
inline constexpr std::size_t max_axes = 16;          ///< axes with charts
inline constexpr std::size_t max_rows = 2000;        ///< of each other table
inline constexpr std::size_t max_text_bytes = 2000;  ///< bytes of any text of the run that are shown
inline constexpr std::size_t max_source_bytes = 200'000;

/// `text` cut to `most` bytes with "..." and escaped.
std::string shown(const std::string& text, std::size_t most = max_text_bytes);

/// The charts of the page: position, speed and acceleration of each axis that has them, then the deviation and other
/// series.
struct PageChart {
    int axis = -1;  ///< in ReportData::axes; -1: of none
    SvgChart chart;
};
std::vector<PageChart> charts_of(const ReportData& data);

/// Where the machine was at an instant, in mm; nothing where that was not recorded.
std::optional<Xyz> driven_at(const ReportData& data, double seconds);

std::string header_html(const ReportData& data);
std::string charts_html(const ReportData& data, const std::vector<PageChart>& charts);
/// The charts that are of no axis.
std::string series_html(const std::vector<PageChart>& charts);
std::string pictures_html(const ReportData& data);
std::string tables_html(const ReportData& data);
std::string source_html(const ReportData& data);
std::string axes_html(const ReportData& data);
std::string blocks_html(const ReportData& data);
std::string warnings_html(const ReportData& data);
std::string notes_html(const ReportData& data);

/// What the script draws: series, paths and blocks, thinned, as whole numbers that tell the step to the one before.
std::string drawing_json(const ReportData& data, const std::vector<PageChart>& charts);

}  // namespace motionrack::trace
