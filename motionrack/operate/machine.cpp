// Commands of a machine, and the states in which they are accepted.
#include <fmt/format.h>

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
      validity_(rack_),
      door_(rack_),
      manual_({.rack = rack_,
               .conditions = conditions_,
               .door = door_,
               .publisher = publisher_,
               .alarms = alarms_,
               .programs = programs_,
               .handover = handover_,
               .validity = validity_,
               .positions = positions_,
               .pending_stop = pending_stop_},
              {.jog_lease = settings_.jog_lease,
               .wall = settings_.wall ? settings_.wall : [this] { return now(); },
               .slice = settings_.slice}) {
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
        return fail(ErrorKind::refused,
                    fmt::format("A hold is not possible: the machine is in state '{}'. Nothing was changed.",
                                name_of(state())));
    programs_.stream().hold();
    return {};
}

Result<void> Machine::resume() {
    if (state() != MachineState::hold)
        return fail(ErrorKind::refused,
                    fmt::format("A resume is not possible: the machine is in state '{}'. Nothing was moved.",
                                name_of(state())));
    MOTIONRACK_CHECK(conditions_.may_begin("Not resumed"));
    door_.give_back_tools(publisher_.status());
    programs_.stream().resume();
    publisher_.enter(MachineState::moving);
    return {};
}

void Machine::stop(const StopOrigin& by) {
    const StopReport report = stop_report(now(), by, state(), publisher_.at_work());
    ordered_by_ = by.kind.empty() ? std::string() : report.text;
    rack_.stop_latch().stop();
    take_stop();
    publisher_.report_stop(report);
}

void Machine::cancel(const StopOrigin& by) {
    const StopReport report = stop_report(now(), by, state(), publisher_.at_work());
    programs_.drop();
    programs_.stream().stop();
    manual_.cancel();
    service_.break_off();
    door_.forget_tools();
    pending_stop_.request(idle(state()));
    if (!idle(state()) && state() != MachineState::stopping) publisher_.enter(MachineState::stopping);
    publisher_.report_stop(report);
}

void Machine::reset(const StopOrigin& by) {
    StopReport report = stop_report(now(), by, state(), publisher_.at_work());
    report.releases = idle(state());
    cancel();
    pending_stop_.request_reset(rack_.stop_latch().trips());
    publisher_.report_stop(report);
}

void Machine::set_coolant(bool mist, bool flood) {
    const bool switches_on = (mist && !status().mist) || (flood && !status().flood);
    if (switches_on && !conditions_.may_begin("The coolant was not switched on")) return;
    programs_.stream().set_coolant(mist, flood);
    door_.keep_coolant(mist, flood);
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
