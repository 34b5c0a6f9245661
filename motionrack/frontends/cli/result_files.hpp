// What a run, or its recording, is written to: the page, the samples, what happened.
#pragma once

#include <motionrack/trace/report.hpp>
#include <string>
#include <vector>

namespace motionrack::cli {

/// An empty path: that is not written.
struct ResultFiles {
    std::string report = "report.html", csv, events;
    bool no_report = false;

    std::string page() const { return no_report ? std::string() : report; }
};

/// Adds the paths of what could be written to `written`. The exit code; what could not be written is told.
int write_results(const trace::ReportData& data, const ResultFiles& files, std::vector<std::string>& written);

}  // namespace motionrack::cli
