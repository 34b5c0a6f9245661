// report: the report page of a run from its recording.
#include <fmt/format.h>

#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/result_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/trace/diff.hpp>
#include <motionrack/trace/report_csv.hpp>
#include <string>
#include <vector>

namespace motionrack::cli {

namespace {

struct ReportOptions {
    std::string recording;
    ResultFiles files;
};

Result<trace::ReportData> read_data(const std::string& path) {
    MOTIONRACK_TRY(const trace::FileKind kind, trace::kind_of_file(path));
    if (kind == trace::FileKind::csv) return trace::report_from_csv(path);
    if (kind == trace::FileKind::vcd)
        return fail(ErrorKind::invalid_input,
                    "A VCD file has wires and counters, but no positions, so a page cannot be created from it. Take "
                    "a recording (--record) or the samples (--csv) of the run.",
                    {}, path);
    MOTIONRACK_TRY(const trace::RecordingReader recording, trace::RecordingReader::open(path));
    if (!recording.whole()) print_warning(recording.cut_sentence());
    return recording.report();
}

int make_report(const ReportOptions& options) {
    if (!may_write({options.recording}, {options.files.page(), options.files.csv, options.files.events}))
        return exit_refused;
    const Result<trace::ReportData> data = read_data(options.recording);
    if (!data) return report(data.error());
    std::vector<std::string> written;
    const int code = write_results(*data, options.files, written);
    fmt::print("{}\n{}", data->verdict.text,
               written.empty() ? "" : fmt::format("written: {}\n", fmt::join(written, ", ")));
    return code;
}

}  // namespace

void add_report(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<ReportOptions>();
    CLI::App* command = app.add_subcommand(
        "report", "Make the report (report.html) of a run from its recording, or from the samples of a CSV file");
    command->add_option("RECORDING", options->recording, "recording of run --record, or samples of run --csv")
        ->required();
    command->add_option("--report", options->files.report, "path of the page")->capture_default_str();
    command->add_flag("--no-report", options->files.no_report, "write no page");
    command->add_option("--csv", options->files.csv, "write the samples as CSV");
    command->add_option("--events", options->files.events, "write the events (moves, warnings, the stop) as CSV");
    command->footer(
        "Example: motionrack report part.h5 --report part.html\n"
        "The page of a recording is the one that run wrote; of an incomplete recording it shows the available part.");
    command->callback([options, &chosen] { chosen = [options] { return make_report(*options); }; });
}

}  // namespace motionrack::cli
