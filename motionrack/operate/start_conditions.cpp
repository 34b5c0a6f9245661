// Checks before a start, and the messages of their refusals.
#include <fmt/format.h>

#include <motionrack/operate/axis_enables.hpp>
#include <motionrack/operate/door.hpp>
#include <motionrack/operate/manual_access.hpp>
#include <motionrack/operate/pending_stop.hpp>
#include <motionrack/operate/position_setter.hpp>
#include <motionrack/operate/position_validity.hpp>
#include <motionrack/operate/service.hpp>
#include <motionrack/operate/start_conditions.hpp>
#include <motionrack/operate/status_publisher.hpp>

namespace motionrack::operate {

Result<const rack::RackAxis*> axis_named(const rack::RackConfig& config, const char* what, char letter) {
    if (const rack::RackAxis* axis = config.axis(letter)) return axis;
    return fail(ErrorKind::invalid_input, fmt::format("{}: the machine has no axis {}.", what, letter));
}

Result<void> StartConditions::may_start(const char* what) const {
    if (!forbids()) return {};
    return fail(ErrorKind::refused, fmt::format("{}: {}", what, no_starts_));
}

Result<void> StartConditions::may_begin(const char* what) const {
    MOTIONRACK_CHECK(rack::check_released(sources_.rack.stop_latch(), what));
    MOTIONRACK_CHECK(may_start(what));
    return sources_.door.check_closed(what);
}

Result<void> StartConditions::has_axes(const char* what) const {
    if (!sources_.rack.config().axes.empty()) return {};
    return fail(
        ErrorKind::refused,
        fmt::format("{}: the rack has no axes. Nothing was moved; add an [axis.X] section to the rack file.", what));
}

Result<void> StartConditions::ready(const char* what) const {
    MOTIONRACK_CHECK(rack::check_released(sources_.rack.stop_latch(), what));
    const auto refuse = [&](const std::string& why) {
        return fail(ErrorKind::refused, fmt::format("{}: {}. Nothing was moved.", what, why));
    };
    const MachineState state = sources_.publisher.state();
    if (state == MachineState::disabled) return refuse("the machine is disabled; enable it first");
    if (state == MachineState::error_stop)
        return refuse("the machine is in error stop; see its alarm, remove the cause and reset it first");
    if (state == MachineState::service)
        return refuse(fmt::format("card {} is in service; end the service first", sources_.service.card()));
    if (state != MachineState::standstill)
        return refuse(fmt::format("the machine is in state '{}'; stop it, or wait for standstill", name_of(state)));
    if (sources_.pending_stop.wants_reset()) return refuse("a reset is being carried out; try again at once");
    if (sources_.manual_access.any()) return refuse("a card is being accessed; try again at once");
    if (const char letter = sources_.manual_access.moving_axis(); letter != '\0')
        return refuse(fmt::format("axis {} is moved by register writes; press STOP first", letter));
    return {};
}

Result<void> StartConditions::axes_may_move(const char* what, std::string_view axes) const {
    if (sources_.positions.any())
        return fail(ErrorKind::refused,
                    fmt::format("{}: positions of axes are being set; try again. Nothing was moved.", what));
    for (const rack::RackAxis& axis : sources_.rack.config().axes)
        if (axes.find(axis.letter) != std::string_view::npos && !sources_.enables.may_move(axis))
            return fail(ErrorKind::refused,
                        fmt::format("{}: axis {} is disabled; enable it first. Nothing was moved.", what, axis.letter));
    return {};
}

Result<void> StartConditions::ready_for_lines(const char* what) const {
    MOTIONRACK_CHECK(has_axes(what));
    MOTIONRACK_CHECK(ready(what));
    MOTIONRACK_CHECK(sources_.door.check_closed(what));
    MOTIONRACK_CHECK(axes_may_move(what, {control::axis_letters.data(), control::axis_letters.size()}));
    for (const rack::RackAxis& axis : sources_.rack.config().axes)
        if (!sources_.validity.of(axis.letter))
            return fail(ErrorKind::refused,
                        fmt::format("{}: the position of axis {} is not valid. Home it, or set its position. Nothing "
                                    "was moved.",
                                    what, axis.letter));
    return {};
}

bool StartConditions::has_pending() const {
    return sources_.pending_stop.wanted() || sources_.positions.any();
}

}  // namespace motionrack::operate
