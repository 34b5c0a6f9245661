// Report page from the samples of a CSV file, as far as its columns allow.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/trace/report.hpp>
#include <string>

namespace motionrack::trace {

/// Reads a table of write_csv: time_s and any of x_position_mm, x_velocity_mm_s, x_acceleration_mm_s2, x_drive_v,
/// deviation_mm, driven_x_mm. Errors: io, invalid_input (no time_s, no displayable column, decreasing times).
Result<ReportData> report_from_csv(const std::string& path);

}  // namespace motionrack::trace
