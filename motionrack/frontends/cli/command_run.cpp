// run and trace: a part program on a rack, with progress, summary, report and recordings.
#include <fmt/format.h>

#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/stop.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/fault_plan.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <motionrack/trace/csv.hpp>
#include <motionrack/trace/report.hpp>
#include <vector>

namespace motionrack::cli {

namespace {

struct RunOptions {
    std::string program, rack, tools, report = "report.html", vcd, csv, events;
    std::vector<std::string> signals, faults;
    double timescale_ns = 100;
    bool json = false, quiet = false, no_report = false, block_delete = false, stream = false;
};

int prepare_recorder(rack::Rack& rack, const RunOptions& options, std::unique_ptr<rack::WaveRecorder>& recorder) {
    if (options.vcd.empty()) return exit_done;
    rack::WaveSettings settings;
    settings.path = options.vcd;
    settings.signals = options.signals;
    settings.timescale = from_seconds(options.timescale_ns * 1e-9);
    auto made = rack::WaveRecorder::create(rack, settings);
    if (!made) return report(made.error());
    recorder = std::move(*made);
    return exit_done;
}

int write_results(rack::Rack& rack, const rack::Job& job, const rack::JobOutcome& outcome, const RunOptions& options,
                  const std::string& text, const std::string& name) {
    int code = exit_done;
    std::vector<std::string> written;
    trace::ReportData data;
    if (!options.no_report || !options.csv.empty() || !options.events.empty()) data = rack::report_of(rack, job, outcome, text, name);
    const auto write = [&](const std::string& path, const auto& writer) {
        if (path.empty()) return;
        if (const Result<void> done = writer(data, path); !done)
            code = report(done.error());
        else
            written.push_back(path);
    };
    write(options.no_report ? std::string() : options.report, trace::write_report);
    write(options.csv, trace::write_csv);
    write(options.events, trace::write_events_csv);
    if (!options.vcd.empty()) written.push_back(options.vcd);
    if (!options.json && !written.empty() && !options.quiet) fmt::print("\nwritten: {}\n", fmt::join(written, ", "));
    return code;
}

int run(const RunOptions& options) {
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    const Result<ProgramText> program = load_program(options.program);
    if (!program) return report(program.error());
    const auto& [text, name] = *program;
    control::gcode::Settings settings = program_settings(*config, name, options.block_delete);
    if (!load_tools(options.tools, settings, code)) return code;
    if (const Result<void> good = control::gcode::check_settings(settings); !good) return report(good.error());
    if (!options.stream)
        if (const int bad = print_problems(control::gcode::check_program(text, settings, 20, name), name); bad != exit_done) return bad;

    rack::Rack rack(*config);
    std::unique_ptr<rack::WaveRecorder> recorder;
    if (const int bad = prepare_recorder(rack, options, recorder); bad != exit_done) return bad;
    const auto faults = rack::FaultPlan::create(rack, options.faults);
    if (!faults) return report(faults.error());
    ProgressLine progress(options.quiet || options.json);
    rack::JobSettings job_settings;
    job_settings.program = text;
    job_settings.program_name = name;
    job_settings.reading = settings;
    job_settings.stop = &stop_asked;
    job_settings.progress = [&progress](const rack::JobProgress& p) {
        progress.show(static_cast<double>(p.line) / static_cast<double>(p.lines), fmt::format("line {} of {}, {:.2f} s", p.line, p.lines, p.seconds));
    };
    job_settings.on_slice = [&recorder, &faults] {
        if (recorder) recorder->drain();
        (*faults)->apply_due();
    };
    rack::Job job(rack, job_settings);
    rack.start();
    if (recorder) recorder->begin();
    (*faults)->begin();
    stop_on_signals();
    const rack::JobOutcome outcome = job.run();
    progress.clear();
    if (recorder)
        if (const Result<void> done = recorder->finish(); !done) code = report(done.error());
    if (!outcome.ended) code = report(outcome.ended.error());
    fmt::print("{}", options.json ? rack::summary_json(*config, outcome) + "\n" : rack::summary_of(*config, outcome));
    if (!options.json) {
        static constexpr std::size_t warnings_shown = 12;
        for (std::size_t i = 0; i < outcome.warnings.size() && i < warnings_shown; ++i) print_warning(outcome.warnings[i].text);
        if (outcome.warnings.size() > warnings_shown)
            print_warning(fmt::format("{} more are in the report", outcome.warnings.size() - warnings_shown));
        for (const std::string& fault : (*faults)->not_done()) print_warning(fault);
    }
    const int wrote = write_results(rack, job, outcome, options, text, name);
    if (code == exit_done) code = wrote;
    return code == exit_done && !outcome.position_trusted ? static_cast<int>(exit_machine) : code;
}

void add_common(CLI::App* command, const std::shared_ptr<RunOptions>& options) {
    command->add_option("--rack", options->rack, "rack file (default: the built-in router)");
    command->add_option("--signals", options->signals, "signals for the VCD file, patterns with * and ? (default: all): X.step, X.enc_?, motion.*");
    command->add_option("--timescale-ns", options->timescale_ns, "time unit of the VCD file: 0.1, 1, 10, 100 or 1000 ns")->capture_default_str();
    command->add_option("--csv", options->csv, "write the samples (position, speed, deviation every ms) as CSV");
    command->add_option("--events", options->events, "write what happened (blocks, warnings, the stop) as CSV");
    command->add_option("--fault", options->faults, "break something on the way, NAME=VALUE@TIME: X.limit_plus=0@0.5s, X.encoder.broken_a@1s")
        ->allow_extra_args(false);
    command->add_option("--tools", options->tools, "tool table (LinuxCNC's .tbl) with the lengths for G43");
    command->add_flag("--block-delete", options->block_delete, "leave out lines that begin with '/'");
    command->add_flag("--stream", options->stream, "move line by line as it is read, without checking the whole program first");
    command->add_flag("--json", options->json, "print the summary as JSON");
    command->add_flag("-q,--quiet", options->quiet, "no progress");
}

}  // namespace

void add_run(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = app.add_subcommand("run", "Run a part program on a rack: progress, summary, report.html");
    command->add_option("PROGRAM", options->program, "part program, '-': standard input (default: the built-in example)");
    command->add_option("--report", options->report, "where the report goes")->capture_default_str();
    command->add_flag("--no-report", options->no_report, "write no report");
    command->add_option("--vcd", options->vcd, "write the waves as a VCD file");
    add_common(command, options);
    command->footer("Example: motionrack run part.ngc --rack my.toml --report part.html\n"
                    "Example: motionrack run part.ngc --fault X.motor.lose_steps=64@1.5s --fault X.limit_plus=0@2s --events events.csv\nCtrl-C brings the axes to rest along the path and keeps "
                    "what was recorded.");
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

void add_trace(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<RunOptions>();
    options->no_report = true;
    CLI::App* command = app.add_subcommand("trace", "Run a part program and write wires, pulses and encoder lines as a VCD file (GTKWave, sigrok)");
    command->add_option("PROGRAM", options->program, "part program")->required();
    command->add_option("VCD", options->vcd, "the file to write")->required();
    add_common(command, options);
    command->footer("Example: motionrack trace part.ngc part.vcd --signals 'X.*'");
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace motionrack::cli
