// Report data as JSON and back, as stored in a recording beside the samples.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/trace/report.hpp>
#include <string>
#include <string_view>

namespace motionrack::trace {

/// Converts a report to JSON, without the series over ReportData::seconds (seconds, axis series, deviation, actual
/// path). Numbers keep every bit.
std::string report_json(const ReportData& data);

/// Parses the text of report_json(). Errors: invalid_input.
Result<ReportData> report_from_json(std::string_view text);

}  // namespace motionrack::trace
