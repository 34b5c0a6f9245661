// run and trace: a part program on a rack, with progress, summary, report and recordings.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <motionrack/control/gcode/empty_program.hpp>
#include <motionrack/frontends/cli/changed_files.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/result_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/rack/wave_sink.hpp>
#include <vector>

namespace motionrack::cli {

namespace {

struct RunOptions {
    std::string program, rack, record, vcd;
    ReadingOptions reading;
    ResultFiles files;
    std::vector<std::string> signals, faults, commands;
    double unit_ns = 0;  ///< 0: as fine as the signals require
    bool json = false, quiet = false, stream = false;
};

/// Number of problems after which an unchecked program is aborted.
constexpr std::size_t max_unchecked = 10'000;

/// Reads the run request; returns an exit code on errors.
int read_request(const RunOptions& options, rack::JobRequest& request) {
    int code = exit_done;
    Result<ProgramText> rack_text = load_rack_text(options.rack);
    if (!rack_text) return report(rack_text.error());
    auto config = print_reading(rack::read_rack_text(rack_text->text, rack_text->name), code);
    if (!config) return code;
    request.config = std::move(*config);
    Result<ProgramText> program = load_program(options.program);
    if (!program) return report(program.error());
    request.rack_text = std::move(rack_text->text);
    request.rack_file = std::move(rack_text->name);
    request.program = std::move(program->text);
    request.program_name = std::move(program->name);
    request.block_delete = options.reading.block_delete;
    request.stream = options.stream;
    request.version = MOTIONRACK_VERSION;
    auto faults = rack::read_faults(options.faults);
    if (!faults) return report(faults.error());
    auto commands = rack::read_commands(options.commands);
    if (!commands) return report(commands.error());
    request.faults = std::move(*faults);
    request.commands = std::move(*commands);
    return exit_done;
}

/// Wraps the loader of subprograms: the text of each loaded subprogram is stored in `kept`, for runs and recordings.
void keep_subprograms(control::gcode::Settings& settings, std::map<std::string, std::string>& kept) {
    if (!settings.subprogram) return;
    settings.subprogram = [load = settings.subprogram, &kept](const std::string& name) -> Result<std::string> {
        Result<std::string> text = load(name);
        if (text) kept[name] = *text;
        return text;
    };
}

/// Writes the results and prints the names of all written files. `whole`: those written during the run are complete.
int write_results(const rack::RecordedJob& job, const RunOptions& options, bool whole) {
    std::vector<std::string> written;
    const int code = write_results(job.report(), options.files, written);
    for (const std::string& path : {options.vcd, options.record})
        if (whole && !path.empty()) written.push_back(path);
    if (!options.json && !written.empty() && !options.quiet) fmt::print("\nwritten: {}\n", fmt::join(written, ", "));
    return code;
}

void print_warnings(const rack::JobOutcome& outcome) {
    static constexpr std::size_t warnings_shown = 12;
    for (std::size_t i = 0; i < outcome.warnings.size() && i < warnings_shown; ++i)
        print_warning(outcome.warnings[i].text);
    if (outcome.warnings.size() > warnings_shown)
        print_warning(fmt::format("{} more are in the report", outcome.warnings.size() - warnings_shown));
}

void print_outcome(const rack::RecordedJob& job, const rack::JobRequest& request, const rack::JobOutcome& outcome,
                   const RunOptions& options) {
    fmt::print("{}", options.json ? rack::summary_json(request.config, outcome) + "\n"
                                  : rack::summary_of(request.config, outcome));
    if (!options.json) print_warnings(outcome);
    for (const std::string& one : job.not_done()) print_warning(one);
}

int run(const RunOptions& options) {
    rack::JobRequest request;
    std::vector<std::string> inputs = {options.program, options.rack, options.reading.tools};
    const std::vector<std::string> outputs = {options.files.page(), options.record, options.vcd, options.files.csv,
                                              options.files.events};
    if (!may_write(inputs, outputs)) return exit_refused;
    if (const int bad = read_request(options, request); bad != exit_done) return bad;
    int unread = exit_done;
    std::optional<control::gcode::Settings> settings =
        program_settings(request.config, request.program_name, options.reading, unread);
    if (!settings) return unread;
    note_subprograms(*settings, request.program_name, inputs);
    keep_subprograms(*settings, request.subprograms);
    request.tools = settings->tools;
    if (const Result<void> good = control::gcode::check_settings(*settings); !good) return report(good.error());
    const std::string& name = request.program_name;
    // Reads the program even without a check, to find the subprograms it calls.
    const control::gcode::ProgramCheck check = control::gcode::check_program(
        request.program, *settings, options.stream ? max_unchecked : max_problems_of_run, name);
    if (!options.stream || control::gcode::is_empty_program(request.program))
        if (const int bad = print_problems(check, name); bad != exit_done) return bad;
    if (!may_write(inputs, outputs)) return exit_refused;

    rack::JobObservers watchers;
    watchers.recording = options.record;
    if (!options.vcd.empty()) {
        rack::RecorderSettings& waves = watchers.waves.emplace();
        waves.signals = options.signals;
        waves.sink = rack::wave_sink({options.vcd, rack::WaveFormat::vcd, from_seconds(options.unit_ns * 1e-9)});
    }
    auto job = rack::RecordedJob::create(request, watchers);
    if (!job) return report(job.error());
    ProgressLine progress(options.quiet || options.json);
    stop_on_signals();
    const rack::JobOutcome& outcome = (*job)->run(&stop_asked, [&progress](const rack::JobProgress& p) {
        progress.show(static_cast<double>(p.line) / static_cast<double>(p.lines),
                      fmt::format("line {} of {}, {:.2f} s", p.line, p.lines, p.seconds));
    });
    progress.clear();
    int code = exit_done;
    const Result<void> done = (*job)->finish();
    if (!done) code = report(done.error());
    if (!outcome.ended) code = report(outcome.ended.error());
    print_outcome(**job, request, outcome, options);
    warn_of_changes(options.program, request.program, request.subprograms);
    const int wrote = write_results(**job, options, done.has_value());
    if (code == exit_done) code = wrote;
    return code == exit_done && !outcome.good() ? static_cast<int>(exit_machine) : code;
}

void add_common(CLI::App* command, const std::shared_ptr<RunOptions>& options) {
    command->add_option("--rack", options->rack, "rack file (default: the built-in router)");
    command->add_option(
        "--signals", options->signals,
        "signals for the VCD file, patterns with * and ?: X.step, X.enc_?, motion.* (default: all but pins that "
        "a card drives on demand, such as c1.fout)");
    command->add_option("--timescale-ns", options->unit_ns,
                        "time unit of the VCD file: 0.1, 1, 10, 100 or 1000 ns (default: the coarsest that shows every "
                        "edge that cards and parts drive); sigrok-cli makes a sample of each unit: read fine units "
                        "with -I vcd:downsample=N");
    command->add_option("--csv", options->files.csv,
                        "write the samples (position, velocity and deviation every ms) as CSV");
    command->add_option("--events", options->files.events, "write the events (moves, warnings, the stop) as CSV");
    command
        ->add_option("--fault", options->faults,
                     "inject a fault during the run, NAME=VALUE@TIME: X.limit_plus=0@0.5s, X.encoder.broken_a@1s")
        ->allow_extra_args(false);
    command
        ->add_option(
            "--at", options->commands,
            "a command while the program runs, COMMAND@TIME: hold@1.5s, resume@2s, feed=0.5@1s, rapid=0.25@1s, stop@3s")
        ->allow_extra_args(false);
    add_reading_options(*command, options->reading);
    command->add_flag("--stream", options->stream,
                      "execute line by line while reading, without checking the whole program first");
    command->add_flag("--json", options->json, "print the summary as JSON");
    command->add_flag("-q,--quiet", options->quiet, "no progress");
}

}  // namespace

void add_run(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = app.add_subcommand("run", "Run a part program on a rack: progress, summary, report.html");
    command->add_option("PROGRAM", options->program,
                        "part program, '-': standard input (default: the built-in example)");
    command->add_option("--report", options->files.report, "path of the report")->capture_default_str();
    command->add_flag("--no-report", options->files.no_report, "write no report");
    command->add_option("--record", options->record, "write a recording (HDF5) for report, diff and replay");
    command->add_option("--vcd", options->vcd, "write the waves as a VCD file");
    add_common(command, options);
    command->footer(
        "Example: motionrack run part.ngc --rack my.toml --report part.html\nExample: motionrack run part.ngc --record "
        "part.h5 --at hold@0.5s --at resume@1s\nExample: motionrack run part.ngc --fault X.motor.lose_steps=64@1.5s "
        "--fault X.limit_plus=0@2s --events events.csv\nCtrl-C stops the axes along the path and keeps the recording.");
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

void add_trace(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<RunOptions>();
    options->files.no_report = true;
    CLI::App* command = app.add_subcommand(
        "trace", "Run a part program and write wires, pulses and encoder lines as a VCD file (GTKWave, sigrok)");
    command->add_option("PROGRAM", options->program, "part program")->required();
    command->add_option("VCD", options->vcd, "the file to write")->required();
    add_common(command, options);
    command->footer("Example: motionrack trace part.ngc part.vcd --signals 'X.*'");
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace motionrack::cli
