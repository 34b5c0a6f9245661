// replay: repeats a recorded run and checks that it is identical bit for bit.
#include <fmt/format.h>
#include <stdlib.h>  // mkdtemp

#include <filesystem>
#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/trace/diff.hpp>
#include <string>
#include <system_error>

namespace motionrack::cli {

namespace {

struct ReplayOptions {
    std::string recording, record;
    bool json = false, quiet = false;
};

/// Private temporary folder, removed on destruction.
struct Scratch {
    std::string folder;
    Scratch() {
        std::error_code none;
        std::string name = (std::filesystem::temp_directory_path(none) / "motionrack_replay_XXXXXX").string();
        if (!none && ::mkdtemp(name.data()) != nullptr) folder = name;
    }
    ~Scratch() {
        std::error_code ignored;
        if (!folder.empty()) std::filesystem::remove_all(folder, ignored);
    }
};

int run_again(const trace::RecordingReader& recording, const std::string& path, const ReplayOptions& options) {
    Result<rack::JobRequest> request = rack::request_of(recording);
    if (!request) return report(request.error());
    request->version = MOTIONRACK_VERSION;
    rack::JobObservers watchers;
    watchers.recording = path;
    const auto job = rack::RecordedJob::create(*request, watchers);
    if (!job) return report(job.error());
    ProgressLine progress(options.quiet || options.json);
    stop_on_signals();
    (*job)->run(&stop_asked, [&progress](const rack::JobProgress& p) {
        progress.show(static_cast<double>(p.line) / static_cast<double>(p.lines),
                      fmt::format("line {} of {}, {:.2f} s", p.line, p.lines, p.seconds));
    });
    progress.clear();
    const Result<void> done = (*job)->finish();
    return done ? exit_done : report(done.error());
}

int compare_with_replay(const trace::RecordingReader& recording, const std::string& path,
                        const ReplayOptions& options) {
    const Result<trace::RecordingReader> again = trace::RecordingReader::open(path);
    if (!again) return report(again.error());
    ProgressLine progress(options.quiet || options.json);
    trace::DiffSettings settings;
    settings.progress = [&progress](double part) { progress.show(part, "compared"); };
    const Result<trace::Diff> diff = trace::diff_recordings(recording, *again, settings);
    progress.clear();
    if (!diff) return report(diff.error());
    const std::string name = options.record.empty() ? "the replay" : options.record;
    if (options.json)
        fmt::print("{}\n", trace::diff_json(*diff, recording.path(), name));
    else if (diff->same())
        fmt::print("The replay is the same bit for bit{}: {} signals, {} values.\n",
                   diff->until ? fmt::format(" before {:.6f} s", to_seconds(*diff->until)) : "", diff->signals,
                   diff->compared);
    else
        fmt::print("The replay differs.\n{}", trace::diff_text(*diff, recording.path(), name));
    std::fflush(stdout);
    if (!options.json && !diff->same() && recording.head().version != again->head().version)
        print_warning(fmt::format("the recording was written by version {}, this is {}", recording.head().version,
                                  again->head().version));
    return diff->same() ? exit_done : exit_differ;
}

int replay(const ReplayOptions& options) {
    const Result<trace::RecordingReader> recording = trace::RecordingReader::open(options.recording);
    if (!recording) return report(recording.error());
    if (!recording->whole()) print_warning(recording->cut_sentence());
    if (!may_write({options.recording}, {options.record})) return exit_refused;
    const Scratch scratch;
    if (options.record.empty() && scratch.folder.empty())
        return report(
            {ErrorKind::io,
             "The folder for temporary files (TMPDIR) was not found; choose a name with --record. Nothing was run."});
    const std::string path = options.record.empty() ? scratch.folder + "/replay.h5" : options.record;
    if (const int bad = run_again(*recording, path, options); bad != exit_done) return bad;
    if (stop_asked) return report({ErrorKind::stopped, "Stopped before the end of the replay; nothing was reported."});
    return compare_with_replay(*recording, path, options);
}

}  // namespace

void add_replay(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<ReplayOptions>();
    CLI::App* command = app.add_subcommand(
        "replay", "Run a recording's program on its rack again, with all recorded inputs, and compare it bit for bit");
    command->add_option("RECORDING", options->recording, "recording of run --record")->required();
    command->add_option("--record", options->record, "write the recording of the replay");
    command->add_flag("--json", options->json, "print the comparison as JSON");
    command->add_flag("-q,--quiet", options->quiet, "no progress");
    command->footer("Example: motionrack replay part.h5\nExit code 0: the same; 6: it differs, and where first.");
    command->callback([options, &chosen] { chosen = [options] { return replay(*options); }; });
}

}  // namespace motionrack::cli
