// Parts of the report page, from the files in trace/report/ (see embed.cmake).
#pragma once

namespace motionrack::trace {

extern const char* const report_page;  ///< with {{name}} placeholders for the parts of the run
extern const char* const report_style;
extern const char* const report_script_base;
extern const char* const report_script_charts;
extern const char* const report_script_path;
extern const char* const report_script_page;

}  // namespace motionrack::trace
