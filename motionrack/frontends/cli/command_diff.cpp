// diff: the first difference of two recordings.
#include <fmt/format.h>

#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/trace/diff.hpp>
#include <string>

namespace motionrack::cli {

namespace {

struct DiffOptions {
    std::string a, b;
    bool json = false, quiet = false;
};

int compare_files(const DiffOptions& options) {
    ProgressLine progress(options.quiet || options.json);
    stop_on_signals();
    trace::DiffSettings settings;
    settings.progress = [&progress](double part) { progress.show(part, "compared"); };
    settings.stop = [] { return stop_asked.load(); };
    const Result<trace::Diff> diff = trace::diff_files(options.a, options.b, settings);
    progress.clear();
    if (!diff) return report(diff.error());
    fmt::print("{}", options.json ? trace::diff_json(*diff, options.a, options.b) + "\n"
                                  : trace::diff_text(*diff, options.a, options.b));
    std::fflush(stdout);
    if (!options.json)
        for (const std::string& note : diff->notes) print_warning(note);
    if (diff->stopped) {
        print_error("Stopped: only a part was compared.");
        return exit_stopped;
    }
    return diff->same() ? exit_done : exit_differ;
}

}  // namespace

void add_diff(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<DiffOptions>();
    CLI::App* command = app.add_subcommand(
        "diff", "Find the first difference of two recordings: HDF5, VCD or CSV, two of the same kind");
    command->add_option("A", options->a, "one recording")->required();
    command->add_option("B", options->b, "the other one")->required();
    command->add_flag("--json", options->json, "print everything as JSON");
    command->add_flag("-q,--quiet", options->quiet, "no progress");
    command->footer(
        "Example: motionrack diff before.h5 after.h5\n"
        "Exit code 0: the same; 6: they differ. For each signal's first difference it prints the name, seconds, ns and "
        "ticks of 100 ps.");
    command->callback([options, &chosen] { chosen = [options] { return compare_files(*options); }; });
}

}  // namespace motionrack::cli
