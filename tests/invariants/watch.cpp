// Takes the Sights of racks and machines.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tests/invariants/watch.hpp>
#include <utility>

namespace motionrack::test {

namespace {

std::vector<AxisFacts> facts_of(rack::Rack& rack) {
    std::vector<AxisFacts> out;
    for (const rack::RunningAxis& axis : rack.axes()) {
        const rack::RackAxis& config = axis.config;
        out.push_back({config.letter, axis.servo != nullptr, config.pulses_per_unit(), config.max_velocity,
                       config.max_accel, config.max_velocity_step, config.min_limit, config.max_limit,
                       config.following_alarm()});
    }
    return out;
}

/// Up to four sections of a jerk-limited path, each of at most 10 ms, are ahead of the axes. The deceleration changes
/// within the jerk limit.
Invariants::Settings settings_of(const rack::RackConfig& config, Duration slice, const LimitFactors& known) {
    Invariants::Settings out;
    out.known = known;
    for (const rack::RackAxis& axis : config.axes)
        if (config.jerk_limited() && axis.max_jerk > 0)
            out.jerk_time_s = std::max(out.jerk_time_s, axis.max_accel / axis.max_jerk);
    out.obeyed = slice + milliseconds(10);
    if (config.jerk_limited()) out.obeyed += milliseconds(40) + from_seconds(out.jerk_time_s);
    return out;
}

}  // namespace

void fail_test(const Finding& finding) {
    ADD_FAILURE() << fmt::format("at {:.6f} s: {}: {}", to_seconds(finding.at), name_of(finding.rule), finding.text);
}

RackWatch::RackWatch(rack::Rack& rack, Duration slice, Invariants::Report report, const LimitFactors& known)
    : rack_(rack), invariants_(facts_of(rack), settings_of(rack.config(), slice, known), std::move(report)) {
    for (const rack::RackCard& card : rack.config().cards)
        if (card.type == "rtc5") lasers_.push_back(rack.kernel().find_wire(card.name + ".laser_on"));
}

Sight RackWatch::sight() {
    const Instant now = rack_.kernel().now();
    Sight out;
    out.at = now;
    const rack::StopLatch& latch = rack_.stop_latch();
    out.latched = latch.latched();
    out.stopped_at = latch.at();
    out.abrupt = latch.latched() && latch.tripped_by(rack::StopSource::emergency_stop);
    for (const sim::WireId laser : lasers_) out.lasers_on += rack_.kernel().level(laser) != 0;
    for (const rack::RunningConveyor& track : rack_.tracks())
        out.belt_velocity += std::fabs(track.track().velocity(to_seconds(now)));
    for (rack::RunningAxis& axis : rack_.axes()) {
        AxisSight& one = out.axes.emplace_back();
        one.sent = axis.turned_by().count(now);
        one.driven = axis.servo == nullptr && axis.turned_by().rate(now) != 0;
        one.counter = axis.card->pulse_counter(axis.channel);
        one.commanded = static_cast<double>(one.counter) / axis.config.pulses_per_unit();
        one.true_position = axis.machine->position(now);
    }
    return out;
}

void RackWatch::poll() {
    Sight now = sight();
    now.sequence = ++sequence_;
    now.state = operate::MachineState::homing;  // any motion is allowed
    invariants_.see(now);
}

MachineWatch::MachineWatch(operate::Machine& machine, Invariants::Report report)
    : RackWatch(machine.rack(), milliseconds(2), std::move(report)) {
    machine.listen([this, &machine](const operate::Status& status) {
        see(status, machine.manual_access().moving_axis() != '\0');
    });
}

void MachineWatch::see(const operate::Status& status, bool by_writes) {
    Sight now = sight();
    now.by_writes = by_writes;
    now.at = status.at;
    now.sequence = status.sequence;
    now.state = status.state;
    now.alarms = &status.alarms;
    for (std::size_t i = 0; i < now.axes.size(); ++i) {
        now.axes[i].enabled = status.axes[i].enabled;
        now.axes[i].position_valid = status.axes[i].position_valid;
        now.axes[i].commanded = status.axes[i].commanded;
        now.axes[i].true_position = status.axes[i].true_position;
        now.axes[i].counter = status.axes[i].pulses;
    }
    invariants_.see(now);
}

}  // namespace motionrack::test
