// How an outcome is shown: as a table, as pictures and as a page.
#pragma once

#include <motionrack/mark/run.hpp>
#include <motionrack/trace/report.hpp>
#include <string_view>
#include <vector>

namespace motionrack::mark {

/// The outcome as a table for people.
std::string outcome_text(const MarkingJob& job, const MarkingOutcome& outcome);
/// A row for each part of a job with [parts]; empty without.
std::string parts_text(const MarkingJob& job, const Marked& marked);

/// How much of the field a run left free, and where the least of it is.
struct FieldMargin {
    double mm = 0;          ///< below 0: so much is missing
    const char* edge = "";  ///< "left", "right", "lower" or "upper"
};
FieldMargin room_of(const MarkingOutcome& outcome, const Marked& marked);
inline constexpr double min_room_part = 0.05;  ///< of the field's width: less than that is told as a warning
/// Sentences about what nearly went wrong.
std::vector<std::string> warnings_of(const MarkingOutcome& outcome);

/// The part as drawn, with correction and without, the field, and the worst places enlarged.
std::vector<trace::ReportPicture> pictures_of(const Prepared& prepared, const MarkingOutcome& outcome);
/// The same on one sheet, as an SVG file of its own.
std::string picture_svg(const Prepared& prepared, const MarkingOutcome& outcome);

/// Everything the page shows. `text`: of the job file.
trace::ReportData report_of(const MarkingJob& job, const Prepared& prepared, const MarkingOutcome& outcome,
                            std::string_view text);

}  // namespace motionrack::mark
