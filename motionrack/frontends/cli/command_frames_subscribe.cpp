// frames subscribe: shows the frames received from a grating bus over the network, live, as lines, as JSON, and every
// frame as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <motionrack/disk/new_file.hpp>
#include <motionrack/disk/outputs.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/frames.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/terminal.hpp>

namespace motionrack::cli {

namespace {

struct SubscribeOptions {
    BusOptions bus;
    int scales = 0;
    std::uint64_t count = 0;
    double seconds = 0, every = 0;
    std::string csv;
    bool json = false, quiet = false;
};

/// Writes every used frame as a row.
class CsvFile {
  public:
    Result<void> open(const std::string& path) {
        if (path.empty()) return {};
        MOTIONRACK_CHECK(disk::may_write({}, {path}));
        path_ = path;
        Result<disk::NewFile> made = disk::NewFile::create(path, disk::NewFile::Incomplete::keep);
        if (!made) return broken(made.error().message);
        file_ = std::move(*made);
        return {};
    }
    void add(const dds::Frame& frame, Instant since_start) {
        if (!file_) return;
        row_.clear();
        auto end = std::back_inserter(row_);
        if (!begun_) {
            row_ = "received_s,sequence,time_s";
            for (std::uint32_t i = 0; i < frame.words; ++i) fmt::format_to(end, ",count_{}", i);
            row_ += '\n';
            begun_ = true;
        }
        fmt::format_to(end, "{:.7f},{},{:.10f}", to_seconds(since_start), frame.sequence, to_seconds(frame.instant()));
        for (const std::uint32_t count : frame.positions())
            fmt::format_to(end, ",{}", static_cast<std::int32_t>(count));
        row_ += '\n';
        (void)file_.write(row_);
    }
    Result<void> finish() {
        const Result<void> done = file_.commit();
        return done ? done : broken(done.error().message);
    }

  private:
    Result<void> broken(const std::string& reason) const {
        return fail(ErrorKind::io,
                    fmt::format("{} cannot be written: {}. Choose another name or make room.", path_, reason));
    }
    disk::NewFile file_;
    std::string path_, row_;
    bool begun_ = false;
};

/// Output on the screen or to a pipe.
class Display {
  public:
    Display(const SubscribeOptions& options, Instant start)
        : options_(options), start_(start), live_(!options.json && !options.quiet && is_terminal(1)) {}

    void events(dds::FrameValidator& judge) {
        for (dds::BusEvent event; judge.next_event(event);) {
            if (options_.json) {
                fmt::print("{}\n", event_json(event, start_));
                std::fflush(stdout);
                continue;
            }
            wipe();
            const bool changed = event.kind == dds::EventKind::joined || event.kind == dds::EventKind::fresh ||
                                 event.kind == dds::EventKind::conflict_over;
            if (!changed)
                print_warning(dds::sentence(event));
            else if (!options_.quiet)
                fmt::print(stderr, "{}\n", dds::sentence(event));
        }
    }
    void status(const dds::Subscriber& subscriber, Instant now) {
        if (options_.json)
            fmt::print("{}\n", status_json(subscriber, options_.bus.name, now));
        else if (live_) {
            wipe();
            const std::string table = status_table(subscriber, options_.bus.name, now);
            lines_ = std::count(table.begin(), table.end(), '\n');
            fmt::print("{}", table);
        } else if (!options_.quiet)
            fmt::print("{}\n", status_line(subscriber, now));
        std::fflush(stdout);
    }
    bool live() const { return live_; }

  private:
    /// Clears the displayed table.
    void wipe() {
        if (lines_ > 0) fmt::print("\033[{}A\033[J", lines_);
        std::fflush(stdout);
        lines_ = 0;
    }
    const SubscribeOptions& options_;
    Instant start_;
    bool live_;
    std::ptrdiff_t lines_ = 0;
};

/// Prints the result of the subscription and returns its exit code.
int ending(const SubscribeOptions& options, const dds::FrameValidator& judge, bool enough) {
    if (stop_asked.load()) return exit_stopped;
    if (judge.counts().used == 0) {
        print_error(
            fmt::format("No frame came on bus '{}' in {:g} s ({} samples were received). Check whether a publisher "
                        "runs under this bus name and in DDS domain {}, and which network CYCLONEDDS_URI chooses.",
                        options.bus.name, options.seconds, judge.counts().received, options.bus.domain));
        return exit_machine;
    }
    if (judge.counts().conflicts != 0) {
        print_error(fmt::format("{} other publishers were on bus '{}'; their frames were not used.",
                                judge.counts().conflicts, options.bus.name));
        return exit_machine;
    }
    if (!enough) {
        print_error(fmt::format("{} frames came in {:g} s, but {} were asked for.", judge.counts().used,
                                options.seconds, options.count));
        return exit_machine;
    }
    return exit_done;
}

/// Returns the maximum wait for a frame: until the last one becomes stale, at most 50 ms.
Duration until_stale(const dds::FrameValidator& judge, Instant now) {
    static constexpr Duration at_most = milliseconds(50);
    if (!judge.joined() || judge.stale()) return at_most;
    return std::clamp(2 * judge.pace() - judge.age(now) + Duration{1}, Duration{0}, at_most);
}

int listen(const SubscribeOptions& options, dds::Subscriber& subscriber, CsvFile& csv) {
    const Instant start = subscriber.poll(nullptr);
    Display display(options, start);
    const Duration every = from_seconds(options.every > 0 ? options.every : display.live() ? 0.2 : 1);
    const Instant end = options.seconds > 0 ? start + from_seconds(options.seconds) : never;
    Instant now = start, next = start + every;
    std::uint64_t used = 0;
    const auto enough = [&] { return options.count != 0 && used >= options.count; };
    while (!stop_asked.load() && now < end && !enough()) {
        subscriber.wait(std::min({next - now, end - now, until_stale(subscriber.judge(), now)}));
        now = subscriber.poll([&](const dds::Sample& sample, dds::Validation verdict, Instant received) {
            if (verdict != dds::Validation::used || enough()) return;
            ++used;
            csv.add(sample.frame, received - start);
        });
        display.events(subscriber.judge());
        if (now < next) continue;
        display.status(subscriber, now);
        next = std::max(next + every, now);
    }
    display.status(subscriber, now);
    const int code = ending(options, subscriber.judge(), options.count == 0 || enough());
    const Result<void> written = csv.finish();
    return written ? code : report(written.error());
}

int subscribe(const SubscribeOptions& options) {
    if (!(options.seconds >= 0 && options.seconds <= 1e8) || !(options.every >= 0 && options.every <= 1e6)) {
        print_error(fmt::format(
            "--duration is {:g} s and --interval {:g} s; they must be 0 to 1e8 and 0 to 1e6. Nothing was opened.",
            options.seconds, options.every));
        return exit_usage;
    }
    if (const Result<void> done = use_config(options.bus); !done) return report(done.error());
    CsvFile csv;
    if (const Result<void> done = csv.open(options.csv); !done) return report(done.error());
    dds::SubscriberSettings settings;
    settings.bus = options.bus.name;
    settings.domain = options.bus.domain;
    settings.judge.words = options.scales;
    const auto subscriber = dds::Subscriber::open(settings);
    if (!subscriber) return report(subscriber.error());
    stop_on_signals();
    return listen(options, **subscriber, csv);
}

}  // namespace

void add_frames_subscribe(CLI::App& frames, Action& chosen) {
    auto options = std::make_shared<SubscribeOptions>();
    CLI::App* command = frames.add_subcommand("subscribe", "Receive the frames that another computer publishes");
    add_bus_options(*command, options->bus);
    command
        ->add_option("--scales", options->scales,
                     "N that is expected; frames with another one are not used (default: N of the first frame)")
        ->check(CLI::Range(1, grating_bus::max_scales))
        ->option_text("1 .. 128");
    command->add_option("--count", options->count, "end after this number of frames");
    command->add_option("--duration", options->seconds, "end after this time, s");
    command->add_option("--interval", options->every,
                        "seconds between two status lines (default: 0.2 on a terminal, 1 else)");
    command->add_option("--csv", options->csv, "write every frame as a row");
    command->add_flag("--json", options->json, "print states and events as lines of JSON");
    command->add_flag("-q,--quiet", options->quiet, "print only errors, no states");
    command->footer(
        "Example: motionrack frames subscribe --bus stage\n"
        "Example: motionrack frames subscribe --bus stage --count 5000 --csv frames.csv\n"
        "Ctrl-C ends it. Exit code 4: no frame came, fewer than asked for, or two publishers were on the bus.");
    command->callback([options, &chosen] { chosen = [options] { return subscribe(*options); }; });
}

}  // namespace motionrack::cli
