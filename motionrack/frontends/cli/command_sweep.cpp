// sweep: runs a part program repeatedly with varied parameters, on all cores; finished rows survive a kill.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/nats/distributed_sweep.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <motionrack/sweep/picture.hpp>
#include <motionrack/sweep/worker.hpp>
#include <string>
#include <thread>
#include <vector>

namespace motionrack::cli {

namespace {

struct SweepOptions {
    std::string file, results = "results.csv", picture, nats;
    int jobs = 0;
    bool fresh = false, quiet = false;
};

/// A sweep and the paths of its sweep file and of all files that it names. Without a sweep after a reported error.
struct Loaded {
    std::optional<sweep::Sweep> sweep;
    std::vector<std::string> inputs;
    int code = exit_done;
};

/// Loads a file named by the sweep, by its path relative to the sweep's folder.
Result<std::string> load_beside(const std::string& file, const std::string& name, std::string& path, Loaded& loaded) {
    path = (std::filesystem::path(file).parent_path() / name).string();
    loaded.inputs.push_back(path);
    return read_text(path);
}

Result<sweep::SweepFiles> load_files(const std::string& file, const sweep::SweepSettings& settings, Loaded& loaded) {
    sweep::SweepFiles out;
    MOTIONRACK_TRY(out.program, load_beside(file, settings.program, out.program_name, loaded));
    if (settings.rack) {
        MOTIONRACK_TRY(out.rack, load_beside(file, *settings.rack, out.rack_name, loaded));
    } else {
        MOTIONRACK_TRY(ProgramText built_in, load_rack_text(""));
        out.rack = std::move(built_in.text);
        out.rack_name = std::move(built_in.name);
    }
    if (settings.tools) {
        MOTIONRACK_TRY(out.tools, load_beside(file, *settings.tools, out.tools_name, loaded));
    }
    control::gcode::Settings reading = program_settings({}, out.program_name);
    note_subprograms(reading, out.program_name, loaded.inputs);
    out.subprogram = std::move(reading.subprogram);
    return out;
}

int print_errors(const std::vector<Error>& errors) {
    for (const Error& error : errors) print_error(error.text());
    return errors.empty() ? static_cast<int>(exit_done) : exit_code(errors.front().kind);
}

Loaded load(const std::string& file) {
    Loaded out;
    out.inputs.push_back(file);
    const Result<std::string> text = read_text(file, read_limits::toml);
    if (!text) return out.code = report(text.error()), std::move(out);
    sweep::SweepFileReading read = sweep::read_sweep_file(*text, file);
    if (out.code = print_errors(read.errors); out.code != exit_done) return out;
    const Result<sweep::SweepFiles> files = load_files(file, read.file->settings, out);
    if (!files) return out.code = report(files.error()), std::move(out);
    sweep::SweepReading ready = sweep::prepare(std::move(*read.file), file, *files);
    for (const Error& warning : ready.warnings) print_warning(warning.text());
    out.code = print_errors(ready.errors);
    out.sweep = std::move(ready.sweep);
    return out;
}

/// Returns "30 ok, 2 machine": counts of the results, most frequent first.
std::string endings(const sweep::Sweep& sweep, const sweep::Results& results) {
    std::map<std::string, std::int64_t> counts;
    for (std::int64_t i = 0; i < sweep.points(); ++i) ++counts[std::string(sweep::cell_of(results.row(i), "ended"))];
    std::vector<std::pair<std::int64_t, std::string>> sorted;
    for (const auto& [word, count] : counts) sorted.emplace_back(-count, word);
    std::sort(sorted.begin(), sorted.end());
    std::string out;
    for (const auto& [count, word] : sorted) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", -count, word);
    return out;
}

int write_tables(const sweep::Sweep& sweep, sweep::Results& results, const SweepOptions& options) {
    if (const Result<void> done = results.finish(); !done) return report(done.error());
    if (!options.picture.empty())
        if (const Result<void> drawn = write_text(options.picture, sweep::picture_of(sweep, results)); !drawn)
            return report(drawn.error());
    if (!options.quiet)
        fmt::print("{}: {}\nwritten: {}{}{}\n", rack::count_noun(sweep.points(), "point"), endings(sweep, results),
                   options.results, options.picture.empty() ? "" : ", ", options.picture);
    return exit_done;
}

/// Runs the missing points, locally or on workers.
Result<void> run_missing(const sweep::Sweep& sweep, sweep::Results& results, const SweepOptions& options) {
    ProgressLine progress(options.quiet);
    const auto show = [&](const sweep::WorkProgress& now) {
        progress.show(static_cast<double>(now.done) / static_cast<double>(now.points), sweep::progress_text(now));
    };
    if (!options.nats.empty()) {
        const auto wait = [&](std::int64_t seconds) {
            progress.clear();
            if (!options.quiet)
                print_warning(
                    fmt::format("No row came for {} s. If a point takes less time, start a worker: motionrack "
                                "sweep-worker --nats {}",
                                seconds, nats::without_password(options.nats)));
        };
        return nats::gather(sweep, results, options.nats, options.fresh, stop_asked, show, wait);
    }
    const auto cores =
        static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, static_cast<unsigned>(sweep::max_jobs)));
    return sweep::run_here(sweep, results, options.jobs > 0 ? options.jobs : cores, stop_asked, show);
}

int sweep_all(const SweepOptions& options) {
    const Loaded loaded = load(options.file);
    if (!loaded.sweep) return loaded.code;
    const sweep::Sweep& all = *loaded.sweep;
    if (!may_write(loaded.inputs, {options.results, options.results + ".part", options.picture})) return exit_refused;
    for (const std::string& path : {options.results, options.picture})
        if (!path.empty())
            if (const Result<void> writable = check_writable(path); !writable) return report(writable.error());
    auto results = sweep::Results::open(all, options.results, options.fresh);
    if (!results) return report(results.error());
    const std::int64_t before = (*results)->done();
    if (before > 0 && !options.quiet)
        fmt::print("{} of {} were finished before\n", before, rack::count_noun(all.points(), "point"));
    stop_on_signals();
    const Result<void> done = run_missing(all, **results, options);
    if (done) return write_tables(all, **results, options);
    if (done.error().kind != ErrorKind::stopped) return report(done.error());
    return report(
        {ErrorKind::stopped,
         fmt::format("Stopped. {} of {} are finished and kept in {}; the same command continues with the other points.",
                     (*results)->done(), rack::count_noun(all.points(), "point"), (*results)->part())});
}

}  // namespace

void add_sweep(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<SweepOptions>();
    CLI::App* command = app.add_subcommand(
        "sweep",
        "Run a part program with many parameter values on all cores; write a table and a picture of the results");
    command->add_option("FILE", options->file, "sweep file: program, rack, varied parameters")->required();
    command->add_option("-o,--results", options->results, "the table; CSV, or HDF5 if it ends in .h5")
        ->capture_default_str();
    command->add_option("--picture", options->picture, "draw the results as SVG");
    command->add_option("--jobs", options->jobs, "points that run at the same time (default: one for each core)")
        ->check(CLI::Range(1, sweep::max_jobs));
    command->add_option("--nats", options->nats,
                        "run the points by workers on any machines, through this server with JetStream: "
                        "nats://HOST:4222; see sweep-worker");
    command->add_flag("--restart", options->fresh, "run all points again, also finished ones");
    command->add_flag("-q,--quiet", options->quiet, "no progress, no summary");
    command->footer(
        "Example: motionrack sweep feeds.toml -o feeds.csv --picture feeds.svg\n"
        "Example: motionrack sweep feeds.toml -o feeds.h5 --jobs 4\n"
        "Example: motionrack sweep feeds.toml --nats nats://bench:4222\n"
        "Each row is in RESULTS.part as soon as its point is done. After Ctrl-C, a kill or a power cut the same "
        "command continues with the missing points; rows whose rack, program or\n"
        "values were changed are run again.");
    command->callback([options, &chosen] { chosen = [options] { return sweep_all(*options); }; });
}

}  // namespace motionrack::cli
