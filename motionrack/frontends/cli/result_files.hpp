// Output files of a run or its recording: report, samples, events.
#pragma once

#include <motionrack/trace/report.hpp>
#include <string>
#include <vector>

namespace motionrack::cli {

/// Paths of the output files; an empty path skips that output.
struct ResultFiles {
    std::string report = "report.html", csv, events;
    bool no_report = false;

    std::string page() const { return no_report ? std::string() : report; }
};

/// Adds the paths of the files written to `written`. Reports each write error and returns the exit code.
int write_results(const trace::ReportData& data, const ResultFiles& files, std::vector<std::string>& written);

}  // namespace motionrack::cli
