// Values of faults: one row per fault of each kind of part and card.
#include <algorithm>
#include <cmath>
#include <motionrack/rack/faults.hpp>
#include <span>

namespace motionrack::rack {

namespace {

/// Target of a fault: the part, whose settings may determine the limits.
struct FaultyPart {
    const RunningAxis* axis = nullptr;
    const RackCard* card = nullptr;
    const RunningConveyor* track = nullptr;
};

struct FaultRow {
    std::string_view name;
    double min, max;
    std::string_view unit, doc;
    double (*max_of)(const FaultyPart& part) = nullptr;  ///< replaces max; may be nullptr
};

constexpr double max_factor = 1000, max_levels = 1e6, max_delay_s = 1, max_ppm = 1e5;

double counts_per_turn(const FaultyPart& part) {
    return static_cast<double>(part.axis->config.encoder_counts_per_rev);
}
double dirty_lines(const FaultyPart& part) {
    return std::floor((counts_per_turn(part) - 1) / 4);
}
double off_centre(const FaultyPart& part) {
    return counts_per_turn(part) / 7;
}
double track_velocity_limit(const FaultyPart& part) {
    return part.track->config.max_velocity();
}
/// The switch back to the profile has no number of its own; it is checked like a velocity.
double track_profile_limit(const FaultyPart& part) {
    return std::min(1.0, track_velocity_limit(part));
}
/// Less than half a period, in steps of 0.1 ns.
double frame_jitter_limit(const FaultyPart& part) {
    return std::min(part.card->grating_bus.period_us * 500 - 0.1, max_push);
}

constexpr FaultRow stepper_faults[] = {
    {"motor.stall", 0, 1, "", "1: the axle is blocked; 0 releases it"},
    {"motor.lose_steps", -max_push, max_push, "pulses",
     "pulses by which the rotor falls back, rounded to whole electrical cycles"},
    {"motor.push", -max_push, max_push, "microsteps", "microsteps by which the rotor is pushed, approximate"},
};
constexpr FaultRow servo_faults[] = {
    {"motor.stall", 0, 1, "", "1: the axle is blocked; 0 releases it"},
    {"motor.push", -max_push, max_push, "microsteps", "microsteps by which the rotor is pushed, approximate"},
    {"motor.load", 0, max_factor, "", "ratio of the load to the motor's own inertia"},
};
constexpr FaultRow axis_faults[] = {
    {"encoder.broken_a", 0, 1, "", "1: track A reads Low; 0 repairs it"},
    {"encoder.broken_b", 0, 1, "", "1: track B reads Low; 0 repairs it"},
    {"encoder.swapped", 0, 1, "", "1: the tracks are swapped; 0 repairs it"},
    {"encoder.inverted_a", 0, 1, "", "1: track A is inverted; 0 repairs it"},
    {"encoder.inverted_b", 0, 1, "", "1: track B is inverted; 0 repairs it"},
    {"encoder.noise", 0, max_levels, "levels", "number of wrong levels from now on, 0.5 to 10 us each"},
    {"encoder.jitter", 0, max_delay_s, "s", "maximum delay of the edges"},
    {"encoder.dirt", 0, 0, "lines", "number of adjacent dirty lines of the disc, which are not read", dirty_lines},
    {"encoder.overspeed", 0, max_push, "1/s", "edge rate (1 or more) above which lines are lost; 0 repairs it"},
    {"encoder.eccentricity", 0, 0, "counts", "eccentricity of the disc", off_centre},
    {"limit_minus.stuck_open", 0, 1, "", "1: the switch never acts; 0 repairs it"},
    {"limit_minus.stuck_closed", 0, 1, "", "1: the switch always acts; 0 repairs it"},
    {"limit_plus.stuck_open", 0, 1, "", "1: the switch never acts; 0 repairs it"},
    {"limit_plus.stuck_closed", 0, 1, "", "1: the switch always acts; 0 repairs it"},
    {"home.stuck_open", 0, 1, "", "1: the switch never acts; 0 repairs it"},
    {"home.stuck_closed", 0, 1, "", "1: the switch always acts; 0 repairs it"},
};
constexpr FaultRow stage_faults_table[] = {
    {"motor.stall", 0, 1, "", "1: the stage is blocked; 0 releases it"},
    {"motor.push", -max_push, max_push, "nm", "distance by which the stage is pushed, at most to its hard stops"},
    {"motor.friction", 0, max_factor, "m/s2", "deceleration by added friction"},
    {"motor.load", 0, max_factor, "", "ratio of the load to the mass of the stage"},
    {"scale.lose", -max_push, max_push, "counts", "number of counts that are lost at once"},
    {"scale.dirt", 0, max_push, "nm", "length of the dirty part of the grating, which is not read"},
    {"scale.swapped", 0, 1, "", "1: the lines are swapped: the scale counts backwards; 0 repairs it"},
    {"scale.expansion", -max_ppm, max_ppm, "ppm", "expansion of the grating"},
};
constexpr FaultRow track_faults[] = {
    {"drive.speed", 0, 0, "/s", "velocity from now on, mm/s or degrees/s; 0: standstill", track_velocity_limit},
    {"drive.profile", 0, 1, "", "1: back to the profile of the rack file", track_profile_limit},
    {"encoder.broken_a", 0, 2, "", "1: track A reads Low, 2: High; 0 repairs it"},
    {"encoder.broken_b", 0, 2, "", "1: track B reads Low, 2: High; 0 repairs it"},
    {"encoder.swapped", 0, 1, "", "1: the tracks are swapped; 0 repairs it"},
    {"encoder.inverted_a", 0, 1, "", "1: track A is inverted; 0 repairs it"},
    {"encoder.inverted_b", 0, 1, "", "1: track B is inverted; 0 repairs it"},
    {"encoder.noise", 0, max_levels, "levels", "number of wrong levels from now on, 0.5 to 10 us each"},
    {"encoder.jitter", 0, max_delay_s, "s", "maximum delay of the edges"},
    {"sender.silent", 0, 1, "", "1: the sender is silent; 0 repairs it"},
};
constexpr FaultRow card_faults[] = {
    {"watchdog.hang", 0, 1, "", "1: the firmware hangs until the watchdog restarts it"},
    {"esl.broken", 0, 1, "", "1: the wire of the limit switch on the left is broken; 0 repairs it"},
    {"esr.broken", 0, 1, "", "1: the wire of the limit switch on the right is broken; 0 repairs it"},
    {"ems.broken", 0, 1, "", "1: the wire of the emergency stop is broken; 0 repairs it"},
    {"ref.broken", 0, 1, "", "1: the wire of the reference switch is broken; 0 repairs it"},
    {"off", 0, 1, "", "1: the card has no power; 0: power returns, the card is reset"},
    {"reset", 0, 1, "", "1: the card is reset"},
    {"late", 0, max_push, "ns", "delay of the frames of the slave"},
    {"miss_edge", 0, max_push, "edges", "number of the next edges of HOLD that the slave misses"},
    {"jitter", 0, 0, "ns", "maximum delay of the host's frames", frame_jitter_limit},
    {"no_latch", 0, 1, "", "1: the decoder does not latch its counts; 0 repairs it"},
};

const FaultRow* find_fault_row(std::span<const FaultRow> rows, std::string_view name) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const FaultRow& row) { return row.name == name; });
    return found == rows.end() ? nullptr : &*found;
}

const FaultRow* row_of(const FaultyPart& part, std::string_view name) {
    if (part.card != nullptr) return find_fault_row(card_faults, name);
    if (part.track != nullptr) return find_fault_row(track_faults, name);
    if (part.axis == nullptr) return find_fault_row(stage_faults_table, name);
    const std::span<const FaultRow> motor =
        part.axis->servo ? std::span<const FaultRow>(servo_faults) : std::span<const FaultRow>(stepper_faults);
    const FaultRow* row = find_fault_row(motor, name);
    return row != nullptr ? row : find_fault_row(axis_faults, name);
}

FaultyPart part_of(Rack& rack, const std::string& target) {
    FaultyPart out;
    for (const RunningAxis& axis : rack.axes())
        if (target == std::string(1, axis.config.letter)) return out.axis = &axis, out;
    out.track = rack.track(target);
    out.card = out.track == nullptr && rack.card(target) != nullptr ? rack.config().card(target) : nullptr;
    return out;
}

}  // namespace

std::vector<FaultValue> fault_values(Rack& rack) {
    std::vector<FaultValue> out;
    for (const FaultTarget& target : fault_targets(rack)) {
        const FaultyPart part = part_of(rack, target.name);
        for (const std::string_view name : target.faults) {
            const FaultRow* row = row_of(part, name);
            MOTIONRACK_ASSERT(row != nullptr);  // a test covers all rows
            FaultValue& one = out.emplace_back(
                FaultValue{target.name, row->name, std::string(row->unit), row->doc, row->min, row->max});
            if (row->max_of != nullptr) one.max = row->max_of(part);
            if (row->max_of != track_velocity_limit) continue;
            one.min = -one.max;
            one.unit = std::string(part.track->config.unit()) + one.unit;
        }
    }
    return out;
}

}  // namespace motionrack::rack
