// home: homes the axes of a rack and reports the switches found.
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/rack/homing.hpp>
#include <vector>

namespace motionrack::cli {

namespace {

struct HomeOptions {
    std::string axes, rack, picture;
    std::vector<std::string> faults;
    int method = 0;
    bool json = false, quiet = false;
};

/// Returns "part.svg" for one axis, "part_X.svg" for several.
std::string picture_name(const std::string& path, char axis, std::size_t axes) {
    if (axes == 1) return path;
    const std::size_t dot = path.rfind('.'), slash = path.rfind('/');
    const std::size_t at = dot == std::string::npos || (slash != std::string::npos && dot < slash) ? path.size() : dot;
    return path.substr(0, at) + "_" + axis + path.substr(at);
}

/// Returns all possible names of pictures.
std::vector<std::string> pictures_of(const HomeOptions& options, const rack::RackConfig& config) {
    if (options.picture.empty()) return {};
    std::vector<std::string> out = {options.picture};
    for (const rack::RackAxis& axis : config.axes) out.push_back(picture_name(options.picture, axis.letter, 2));
    return out;
}

int write_pictures(const rack::HomingOutcome& outcome, const HomeOptions& options) {
    int code = exit_done;
    for (const rack::HomedAxis& axis : outcome.axes) {
        if (options.picture.empty() || !axis.begun) continue;
        const std::string name = picture_name(options.picture, axis.letter, outcome.axes.size());
        if (const Result<void> done = write_text(name, rack::homing_picture(axis)); !done)
            code = report(done.error());
        else if (!options.json && !options.quiet)
            fmt::print("written: {}\n", name);
    }
    return code;
}

int home(const HomeOptions& options) {
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    if (!may_write({options.rack}, pictures_of(options, *config))) return exit_refused;
    rack::Rack rack(*config);
    std::unique_ptr<rack::FaultSchedule> faults;
    if (!options.faults.empty()) {
        auto plan = rack::FaultSchedule::create(rack, options.faults);
        if (!plan) return report(plan.error());
        faults = std::move(*plan);
        rack.on_slice(milliseconds(50), [&faults] { faults->apply_due(); });
    }
    rack.start();
    if (faults) faults->begin();
    rack::HomingSettings settings;
    for (const char c : options.axes)
        if (c != ',' && c != ' ') settings.axes += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (options.method != 0) settings.method = options.method;
    settings.stop = &stop_asked;
    ProgressLine progress(options.quiet || options.json);
    settings.progress = [&progress](const rack::HomingProgress& p) {
        // The duration is unknown in advance: the bar shows the number of homed axes.
        progress.show(p.axes > 0 ? static_cast<double>(p.homed) / p.axes + 0.003 * std::fmod(p.seconds, 30) / 30 : 0,
                      fmt::format("{} of {} homed, {}, {:.2f} s", p.homed, p.axes, rack::homing_states_text(p.states),
                                  p.seconds));
    };
    stop_on_signals();
    const rack::HomingOutcome outcome = rack::home_axes(rack, settings);
    progress.clear();
    if (!outcome.ended) code = report(outcome.ended.error());
    fmt::print("{}", options.json ? rack::homing_json(outcome) + "\n" : rack::homing_text(outcome));
    if (faults)
        for (const std::string& fault : faults->not_done()) print_warning(fault);
    const int wrote = write_pictures(outcome, options);
    return code == exit_done ? wrote : code;
}

}  // namespace

void add_home(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<HomeOptions>();
    CLI::App* command = app.add_subcommand("home", "Home the axes of a rack and report the switches found");
    command->add_option("AXES", options->axes,
                        "letters, such as XY or X,Y (default: every axis that has a home switch)");
    command->add_option("--rack", options->rack, "rack file (default: the built-in router)");
    command
        ->add_option("--method", options->method,
                     "1 stop at the switch, 2 then again slowly, 3 as 1, then to the encoder's index, 4 as 2, then to "
                     "the index (default: the rack file's)")
        ->check(CLI::Range(1, 4));
    command->add_option("--picture", options->picture,
                        "write position, velocity and states over time as SVG; of several axes NAME_X.svg ..");
    command
        ->add_option("--fault", options->faults,
                     "inject a fault during the run, NAME=VALUE@TIME: X.home.stuck_open@0s, estop=0@0.3s")
        ->allow_extra_args(false);
    command->add_flag("--json", options->json, "print the result as JSON");
    command->add_flag("-q,--quiet", options->quiet, "no progress");
    command->footer(
        "Example: motionrack home XY --rack my.toml --picture home.svg\nExample: motionrack home X --rack my.toml "
        "--fault X.home.stuck_open@0s\nThe search of each axis is defined in [axis.X.homing] of the rack file. Ctrl-C "
        "stops the axes, decelerating.");
    command->callback([options, &chosen] { chosen = [options] { return home(*options); }; });
}

}  // namespace motionrack::cli
