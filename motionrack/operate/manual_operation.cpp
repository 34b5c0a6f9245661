// Commands of manual operation, and their steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/operate/alarm_list.hpp>
#include <motionrack/operate/axis_handover.hpp>
#include <motionrack/operate/door.hpp>
#include <motionrack/operate/manual_operation.hpp>
#include <motionrack/operate/pending_stop.hpp>
#include <motionrack/operate/position_setter.hpp>
#include <motionrack/operate/position_validity.hpp>
#include <motionrack/operate/program_run.hpp>
#include <motionrack/operate/start_conditions.hpp>
#include <motionrack/operate/status_publisher.hpp>
#include <utility>

namespace motionrack::operate {

ManualOperation::ManualOperation(const ManualParts& parts, ManualTimes times)
    : parts_(parts), slice_(times.slice), jogs_(times.jog_lease, std::move(times.wall)) {}

namespace {

/// Checks the jog speed at the command; the axis would reject it only at the start of the jog, after the answer.
Result<void> check_jog_speed(const rack::RackAxis& axis, double speed) {
    if (std::fabs(speed) <= axis.max_velocity) return {};
    return fail(
        ErrorKind::refused,
        fmt::format("Not jogged: the jog speed is {:g} {}/s; it must be at most {:g} for axis {}. Nothing was moved.",
                    std::fabs(speed), axis.unit(), axis.max_velocity, axis.letter));
}

}  // namespace

// ---- commands

Result<void> ManualOperation::jog(char axis, double speed, const JogOrigin& origin) {
    MOTIONRACK_CHECK(jogs_.accept(axis, origin));
    MOTIONRACK_CHECK(rack::check_released(parts_.rack.stop_latch(), "Not jogged"));
    MOTIONRACK_CHECK(parts_.door.check_closed("Not jogged"));
    if (parts_.publisher.state() != MachineState::jogging || parts_.programs.stream().has_work())
        MOTIONRACK_CHECK(parts_.conditions.ready("Not jogged"));
    MOTIONRACK_CHECK(parts_.conditions.axes_may_move("Not jogged", {&axis, 1}));
    MOTIONRACK_TRY(const rack::RackAxis* found, axis_named(parts_.rack.config(), "Not jogged", axis));
    if (!std::isfinite(speed)) return fail(ErrorKind::invalid_input, "Not jogged: the jog speed is not a number.");
    MOTIONRACK_CHECK(check_jog_speed(*found, speed));
    jogs_.hold(axis, speed, origin.session);
    parts_.publisher.enter(MachineState::jogging);
    return {};
}

Result<void> ManualOperation::jog_by(char axis, double distance, double speed) {
    MOTIONRACK_CHECK(parts_.conditions.ready("Not jogged"));
    MOTIONRACK_CHECK(parts_.door.check_closed("Not jogged"));
    MOTIONRACK_CHECK(parts_.conditions.axes_may_move("Not jogged", {&axis, 1}));
    MOTIONRACK_TRY(const rack::RackAxis* found, axis_named(parts_.rack.config(), "Not jogged", axis));
    if (!std::isfinite(distance) || !(speed > 0))
        return fail(ErrorKind::invalid_input,
                    fmt::format("Not jogged: {} by {} a second is not a motion.", distance, speed));
    MOTIONRACK_CHECK(check_jog_speed(*found, speed));
    const double travel = found->max_limit - found->min_limit;
    if (parts_.validity.of(axis) && std::fabs(distance) > travel)
        return fail(ErrorKind::refused,
                    fmt::format("Not jogged: the distance is {:g} {}, but the travel of axis {} is {:g}. Nothing "
                                "was moved.",
                                std::fabs(distance), found->unit(), axis, travel));
    jogs_.move(axis, distance, speed);
    parts_.publisher.enter(MachineState::jogging);
    return {};
}

Result<void> ManualOperation::jog_to(const control::Point& target, double speed) {
    MOTIONRACK_CHECK(rack::check_released(parts_.rack.stop_latch(), "Not jogged"));
    if (parts_.publisher.state() != MachineState::jogging || !parts_.programs.stream().has_work())
        MOTIONRACK_CHECK(parts_.conditions.ready_for_lines("Not jogged"));
    if (!parts_.programs.stream().has_room())
        return fail(ErrorKind::refused, "Not jogged: the queue of jogs is full; wait for earlier jogs.");
    if (!std::isfinite(speed) || !(speed > 0))
        return fail(ErrorKind::invalid_input, fmt::format("Not jogged: a jog speed of {} is not a motion.", speed));
    const control::MachineLimits limits = parts_.rack.config().limits();
    control::Move move;
    int moving = 0;
    for (std::size_t i = 0; i < target.size(); ++i) {
        const double from = parts_.programs.stream().interpreter().position()[i], slack = control::gcode::limit_slack;
        if (target[i] == from) continue;
        if (!std::isfinite(target[i]) || !limits[i].present)
            return fail(ErrorKind::invalid_input,
                        fmt::format("Not jogged: the machine has no axis {}, or {} is not a position of it.",
                                    control::axis_letters[i], target[i]));
        if (target[i] < limits[i].min_position - slack || target[i] > limits[i].max_position + slack)
            return fail(
                ErrorKind::refused,
                fmt::format("Not jogged: axis {} goes from {:.6g} to {:.6g}, not to {:.6g}.", control::axis_letters[i],
                            limits[i].min_position, limits[i].max_position, target[i]));
        ++moving;
        move.rapid_override = std::min(move.rapid_override, speed / limits[i].max_velocity);
    }
    // Axes that position one by one cannot hold a common velocity along a line.
    move.kind =
        moving > 1 && parts_.rack.config().point_to_point() ? control::MoveKind::rapid : control::MoveKind::feed;
    move.path = control::PathControl::continuous;
    move.tolerance_mm = parts_.rack.config().controller.default_path_tolerance_mm;
    move.feed = speed;
    move.end = target;
    parts_.programs.move(move, parts_.rack.kernel().now());
    if (parts_.programs.stream().has_work()) parts_.publisher.enter(MachineState::jogging);
    return {};
}

Result<void> ManualOperation::home(std::string axes) {
    std::string homed = axes;
    if (axes.empty())
        for (const rack::RackAxis& axis : parts_.rack.config().axes)
            if (parts_.rack.config().can_home(axis)) homed += axis.letter;
    MOTIONRACK_CHECK(parts_.conditions.has_axes("Not homed"));
    MOTIONRACK_CHECK(parts_.conditions.may_start("Not homed"));
    MOTIONRACK_CHECK(parts_.conditions.ready("Not homed"));
    MOTIONRACK_CHECK(parts_.door.check_closed("Not homed"));
    MOTIONRACK_CHECK(parts_.conditions.axes_may_move("Not homed", homed));
    home_wanted_ = std::move(axes);
    home_stop_ = false;
    parts_.publisher.enter(MachineState::homing);
    return {};
}

Result<void> ManualOperation::set_position(char axis, double position) {
    MOTIONRACK_CHECK(parts_.conditions.ready("The position was not set"));
    MOTIONRACK_CHECK(axis_named(parts_.rack.config(), "The position was not set", axis));
    if (!std::isfinite(position))
        return fail(ErrorKind::invalid_input, "The position was not set: it is not a number.");
    parts_.positions.request(axis, position);
    return {};
}

void ManualOperation::cancel() {
    home_stop_ = true;
    home_wanted_.reset();
    jogs_.let_go();
}

// ---- steps

void ManualOperation::step_jogs(const std::function<void(const Error&)>& failed) {
    const auto take = [this](char letter) { return parts_.handover.take_axis(letter); };
    const auto stops = [this](char letter) {
        return parts_.pending_stop.wanted() || parts_.rack.stop_latch().is_to_brake(letter);
    };
    for (const Jogs::Ended& one : jogs_.step(take, parts_.rack.kernel().now(), stops)) {
        if (one.how) continue;
        parts_.publisher.status().reason = one.how.error().message;
        if (one.position_valid || !parts_.validity.of(one.letter)) continue;
        parts_.validity.invalidate(one.letter);  // it stopped without a ramp, or has lost its counts
        parts_.alarms.supersede({&one.letter, 1});
        parts_.pending_stop.request();
        failed(one.how.error());
    }
    if (jogs_.any()) return host_of(parts_.rack).pass(slice_);
    if (Result<void> taken = parts_.handover.take_group(); !taken) return failed(taken.error());
    if (jogs_.any()) return;  // commanded while the axes were handed over
    if (parts_.publisher.state() == MachineState::jogging)
        parts_.publisher.enter(MachineState::standstill, std::exchange(parts_.publisher.status().reason, {}));
}

Result<void> ManualOperation::step_homing() {
    rack::HomingSettings settings;
    settings.axes = *std::exchange(home_wanted_, std::nullopt);
    settings.stop = &home_stop_;
    settings.progress = [this](const rack::HomingProgress& progress) {
        parts_.publisher.status().homing = progress.states;
    };
    settings.seen_indexes = &seen_indexes_;
    settings.on_homed = [this](char letter, Instant since) { parts_.validity.begin_at_home(letter, since); };
    parts_.handover.release();
    const rack::HomingOutcome& homed = homed_.emplace(rack::home_axes(parts_.rack, settings));
    for (const rack::HomedAxis& axis : homed.axes)
        if (axis.begun && !axis.outcome.homed) parts_.validity.invalidate(axis.letter);
    MOTIONRACK_CHECK(parts_.handover.take_group());
    if (!homed.ended && homed.ended.error().kind == ErrorKind::machine) return homed.ended;
    if (parts_.publisher.state() == MachineState::homing)
        parts_.publisher.enter(MachineState::standstill, homed.ended ? "" : homed.ended.error().message);
    return {};
}

}  // namespace motionrack::operate
