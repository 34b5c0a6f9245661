// Renders the result of a marking job as a table, as pictures and as a report page.
#pragma once

#include <motionrack/mark/run.hpp>
#include <motionrack/trace/report.hpp>
#include <string_view>
#include <vector>

namespace motionrack::mark {

/// Returns the result as a table.
std::string outcome_text(const MarkingJob& job, const MarkingOutcome& outcome);
/// Returns a table with a row for each part of a job with [parts]; "" without [parts].
std::string parts_text(const MarkingJob& job, const Marked& marked);

/// Smallest field margin of a run, and its edge.
struct FieldMargin {
    double mm = 0;          ///< negative: outside the field by this distance
    const char* edge = "";  ///< "left", "right", "lower" or "upper"
};
FieldMargin margin_of(const MarkingOutcome& outcome, const Marked& marked);
inline constexpr double min_margin_share = 0.05;  ///< fraction of the field width; a smaller margin gives a warning
/// Returns warnings about small margins.
std::vector<std::string> warnings_of(const MarkingOutcome& outcome);

/// Returns the pictures of a result: the part as drawn, with correction and without, the field, and the points of
/// maximum deviation, enlarged.
std::vector<trace::ReportPicture> pictures_of(const Prepared& prepared, const MarkingOutcome& outcome);
/// Returns the pictures of pictures_of() on one sheet, as a standalone SVG file.
std::string picture_svg(const Prepared& prepared, const MarkingOutcome& outcome);

/// Returns the data of the report page. `text`: content of the job file.
trace::ReportData report_of(const MarkingJob& job, const Prepared& prepared, const MarkingOutcome& outcome,
                            std::string_view text);

}  // namespace motionrack::mark
