// Start of a machine: initial axis positions, executor, stop latch, initial alarm.
#include <algorithm>
#include <motionrack/operate/machine.hpp>

namespace motionrack::operate {

bool can_home(const rack::RackConfig& config) {
    return std::any_of(config.axes.begin(), config.axes.end(),
                       [&](const rack::RackAxis& axis) { return config.can_home(axis); });
}

namespace {

/// Returns the initial state of an axis: the reported one, or the rack file's position, which is valid if `known`.
InitialAxisState standing_of(const rack::RackAxis& axis, const std::vector<InitialAxisState>& reported, bool known) {
    for (const InitialAxisState& one : reported)
        if (one.letter == axis.letter) return one;
    return {axis.letter, axis.initial_position, axis.initial_position, known};
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
    MOTIONRACK_CHECK(handover_.start(config));
    programs_.stream().on_event([this](const control::gcode::CanonCall& event, std::int64_t) {
        publisher_.pass_event(event);
        if (door_.keep_event(event)) publisher_.tools_off();
        if (settings_.on_event) settings_.on_event(event);
    });
    rack_.on_slice(settings_.slice, [this] { slice(); });
    rack_.stop_latch().arm();
    if (!settings_.alarm.empty()) alarms_.raise("last run", settings_.alarm);
    publisher_.publish();
    return {};
}

}  // namespace motionrack::operate
