// Start of the machine, and the driver that has its axes.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/job.hpp>

namespace motionrack::operate {

bool can_home(const rack::RackConfig& config) {
    return std::any_of(config.axes.begin(), config.axes.end(),
                       [&](const rack::RackAxis& axis) { return config.can_home(axis); });
}

namespace {

/// Returns the initial state of an axis. `known`: the position cannot be found by homing.
InitialAxisState standing_of(const rack::RackAxis& axis, const std::vector<InitialAxisState>& reported, bool known) {
    for (const InitialAxisState& one : reported)
        if (one.letter == axis.letter) return one;
    return {axis.letter, axis.initial_position, axis.initial_position, known};
}

Result<control::AxisGroup*> path_group(rack::Rack& rack, control::NoAxes& none) {
    if (rack.axes().empty()) return &none;
    return rack.path_axes_here();
}

}  // namespace

Result<void> Machine::start(const rack::RackConfig& config) {
    rack_.start();
    const bool known = !can_home(rack_.config());
    for (rack::RunningAxis& axis : rack_.axes()) {
        MOTIONRACK_TRY(control::Axis * one, axis.card->axis(rack_.config(), axis.config.letter));
        const InitialAxisState here = standing_of(axis.config, settings_.initial_axes, known);
        if (here.position_valid)
            MOTIONRACK_CHECK(validity_.take(*one, validity_.declared(here.letter, here.commanded)));
    }
    MOTIONRACK_TRY(control::AxisGroup * group, path_group(rack_, no_axes_));
    control::StreamExecutorSettings settings;
    settings.gcode = rack::reader_settings(config);
    settings.gcode.start = group->commanded_position();
    settings.accel_reserve = rack::accel_reserve_of(rack_);
    settings.jerk_limited = config.jerk_limited();
    programs_.start(*group, host_of(rack_), settings);
    programs_.stream().on_event([this](const control::gcode::CanonCall& event, std::int64_t) {
        publisher_.pass_event(event);
        if (settings_.on_event) settings_.on_event(event);
    });
    group_holds_ = true;
    rack_.set_stop_flag(programs_.stream().stop_flag());
    rack_.on_slice(settings_.slice, [this] { slice(); });
    rack_.stop_latch().arm();
    if (!settings_.alarm.empty()) alarms_.raise(now(), "last run", settings_.alarm);
    publisher_.publish();
    return {};
}

Result<void> Machine::take_group() {
    if (group_holds_) return {};
    hands_over_ = true;
    const Result<control::AxisGroup*> group = path_group(rack_, no_axes_);
    hands_over_ = false;
    if (!group) return tl::unexpected<Error>(group.error());
    rack_.set_stop_flag(programs_.stream().stop_flag());
    programs_.stream().resync_axes(**group);
    group_holds_ = true;
    return {};
}

Result<control::Axis*> Machine::take_axis(char letter) {
    for (rack::RunningAxis& axis : rack_.axes()) {
        if (axis.config.letter != letter) continue;
        group_holds_ = false;
        hands_over_ = true;
        Result<control::Axis*> taken = axis.card->axis(rack_.config(), letter);
        hands_over_ = false;
        return taken;
    }
    return fail(ErrorKind::invalid_input, fmt::format("The machine has no axis {}.", letter));
}

}  // namespace motionrack::operate
