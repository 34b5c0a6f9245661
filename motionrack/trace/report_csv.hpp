// A page out of the samples of a CSV file, as far as it has columns.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/trace/report.hpp>
#include <string>

namespace motionrack::trace {

/// Of a table as write_csv makes it: time_s and any of x_position_mm, x_speed_mm_s, x_acceleration_mm_s2, x_drive_v,
/// deviation_mm, driven_x_mm. Errors: io, invalid_input (no time_s, nothing that a page shows, times that fall).
Result<ReportData> report_from_csv(const std::string& path);

}  // namespace motionrack::trace
