// plan: duration and axis loads of a part program with three planners; nothing moves.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/trajectory/min_duration.hpp>
#include <motionrack/control/trajectory/offline_trajectory.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/plan_picture.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace motionrack::cli {

namespace {

using control::Move;

struct PlanOptions {
    std::string program, rack, picture;
    ReadingOptions reading;
    bool json = false;
};

/// Peak values of one axis in a plan.
struct AxisPeaks {
    double velocity = 0, accel = 0, jerk = 0;
};
struct Planned {
    double seconds = 0;
    std::int64_t stops = 0;
    double bound = 0;  ///< lower bound of the duration of any jerk-limited plan of this path, s
    std::array<AxisPeaks, control::axis_count> axes = {};
};

Planned by_trapezoids(const std::vector<Move>& moves, const control::MachineLimits& limits, const control::Point& start,
                      bool stopping) {
    control::LookAheadPlanner planner(limits, start);
    control::PlanSummary sum;
    control::PlannedMove planned;
    const auto pull = [&] {
        while (planner.pull(planned)) sum.add(planned);
    };
    for (Move move : moves) {
        if (stopping) move.path = control::PathControl::exact_stop;
        if (!planner.has_room()) pull();
        (void)planner.push(move);
    }
    planner.flush();
    pull();
    return {sum.seconds, sum.stops, 0, {}};
}

/// Sampling interval of a plan; the ends of its sections are sampled, too.
constexpr double look_every_s = 0.001;

Planned jerk_limited(const std::vector<Move>& moves, const control::MachineLimits& limits, const control::Point& start,
                     bool quiet) {
    Planned out;
    control::OfflineTrajectory offline_trajectory(limits, start, [&](const control::PathSection& stretch) {
        out.seconds += stretch.seconds - stretch.overlap + stretch.rest_seconds;
        out.bound += stretch.rest_seconds;
        if (stretch.curve.empty()) return;
        ++out.stops;
        out.bound += control::min_duration_s(stretch.curve, limits);
        control::SectionSampler view(stretch);
        const auto samples = static_cast<std::int64_t>(stretch.seconds / look_every_s) + 20;
        for (std::int64_t i = 0; i <= samples; ++i) {
            const control::TrajectoryPoint state =
                view.at(stretch.seconds * static_cast<double>(i) / static_cast<double>(samples));
            for (std::size_t k = 0; k < out.axes.size(); ++k) {
                AxisPeaks& axis = out.axes[k];
                axis = {std::max(axis.velocity, std::fabs(state.velocity[k])),
                        std::max(axis.accel, std::fabs(state.accel[k])), std::max(axis.jerk, std::fabs(state.jerk[k]))};
            }
        }
    });
    ProgressLine progress(quiet);
    for (std::size_t i = 0; i < moves.size() && !stop_asked; ++i) {
        offline_trajectory.push(moves[i]);
        progress.show(static_cast<double>(i) / static_cast<double>(moves.size()), "planning");
    }
    offline_trajectory.flush();
    return out;
}

struct Plans {
    std::string name;
    std::size_t moves = 0;
    Planned stopping, trapezoids, jerk_limited;
};

double part_of(double value, double limit) {
    return limit > 0 ? value / limit : 0;
}

void print_plans(const Plans& plans, const rack::RackConfig& config) {
    fmt::print("{} on {}: {}.\n", plans.name, config.name, rack::count_noun(plans.moves, "move"));
    fmt::print("{:>51}    stops\n", "time");
    const auto row = [](const char* name, const Planned& planned) {
        fmt::print("  {:<37} {:>9.3f} s  {:>6}\n", name, planned.seconds, planned.stops);
    };
    row("stopping at each move", plans.stopping);
    row("trapezoids", plans.trapezoids);
    row("jerk-limited", plans.jerk_limited);
    fmt::print("  {:<37} {:>9.3f} s\n", "bound (acceleration only, same curve)", plans.jerk_limited.bound);
    fmt::print("Peak of the jerk-limited plan, and its share of the axis' limit:\n");
    for (const rack::RackAxis& axis : config.axes) {
        const AxisPeaks& peaks = plans.jerk_limited.axes[static_cast<std::size_t>(axis.index())];
        if (peaks.velocity == 0) continue;
        const auto value = [&](double peak, const char* unit, double limit) {
            return limit > 0 ? fmt::format("{:>11.5g} {}/{:<3} {:>5.1f} %", peak, axis.unit(), unit,
                                           100 * part_of(peak, limit))
                             : fmt::format("{:>11.5g} {}/{:<3} no limit", peak, axis.unit(), unit);
        };
        fmt::print("  {} {} {} {}\n", axis.letter, value(peaks.velocity, "s", axis.max_velocity),
                   value(peaks.accel, "s2", axis.max_accel), value(peaks.jerk, "s3", axis.max_jerk));
    }
}

void print_json(const Plans& plans, const rack::RackConfig& config) {
    const auto planned = [](const Planned& one) {
        return nlohmann::json{{"duration_s", one.seconds}, {"stops", one.stops}};
    };
    nlohmann::json out = {{"program", plans.name},
                          {"rack", config.name},
                          {"moves", plans.moves},
                          {"stopping", planned(plans.stopping)},
                          {"trapezoids", planned(plans.trapezoids)},
                          {"jerk_limited", planned(plans.jerk_limited)},
                          {"bound", {{"duration_s", plans.jerk_limited.bound}}},
                          {"axes", nlohmann::json::object()}};
    for (const rack::RackAxis& axis : config.axes) {
        const AxisPeaks& peaks = plans.jerk_limited.axes[static_cast<std::size_t>(axis.index())];
        out["axes"][std::string(1, axis.letter)] = {{"unit", axis.unit()},
                                                    {"velocity", peaks.velocity},
                                                    {"accel", peaks.accel},
                                                    {"jerk", peaks.jerk},
                                                    {"of_velocity", part_of(peaks.velocity, axis.max_velocity)},
                                                    {"of_accel", part_of(peaks.accel, axis.max_accel)},
                                                    {"of_jerk", part_of(peaks.jerk, axis.max_jerk)}};
    }
    fmt::print("{}\n", out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

int plan(const PlanOptions& options) {
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    if (config->point_to_point())
        return report(
            {ErrorKind::refused, fmt::format("The axes of {} position one by one: the program has no path to plan. "
                                             "Give a rack whose axes follow paths together.",
                                             config->name)});
    const Result<ProgramText> program = load_program(options.program);
    if (!program) return report(program.error());
    auto reading = program_settings(*config, program->name, options.reading, code);
    if (!reading) return code;
    std::vector<std::string> inputs = {options.program, options.rack, options.reading.tools};
    note_subprograms(*reading, program->name, inputs);
    const control::gcode::Settings& settings = *reading;
    if (const int bad = print_problems(
            control::gcode::check_program(program->text, settings, max_problems, program->name), program->name);
        bad != exit_done)
        return bad;
    if (!may_write(inputs, {options.picture})) return exit_refused;
    std::vector<Move> moves;
    control::gcode::ProgramReader reader(program->text, settings, program->name);
    for (auto step = reader.next(); step && *step != nullptr; step = reader.next())
        if ((*step)->kind == control::gcode::CanonCallKind::move) moves.push_back((*step)->move);
    stop_on_signals();
    const control::MachineLimits limits = config->limits();
    const Plans plans{program->name, moves.size(), by_trapezoids(moves, limits, settings.start, true),
                      by_trapezoids(moves, limits, settings.start, false),
                      jerk_limited(moves, limits, settings.start, options.json)};
    if (stop_asked) return report({ErrorKind::stopped, "Stopped before the plan was complete; nothing was reported."});
    options.json ? print_json(plans, *config) : print_plans(plans, *config);
    if (options.picture.empty()) return exit_done;
    const std::string title = fmt::format("{}: {:.3f} s, trapezoids {:.3f} s", plans.name, plans.jerk_limited.seconds,
                                          plans.trapezoids.seconds);
    if (const Result<void> done =
            write_text(options.picture, rack::plan_picture(title, moves, *config, settings.start));
        !done)
        return report(done.error());
    if (!options.json) fmt::print("written: {}\n", options.picture);
    return exit_done;
}

}  // namespace

void add_plan(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<PlanOptions>();
    CLI::App* command = app.add_subcommand(
        "plan",
        "Print the duration of a part program: stopping at each move, by trapezoids, and jerk-limited; nothing moves");
    command->add_option("PROGRAM", options->program,
                        "part program, '-' for standard input (default: the built-in example)");
    command->add_option("--rack", options->rack, "rack file (default: the built-in router)");
    add_reading_options(*command, options->reading);
    command->add_option(
        "--picture", options->picture,
        "write the jerk-limited plan as SVG: the path coloured by velocity; velocity, acceleration and jerk over time");
    command->add_flag("--json", options->json, "print the plans as JSON");
    command->footer(
        "Example: motionrack plan part.ngc --rack my.toml --picture part.svg\nCards execute the trapezoids; with "
        "profile = \"jerk_limited\" in the rack file the jerk-limited plan, which also keeps the jerk limit of every "
        "axis.");
    command->callback([options, &chosen] { chosen = [options] { return plan(*options); }; });
}

}  // namespace motionrack::cli
