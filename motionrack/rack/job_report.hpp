// What a job was, as a report and a summary.
#pragma once

#include <motionrack/rack/job.hpp>
#include <motionrack/trace/report.hpp>
#include <string>

namespace motionrack::rack {

/// Everything the HTML report shows. `program` is the text that was run.
trace::ReportData report_of(Rack& rack, const Job& job, const JobOutcome& outcome, std::string_view program,
                            const std::string& program_name);

/// The summary that a person reads at the end of a run, without colours, the same for the same job.
std::string summary_of(const RackConfig& config, const JobOutcome& outcome);

/// The summary as JSON.
std::string summary_json(const RackConfig& config, const JobOutcome& outcome);

}  // namespace motionrack::rack
