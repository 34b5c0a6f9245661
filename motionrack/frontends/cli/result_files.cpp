// Writes the files one by one; continues after an error.
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/result_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/trace/csv_writer.hpp>

namespace motionrack::cli {

int write_results(const trace::ReportData& data, const ResultFiles& files, std::vector<std::string>& written) {
    int code = exit_done;
    const auto write = [&](const std::string& path, const auto& writer) {
        if (path.empty()) return;
        if (const Result<void> done = writer(data, path); !done)
            code = report(done.error());
        else
            written.push_back(path);
    };
    write(files.page(), trace::write_report);
    write(files.csv, trace::write_csv);
    write(files.events, trace::write_events_csv);
    return code;
}

}  // namespace motionrack::cli
