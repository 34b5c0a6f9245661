// The data of a report as JSON and back: what stands in a recording beside the samples.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/trace/report.hpp>
#include <string>
#include <string_view>

namespace motionrack::trace {

/// All of it but what lies over ReportData::seconds (that, the axes' series, deviation, the driven path). Numbers keep
/// every bit.
std::string report_json(const ReportData& data);

/// Errors: invalid_input.
Result<ReportData> report_from_json(std::string_view text);

}  // namespace motionrack::trace
