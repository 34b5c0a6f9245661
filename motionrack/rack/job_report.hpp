// Report and summary of a job.
#pragma once

#include <motionrack/rack/job.hpp>
#include <motionrack/trace/report.hpp>
#include <string>

namespace motionrack::rack {

/// Data of the HTML report. `program` is the text that was run.
trace::ReportData report_of(Rack& rack, const Job& job, const JobOutcome& outcome, std::string_view program,
                            const std::string& program_name);

/// Plain-text summary of a run, without colours; reproducible for the same job.
std::string summary_of(const RackConfig& config, const JobOutcome& outcome);

/// Summary as JSON.
std::string summary_json(const RackConfig& config, const JobOutcome& outcome);

}  // namespace motionrack::rack
