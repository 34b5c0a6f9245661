// Commands, and the states in which they are accepted.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/operate/machine.hpp>
#include <utility>

namespace motionrack::operate {

namespace {

StopReport stop_report(Instant at, const StopOrigin& by, MachineState state, const std::string& at_work) {
    const std::string who = by.who.empty() ? "" : " by " + by.who;
    const std::string from = by.address.empty() ? "" : fmt::format(" ({})", by.address);
    const std::string what =
        idle(state) ? fmt::format("the machine was in state '{}'", name_of(state)) : at_work + " was stopped";
    return {at, by, state, fmt::format("{}{}{}: {}.", by.kind, who, from, what), false};
}

tl::unexpected<Error> not_now(std::string text) {
    return fail(ErrorKind::refused, std::move(text));
}

rack::RackConfig placed(rack::RackConfig config, const std::vector<InitialAxisState>& initial_axes) {
    for (const InitialAxisState& one : initial_axes)
        for (rack::RackAxis& axis : config.axes)
            if (axis.letter == one.letter) axis.initial_position = one.true_position;
    return config;
}

}  // namespace

Machine::Machine(const rack::RackConfig& config, MachineSettings settings)
    : settings_(std::move(settings)),
      rack_(placed(config, settings_.initial_axes)),
      context_(rack_),
      tap_(rack_.kernel()),
      probe_(rack_.kernel()),
      validity_(rack_),
      door_(rack_),
      jogs_(
          settings_.jog_lease, settings_.wall ? settings_.wall : [this] { return now(); }) {
    if (rack::grating_bus_of(rack_) != nullptr) frames_.emplace(rack_);
    rack_.input_log().keep_no_more();
}

Machine::~Machine() = default;

Result<std::unique_ptr<Machine>> Machine::make(const rack::RackConfig& config, MachineSettings settings) {
    MOTIONRACK_CHECK(check_live_places(config, settings.live));
    std::unique_ptr<Machine> machine(new Machine(config, std::move(settings)));
    MOTIONRACK_CHECK(machine->start(config));
    return machine;
}

void Machine::post(std::function<void()> work) {
    const std::lock_guard<std::mutex> alone(lock_);
    inbox_.push_back(std::move(work));
}

void Machine::quit() {
    post([this] {
        cancel(idle(state()) ? StopOrigin{} : StopOrigin{"", "", "Shutdown"});
        quit_ = true;
    });
}

// ---- commands

Result<void> Machine::enable(bool on, std::string_view axes) {
    for (const char letter : axes)
        MOTIONRACK_CHECK(axis_named(rack_.config(), on ? "Nothing was enabled" : "Nothing was disabled", letter));
    if (!on) cancel({"", "", "Disabling"});
    enables_.set(on, axes);
    if (on && state() == MachineState::disabled) publisher_.enter(MachineState::standstill);
    return {};
}

Result<void> Machine::begin_program(std::string text, std::string name) {
    MOTIONRACK_CHECK(conditions_.may_start("The program was not started"));
    MOTIONRACK_CHECK(conditions_.ready_for_lines("The program was not started"));
    MOTIONRACK_CHECK(programs_.begin(std::move(text), std::move(name)));
    publisher_.enter(MachineState::moving);
    return {};
}

control::gcode::Outcome<void> Machine::line(std::string_view text, std::int32_t number) {
    const auto refuse = [&](std::string why) {
        control::gcode::Problem problem;
        problem.kind = ErrorKind::refused;
        problem.message = std::move(why);
        problem.location.line = number;
        return tl::unexpected<control::gcode::Problem>(std::move(problem));
    };
    if (Result<void> can = rack::check_released(rack_.stop_latch(), "The line was not accepted"); !can)
        return refuse(can.error().message);
    if (Result<void> can = conditions_.may_start("The line was not accepted"); !can) return refuse(can.error().message);
    if (programs_.runs()) return refuse("The line was not accepted: a program runs. Stop it or wait for its end.");
    if (!programs_.has_room())
        return refuse("The line was not accepted: the queue is full until earlier lines are executed.");
    if (state() != MachineState::moving && state() != MachineState::hold)
        if (Result<void> can = conditions_.ready_for_lines("The line was not accepted"); !can)
            return refuse(can.error().message);
    if (auto read = programs_.line(text, number, now()); !read) return read;
    if (stream().has_work() && state() == MachineState::standstill) publisher_.enter(MachineState::moving);
    return {};
}

Result<void> Machine::hold() {
    if (state() != MachineState::moving)
        return not_now(fmt::format("A hold is not possible: the machine is in state '{}'. Nothing was changed.",
                                   name_of(state())));
    programs_.stream().hold();
    return {};
}

Result<void> Machine::resume() {
    if (state() != MachineState::hold)
        return not_now(fmt::format("A resume is not possible: the machine is in state '{}'. Nothing was moved.",
                                   name_of(state())));
    MOTIONRACK_CHECK(conditions_.may_begin("Not resumed"));
    door_.give_back_tools(publisher_.status());
    programs_.stream().resume();
    publisher_.enter(MachineState::moving);
    return {};
}

void Machine::stop(const StopOrigin& by) {
    const StopReport report = stop_report(now(), by, state(), at_work());
    ordered_by_ = by.kind.empty() ? std::string() : report.text;
    rack_.stop_latch().stop();
    take_stop();
    publisher_.report_stop(report);
}

void Machine::cancel(const StopOrigin& by) {
    const StopReport report = stop_report(now(), by, state(), at_work());
    programs_.drop();
    programs_.stream().stop();
    home_stop_ = true;
    home_wanted_.reset();
    jogs_.let_go();
    service_.break_off();
    door_.forget_tools();
    pending_stop_.request(idle(state()));
    if (!idle(state()) && state() != MachineState::stopping) publisher_.enter(MachineState::stopping);
    publisher_.report_stop(report);
}

void Machine::reset(const StopOrigin& by) {
    StopReport report = stop_report(now(), by, state(), at_work());
    report.releases = idle(state());
    cancel();
    pending_stop_.request_reset(rack_.stop_latch().trips());
    publisher_.report_stop(report);
}

namespace {

/// Checks the speed at the command; the axis would reject it only at the start of the jog, after the answer.
Result<void> check_jog_speed(const rack::RackAxis& axis, double speed) {
    if (std::fabs(speed) <= axis.max_velocity) return {};
    return not_now(
        fmt::format("Not jogged: the jog speed is {:g} {}/s; it must be at most {:g} for axis {}. Nothing was moved.",
                    std::fabs(speed), axis.unit(), axis.max_velocity, axis.letter));
}

}  // namespace

Result<void> Machine::jog(char axis, double speed, const JogOrigin& origin) {
    MOTIONRACK_CHECK(jogs_.accept(axis, origin));
    MOTIONRACK_CHECK(rack::check_released(rack_.stop_latch(), "Not jogged"));
    MOTIONRACK_CHECK(door_.check_closed("Not jogged"));
    if (state() != MachineState::jogging || programs_.stream().has_work())
        MOTIONRACK_CHECK(conditions_.ready("Not jogged"));
    MOTIONRACK_CHECK(conditions_.axes_may_move("Not jogged", {&axis, 1}));
    MOTIONRACK_TRY(const rack::RackAxis* found, axis_named(rack_.config(), "Not jogged", axis));
    if (!std::isfinite(speed)) return fail(ErrorKind::invalid_input, "Not jogged: the jog speed is not a number.");
    MOTIONRACK_CHECK(check_jog_speed(*found, speed));
    jogs_.hold(axis, speed, origin.session);
    publisher_.enter(MachineState::jogging);
    return {};
}

Result<void> Machine::jog_by(char axis, double distance, double speed) {
    MOTIONRACK_CHECK(conditions_.ready("Not jogged"));
    MOTIONRACK_CHECK(door_.check_closed("Not jogged"));
    MOTIONRACK_CHECK(conditions_.axes_may_move("Not jogged", {&axis, 1}));
    MOTIONRACK_TRY(const rack::RackAxis* found, axis_named(rack_.config(), "Not jogged", axis));
    if (!std::isfinite(distance) || !(speed > 0))
        return fail(ErrorKind::invalid_input,
                    fmt::format("Not jogged: {} by {} a second is not a motion.", distance, speed));
    MOTIONRACK_CHECK(check_jog_speed(*found, speed));
    const double travel = found->max_limit - found->min_limit;
    if (position_valid(*found) && std::fabs(distance) > travel)
        return not_now(
            fmt::format("Not jogged: the distance is {:g} {}, but the travel of axis {} is {:g}. Nothing "
                        "was moved.",
                        std::fabs(distance), found->unit(), axis, travel));
    jogs_.move(axis, distance, speed);
    publisher_.enter(MachineState::jogging);
    return {};
}

Result<void> Machine::jog_to(const control::Point& target, double speed) {
    MOTIONRACK_CHECK(rack::check_released(rack_.stop_latch(), "Not jogged"));
    if (state() != MachineState::jogging || !programs_.stream().has_work())
        MOTIONRACK_CHECK(conditions_.ready_for_lines("Not jogged"));
    if (!programs_.stream().has_room()) return not_now("Not jogged: the queue of jogs is full; wait for earlier jogs.");
    if (!std::isfinite(speed) || !(speed > 0))
        return fail(ErrorKind::invalid_input, fmt::format("Not jogged: a jog speed of {} is not a motion.", speed));
    const control::MachineLimits limits = rack_.config().limits();
    control::Move move;
    int moving = 0;
    for (std::size_t i = 0; i < target.size(); ++i) {
        const double from = programs_.stream().interpreter().position()[i], slack = control::gcode::limit_slack;
        if (target[i] == from) continue;
        if (!std::isfinite(target[i]) || !limits[i].present)
            return fail(ErrorKind::invalid_input,
                        fmt::format("Not jogged: the machine has no axis {}, or {} is not a position of it.",
                                    control::axis_letters[i], target[i]));
        if (target[i] < limits[i].min_position - slack || target[i] > limits[i].max_position + slack)
            return not_now(fmt::format("Not jogged: axis {} goes from {:.6g} to {:.6g}, not to {:.6g}.",
                                       control::axis_letters[i], limits[i].min_position, limits[i].max_position,
                                       target[i]));
        ++moving;
        move.rapid_override = std::min(move.rapid_override, speed / limits[i].max_velocity);
    }
    // Axes that position one by one cannot hold a common velocity along a line.
    move.kind = moving > 1 && rack_.config().point_to_point() ? control::MoveKind::rapid : control::MoveKind::feed;
    move.path = control::PathControl::continuous;
    move.tolerance_mm = rack_.config().controller.default_path_tolerance_mm;
    move.feed = speed;
    move.end = target;
    programs_.move(move, now());
    if (programs_.stream().has_work()) publisher_.enter(MachineState::jogging);
    return {};
}

Result<void> Machine::home(std::string axes) {
    std::string homed = axes;
    if (axes.empty())
        for (const rack::RackAxis& axis : rack_.config().axes)
            if (rack_.config().can_home(axis)) homed += axis.letter;
    MOTIONRACK_CHECK(conditions_.has_axes("Not homed"));
    MOTIONRACK_CHECK(conditions_.may_start("Not homed"));
    MOTIONRACK_CHECK(conditions_.ready("Not homed"));
    MOTIONRACK_CHECK(door_.check_closed("Not homed"));
    MOTIONRACK_CHECK(conditions_.axes_may_move("Not homed", homed));
    home_wanted_ = std::move(axes);
    home_stop_ = false;
    publisher_.enter(MachineState::homing);
    return {};
}

Result<void> Machine::set_position(char axis, double position) {
    MOTIONRACK_CHECK(conditions_.ready("The position was not set"));
    MOTIONRACK_CHECK(axis_named(rack_.config(), "The position was not set", axis));
    if (!std::isfinite(position))
        return fail(ErrorKind::invalid_input, "The position was not set: it is not a number.");
    positions_.request(axis, position);
    return {};
}

void Machine::set_coolant(bool mist, bool flood) {
    if (rack_.stop_latch().latched()) return;
    programs_.stream().set_coolant(mist, flood);
    publisher_.set_coolant(mist, flood);
}

void Machine::forbid_starts(std::string source, std::string text) {
    if (conditions_.forbids()) return;
    conditions_.forbid(text);
    if (state() == MachineState::moving && !programs_.stream().last_probe().runs)
        programs_.stream().hold();
    else if (!idle(state()) && state() != MachineState::hold)
        cancel({"", "", "Alarm"});
    alarms_.raise(std::move(source), std::move(text)).stays = true;
}

}  // namespace motionrack::operate
