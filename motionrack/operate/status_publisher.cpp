// Collects the parts of a status and calls the listeners.
#include <fmt/format.h>

#include <motionrack/operate/axis_enables.hpp>
#include <motionrack/operate/position_validity.hpp>
#include <motionrack/operate/program_run.hpp>
#include <motionrack/operate/service.hpp>
#include <motionrack/operate/status_publisher.hpp>
#include <utility>

namespace motionrack::operate {

StatusPublisher::StatusPublisher(const StatusSources& sources, std::function<void(const Status&)> first)
    : sources_(sources) {
    if (first) listeners_.push_back(std::move(first));
}

void StatusPublisher::listen(std::function<void(const Status&)> call, std::function<void(const StopReport&)> on_stop) {
    listeners_.push_back(std::move(call));
    if (on_stop) stop_listeners_.push_back(std::move(on_stop));
}

void StatusPublisher::enter(MachineState state, std::string reason) {
    state_ = state;
    status_.reason = std::move(reason);
}

std::string StatusPublisher::at_work() const {
    const ProgramRun& programs = sources_.programs;
    if (programs.runs()) return fmt::format("{}, line {}", programs.name(), programs.stream().current_line());
    if (sources_.service.on()) return "the service of card " + sources_.service.card();
    if (state_ == MachineState::moving || state_ == MachineState::hold)
        return fmt::format("line {}", programs.stream().current_line());
    return state_ == MachineState::homing ? "homing" : state_ == MachineState::jogging ? "jog" : "machine";
}

// ---- spindle and coolant

void StatusPublisher::pass_event(const control::gcode::CanonCall& event) {
    using Kind = control::gcode::CanonCallKind;
    if (event.kind == Kind::spindle_speed || event.kind == Kind::spindle) status_.spindle_rpm = event.speed_rpm;
    if (event.kind == Kind::spindle) status_.spindle = event.spindle;
    if (event.kind == Kind::coolant) set_coolant(event.mist, event.flood);
    if (event.kind == Kind::end) tools_off();
}

void StatusPublisher::set_coolant(bool mist, bool flood) {
    status_.mist = mist;
    status_.flood = flood;
}

void StatusPublisher::tools_off() {
    status_.spindle = control::gcode::Spindle::off;
    set_coolant(false, false);
}

// ---- listeners

static AxisStatus look_at(rack::RunningAxis& axis, bool position_valid, bool enabled, Instant now) {
    AxisStatus out{.letter = axis.config.letter, .position_valid = position_valid, .enabled = enabled};
    out.rotary = axis.config.index() >= 3;
    out.pulses = axis.card->pulse_counter(axis.channel);
    out.counts = axis.card->encoder_counter(axis.channel);
    const double origin = axis.card->counter_origin();
    out.commanded = origin + static_cast<double>(out.pulses) / axis.config.pulses_per_unit();
    const double counts = axis.config.counts_per_unit();
    out.actual = counts > 0 ? origin + static_cast<double>(out.counts) / counts : out.commanded;
    out.true_position = axis.machine->position(now);
    out.velocity = axis.velocity(now);
    return out;
}

void StatusPublisher::publish() {
    const Instant now = sources_.rack.kernel().now();
    status_.at = now;
    ++status_.sequence;
    status_.state = state_;
    status_.axes.clear();
    for (rack::RunningAxis& axis : sources_.rack.axes()) {
        const bool valid = sources_.validity.of(axis.config.letter), enabled = sources_.enables.of(axis.config);
        status_.axes.push_back(look_at(axis, valid, enabled, now));
    }
    sources_.programs.report(status_);
    status_.service = sources_.service.card();
    status_.real = sources_.service.live() != nullptr;
    for (const auto& call : listeners_) call(status_);
}

void StatusPublisher::report_stop(const StopReport& report) {
    if (report.source.kind.empty()) return;
    std::string& reason = status_.reason;
    if (!idle(report.state) && (report.state != MachineState::stopping || reason.empty())) reason = report.text;
    for (const auto& call : stop_listeners_) call(report);
}

}  // namespace motionrack::operate
