// frames publish: runs a rack in real time and publishes the frames of its grating bus for other computers.
#include <fmt/format.h>

#include <memory>
#include <motionrack/dds/clock.hpp>
#include <motionrack/dds/frame_publisher.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/frames.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/rack/frame_stepper.hpp>
#include <motionrack/rack/job.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace motionrack::cli {

namespace {

struct PublishOptions {
    BusOptions bus;
    std::string rack, program, card;
    std::vector<std::string> faults;
    double time_scale = 1, seconds = 0;
    std::uint64_t count = 0;
    bool json = false, quiet = false;
};

/// Frames of a card in a rack until `end`; runs the rack from frame to frame.
class RackFrames final : public dds::FrameSource {
  public:
    RackFrames(rack::FrameStepper& tap, rack::FaultSchedule& faults, Instant end)
        : tap_(tap), faults_(faults), end_(end) {}
    Result<bool> next(dds::Frame& frame) override {
        tap_.next(frame, [this] { faults_.apply_due(); });
        return frame.instant() < end_;
    }

  private:
    rack::FrameStepper& tap_;
    rack::FaultSchedule& faults_;
    Instant end_;
};

/// Reports the results of the publisher and the accuracy of its times.
void report_published(const dds::Publisher& publisher, const dds::Published& done, const PublishOptions& options) {
    if (options.json) {
        const nlohmann::ordered_json out = {{"bus", options.bus.name},
                                            {"id", publisher.source().id_text()},
                                            {"sent", publisher.sent()},
                                            {"refused", publisher.refused()},
                                            {"late", done.late},
                                            {"slips", done.slips},
                                            {"max_lateness_ms", to_seconds(done.max_lateness) * 1e3},
                                            {"foreign_frames", publisher.foreign_frames()}};
        fmt::print("{}\n", out.dump());
        return;
    }
    if (!options.quiet)
        fmt::print("{} frames published on bus '{}', {} of them late, by at most {:.3f} ms\n", publisher.sent(),
                   options.bus.name, done.late, to_seconds(done.max_lateness) * 1e3);
    if (done.slips != 0)
        print_warning(
            fmt::format("The rack was more than a second behind real time {} times and did not catch up: the computer "
                        "is too slow for --time-scale {:g}.",
                        done.slips, options.time_scale));
    if (publisher.refused() != 0)
        print_warning(fmt::format("{} frames were not taken by the network.", publisher.refused()));
}

/// Rack, publisher and settings of one publication.
struct Run {
    const PublishOptions& options;
    rack::Rack& rack;
    rack::FrameStepper& tap;
    rack::FaultSchedule& faults;
    dds::Publisher& publisher;
    dds::PublishingSettings settings;
};

/// Runs the rack without commanded motion.
Result<dds::Published> publish_standing(Run& run) {
    run.rack.start();
    run.faults.begin();
    RackFrames source(run.tap, run.faults, run.options.seconds > 0 ? from_seconds(run.options.seconds) : never);
    return publish_frames(run.publisher, source, run.settings);
}

/// Publishes the frames while a part program moves the axes.
Result<dds::Published> publish_program(Run& run, const ProgramText& program) {
    dds::FramePublisher publishing(run.publisher, run.settings);
    const Instant end = run.options.seconds > 0 ? from_seconds(run.options.seconds) : never;
    bool enough = false;
    rack::JobSettings job_settings;
    job_settings.program = program.text;
    job_settings.program_name = program.name;
    job_settings.reading = program_settings(run.rack.config(), program.name);
    job_settings.stop = &stop_asked;
    dds::Frame frame;
    job_settings.on_slice = [&] {
        run.faults.apply_due();
        if (enough || !run.tap.take(frame)) return;
        enough = frame.instant() >= end || !publishing.put(frame);
        if (enough) stop_asked.store(true);
    };
    rack::Job job(run.rack, job_settings);
    run.rack.start();
    run.faults.begin();
    const rack::JobOutcome outcome = job.run();
    // The requested number of frames ends the program early.
    const bool ended_here = enough && !publishing.outcome().stopped;
    if (!outcome.ended && !(ended_here && outcome.ended.error().kind == ErrorKind::stopped))
        return tl::unexpected(outcome.ended.error());
    return publishing.outcome();
}

int publish_rack(Run& run) {
    const PublishOptions& options = run.options;
    std::optional<ProgramText> program;
    if (!options.program.empty()) {
        auto loaded = load_program(options.program);
        if (!loaded) return report(loaded.error());
        const control::gcode::Settings settings = program_settings(run.rack.config(), loaded->name);
        if (const int bad = print_problems(
                control::gcode::check_program(loaded->text, settings, max_problems_of_run, loaded->name), loaded->name);
            bad != exit_done)
            return bad;
        program = std::move(*loaded);
    }
    bool conflict = false;
    const Instant start = dds::monotonic_now();
    run.settings.report = [&](const dds::BusEvent& event) {
        conflict = conflict || event.kind == dds::EventKind::conflict;
        if (options.json)
            fmt::print("{}\n", event_json(event, start));
        else
            print_warning(dds::sentence(event));
        std::fflush(stdout);
    };
    if (!options.json && !options.quiet)
        fmt::print("bus {}: {}; {} positions every {:g} ms, Ctrl-C ends it\n", options.bus.name,
                   run.publisher.source().text(), run.tap.card().settings().scales,
                   to_seconds(run.settings.pace) * 1e3);
    std::fflush(stdout);
    const Result<dds::Published> done = program ? publish_program(run, *program) : publish_standing(run);
    if (!done) return report(done.error());
    report_published(run.publisher, *done, options);
    for (const std::string& fault : run.faults.not_done()) print_warning(fault);
    if (conflict) {
        print_error(
            "Another publisher was on the bus; listeners used only the frames of the one that they heard first.");
        return exit_machine;
    }
    return done->stopped ? exit_stopped : exit_done;
}

int publish(const PublishOptions& options) {
    if (!(options.time_scale >= 1e-6 && options.time_scale <= 1e3) ||
        !(options.seconds >= 0 && options.seconds <= 1e8)) {
        print_error(
            fmt::format("--time-scale is {:g} and --duration {:g} s; they must be 1e-6 to 1000 and 0 to 1e8. Nothing "
                        "was published.",
                        options.time_scale, options.seconds));
        return exit_usage;
    }
    if (const Result<void> done = use_config(options.bus); !done) return report(done.error());
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    rack::Rack rack(*config);
    const auto tap = rack::FrameStepper::create(rack, options.card);
    if (!tap) return report(tap.error());
    const auto faults = rack::FaultSchedule::create(rack, options.faults);
    if (!faults) return report(faults.error());
    dds::PublishingSettings settings;
    settings.time_scale = options.time_scale;
    settings.pace = from_seconds(to_seconds((*tap)->period()) / options.time_scale);
    settings.max_frames = options.count;
    settings.stop = &stop_asked;
    const auto publisher =
        dds::Publisher::open({options.bus.name, options.bus.domain, (*tap)->period(), settings.pace});
    if (!publisher) return report(publisher.error());
    stop_on_signals();
    Run run{options, rack, **tap, **faults, **publisher, settings};
    return publish_rack(run);
}

}  // namespace

void add_frames_publish(CLI::App& frames, Action& chosen) {
    auto options = std::make_shared<PublishOptions>();
    CLI::App* command =
        frames.add_subcommand("publish", "Run a rack in real time and publish the frames of its grating bus");
    command->add_option("RACK", options->rack, "rack file with a card of type grating_bus")->required();
    command->add_option("PROGRAM", options->program,
                        "part program that the rack's axes execute at the same time; its end ends the command");
    add_bus_options(*command, options->bus);
    command->add_option("--card", options->card, "the card whose frames are published (default: the bus' host)");
    command->add_option("--time-scale", options->time_scale, "virtual seconds a second: 0.1 is ten times slower")
        ->capture_default_str();
    command->add_option("--count", options->count, "end after this number of frames");
    command->add_option("--duration", options->seconds, "end after this virtual time, s");
    command->add_option("--fault", options->faults, "inject a fault during the run, NAME=VALUE@TIME: host.off=1@2s")
        ->allow_extra_args(false);
    command->add_flag("--json", options->json, "print events and the summary as lines of JSON");
    command->add_flag("-q,--quiet", options->quiet, "print only errors");
    command->footer(
        "Example: motionrack frames publish bus.toml --bus stage\n"
        "Example: motionrack frames publish bus.toml scan.ngc --bus stage --time-scale 0.1\n"
        "Ctrl-C ends it. Exit code 4: another publisher was on the bus.");
    command->callback([options, &chosen] { chosen = [options] { return publish(*options); }; });
}

}  // namespace motionrack::cli
