// frames RACK: runs a rack with a grating bus and shows live the frame of every card, the conflicts, and one frame as a
// picture.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <motionrack/dds/clock.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/frames.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/rack/frame_monitor.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/recorder.hpp>
#include <motionrack/rack/wave_sink.hpp>

namespace motionrack::cli {

namespace {

struct ShowOptions {
    std::string rack, program, vcd, picture;
    std::vector<std::string> faults;
    double seconds = 0.1, every = 0.02;
    bool json = false, quiet = false, real_time = false;
};

/// The table on the screen, rewritten in place on a terminal.
class Screen {
  public:
    Screen(const rack::FrameMonitor& watch, const ShowOptions& options)
        : watch_(watch),
          options_(options),
          live_(is_terminal(1) && !options.json && !options.quiet),
          begun_(dds::monotonic_now()) {}

    /// Shows the state at simulated time `now` if an update is due.
    void refresh(Instant now) {
        if (now < next_) return;
        next_ = now + from_seconds(options_.every);
        if (options_.real_time)
            while (!stop_asked.load() && dds::monotonic_now() < begun_ + now)
                dds::sleep_until(std::min(begun_ + now, dds::monotonic_now() + milliseconds(100)));
        if (live_) show(now);
    }
    void show(Instant now) {
        if (live_ && lines_ > 0) fmt::print("\033[{}A\033[J", lines_);
        const std::string table = frames_table(watch_, now);
        lines_ = std::count(table.begin(), table.end(), '\n');
        fmt::print("{}", table);
        std::fflush(stdout);
    }

  private:
    const rack::FrameMonitor& watch_;
    const ShowOptions& options_;
    bool live_;
    Instant begun_, next_{};
    std::ptrdiff_t lines_ = 0;
};

/// A running rack with all its observers.
struct Show {
    rack::Rack& rack;
    rack::FaultSchedule& faults;
    rack::Recorder* recorder;
    Screen& screen;

    void between_runs() {
        faults.apply_due();
        if (recorder) recorder->drain();
        screen.refresh(rack.kernel().now());
    }
};

void run_for(Show& show, Duration time) {
    sim::Kernel& kernel = show.rack.kernel();
    const Instant end = kernel.now() + time;
    while (kernel.now() < end && !stop_asked.load()) {
        kernel.run_until(std::min(end, kernel.now() + milliseconds(1)));
        show.between_runs();
    }
}

/// Text of a program and the settings to read it with.
struct ReadProgram {
    ProgramText text;
    control::gcode::Settings reading;
};

int read_program(const std::string& path, const rack::RackConfig& config, ReadProgram& out,
                 std::vector<std::string>& inputs) {
    Result<ProgramText> program = load_program(path);
    if (!program) return report(program.error());
    out.text = std::move(*program);
    out.reading = program_settings(config, out.text.name);
    inputs.push_back(path);
    control::gcode::Settings noted = out.reading;
    note_subprograms(noted, out.text.name, inputs);
    return print_problems(control::gcode::check_program(out.text.text, noted, max_problems_of_run, out.text.name),
                          out.text.name);
}

int run_program(Show& show, const ReadProgram& program) {
    rack::JobSettings job_settings;
    job_settings.program = program.text.text;
    job_settings.program_name = program.text.name;
    job_settings.reading = program.reading;
    job_settings.stop = &stop_asked;
    job_settings.on_slice = [&show] { show.between_runs(); };
    rack::Job job(show.rack, job_settings);
    show.rack.start();
    if (show.recorder) show.recorder->begin();
    show.faults.begin();
    const rack::JobOutcome outcome = job.run();
    return outcome.ended ? static_cast<int>(exit_done) : report(outcome.ended.error());
}

int finish(Show& show, const rack::FrameMonitor& watch, const ShowOptions& options) {
    int code = exit_done;
    const auto wrote = [&](const Result<void>& done, const std::string& path) {
        if (!done)
            code = report(done.error());
        else if (!options.json && !options.quiet)
            fmt::print("written: {}\n", path);
    };
    if (options.json)
        fmt::print("{}\n", frames_json(watch, show.rack.kernel().now()));
    else
        show.screen.show(show.rack.kernel().now());
    if (!options.json) {
        fmt::print("{}", conflicts_text(watch.bus(), 12));
        std::fflush(stdout);
        static constexpr std::size_t max_reported = 12;
        const auto conditions = show.rack.kernel().conditions();
        for (std::size_t i = 0; i < std::min(max_reported, conditions.size()); ++i)
            print_warning(show.rack.describe(conditions[i]));
        for (const std::string& fault : show.faults.not_done()) print_warning(fault);
        if (conditions.size() > max_reported)
            print_warning(fmt::format("{} more conditions were reported", conditions.size() - max_reported));
    }
    if (show.recorder) wrote(show.recorder->finish(), options.vcd);
    if (!options.picture.empty()) {
        const Result<std::string> picture = rack::frame_picture(show.rack.config());
        wrote(picture ? write_text(options.picture, *picture) : Result<void>(tl::unexpected(picture.error())),
              options.picture);
    }
    if (code != exit_done) return code;
    return frames_agree(watch) ? exit_done : exit_machine;
}

int show_frames(const ShowOptions& options) {
    if (!(options.seconds >= 0 && options.seconds <= 1e5) || !(options.every > 0 && options.every <= 1e3)) {
        print_error(
            fmt::format("--duration is {:g} s and --interval {:g} s; they must be 0 to 1e5, and more than 0 up to "
                        "1000. Nothing was run.",
                        options.seconds, options.every));
        return exit_usage;
    }
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    rack::Rack rack(*config);
    if (rack::grating_bus_of(rack) == nullptr) {
        print_error(
            "The rack has no card of type grating_bus, so it has no frames. Nothing was run. See examples/13_stage "
            "for one that has.");
        return exit_usage;
    }
    std::vector<std::string> inputs = {options.rack};
    ReadProgram program;
    if (!options.program.empty())
        if (code = read_program(options.program, *config, program, inputs); code != exit_done) return code;
    if (!may_write(inputs, {options.vcd, options.picture})) return exit_refused;
    rack::FrameMonitor watch(rack);
    std::unique_ptr<rack::RecorderTap> tap;
    std::unique_ptr<rack::Recorder> recorder;
    if (!options.vcd.empty()) {
        tap = std::make_unique<rack::RecorderTap>(rack.kernel());
        rack::RecorderSettings settings;
        settings.sink = rack::wave_sink({options.vcd});
        settings.signals = {"bus.*", "*.state", "*.frame_done"};
        settings.tap = tap.get();
        auto made = rack::Recorder::create(rack, settings);
        if (!made) return report(made.error());
        recorder = std::move(*made);
    }
    const auto faults = rack::FaultSchedule::create(rack, options.faults);
    if (!faults) return report(faults.error());
    stop_on_signals();
    Screen screen(watch, options);
    Show show{rack, **faults, recorder.get(), screen};
    if (!options.program.empty()) {
        if (code = run_program(show, program); code != exit_done) return code;
    } else {
        rack.start();
        if (recorder) recorder->begin();
        (*faults)->begin();
        run_for(show, from_seconds(options.seconds));
    }
    code = finish(show, watch, options);
    return stop_asked.load() ? static_cast<int>(exit_stopped) : code;
}

}  // namespace

void add_frames_show(CLI::App& frames, Action& chosen) {
    auto options = std::make_shared<ShowOptions>();
    frames.add_option("RACK", options->rack, "rack file with cards of a grating bus");
    frames.add_option("PROGRAM", options->program, "part program that the rack's axes execute at the same time");
    frames.add_option("--duration", options->seconds, "virtual seconds to run, without a program")
        ->capture_default_str();
    frames.add_option("--interval", options->every, "virtual seconds between two tables")->capture_default_str();
    frames.add_flag("--real-time", options->real_time, "run in real time");
    frames
        .add_option("--fault", options->faults,
                    "inject a fault during the run, NAME=VALUE@TIME: c2.late=40@0.01s, bus.hold=0@0.02s, c1.off@0.05s")
        ->allow_extra_args(false);
    frames.add_option("--vcd", options->vcd,
                      "write states and lines of all frames as a VCD file; keep --duration short");
    frames.add_option("--picture", options->picture, "draw one frame as an SVG file");
    frames.add_flag("--json", options->json, "print the last table as JSON");
    frames.add_flag("-q,--quiet", options->quiet, "only the last table");
    frames.footer(
        "Example: motionrack frames bus.toml\n"
        "Example: motionrack frames bus.toml --duration 0.002 --vcd frames.vcd --picture frame.svg\n"
        "Example: motionrack frames bus.toml --fault c1.off@0.05s\n"
        "Exit code 4: cards do not agree, frames were not true, data are stale, or conflicts occurred.");
    frames.callback([options, &chosen, &frames] {
        if (!frames.get_subcommands().empty()) return;
        chosen = [options] { return show_frames(*options); };
    });
}

}  // namespace motionrack::cli
