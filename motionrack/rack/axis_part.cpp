// An axis as a part: its quantities, how its position is set by a push of the motor, its faults, and its signals.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/table_part.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

double rotor_pulses(RunningAxis& axis, Instant now) {
    return static_cast<double>(axis.machine->rotor().count(now));
}

constexpr std::array<QuantityRow<RunningAxis>, 13> axis_quantities = {{
    {"position_{u}", "the true position of the table",
     [](RunningAxis& axis, Instant now) { return axis.machine->position(now); }, ValueKind::measures},
    {"speed_{u}_s", "velocity of the table by the rotor, signed",
     [](RunningAxis& axis, Instant now) { return axis.velocity(now); }, ValueKind::measures},
    {"position_pulses", "the rotor in microsteps since the start", rotor_pulses, ValueKind::whole},
    {"position_counts", "counts of its encoder since the start",
     [](RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->encoder().count(now)); },
     ValueKind::whole, [](const RunningAxis& axis) { return axis.machine->has_encoder(); }},
    {"pulses", "pulses that came to the motor, + less -",
     [](RunningAxis& axis, Instant now) {
         return rotor_pulses(axis, now) + static_cast<double>(axis.machine->lost_steps(now));
     },
     ValueKind::whole},
    {"lost_pulses", "pulses that the rotor did not follow",
     [](RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->lost_steps(now)); },
     ValueKind::whole},
    {"in_step", "1 while the rotor follows the pulses, else 0",
     [](RunningAxis& axis, Instant) { return axis.machine->in_step() ? 1.0 : 0.0; }, ValueKind::yes_no},
    {"top_speed_{u}_s", "the peak velocity so far",
     [](RunningAxis& axis, Instant) { return axis.machine->peak_velocity(); }, ValueKind::measures},
    {"limit_minus", "1 while the machine is at that switch, independent of its wire",
     [](RunningAxis& axis, Instant) { return axis.machine->switches().limit_minus().active() ? 1.0 : 0.0; },
     ValueKind::yes_no, [](const RunningAxis& axis) { return axis.machine->switches().limit_minus().present(); }},
    {"limit_plus", "the same for the switch at the + end",
     [](RunningAxis& axis, Instant) { return axis.machine->switches().limit_plus().active() ? 1.0 : 0.0; },
     ValueKind::yes_no, [](const RunningAxis& axis) { return axis.machine->switches().limit_plus().present(); }},
    {"home", "the same for the home switch",
     [](RunningAxis& axis, Instant) { return axis.machine->switches().home().active() ? 1.0 : 0.0; }, ValueKind::yes_no,
     [](const RunningAxis& axis) { return axis.machine->switches().home().present(); }},
    {"cam", "1 while the machine is on its reference cam",
     [](RunningAxis& axis, Instant now) { return axis.cam->active(now) ? 1.0 : 0.0; }, ValueKind::yes_no,
     [](const RunningAxis& axis) { return axis.cam != nullptr; }},
    {"drive_v", "the voltage at the servo amplifier", [](RunningAxis& axis, Instant) { return axis.servo->volts(); },
     ValueKind::measures, [](const RunningAxis& axis) { return axis.servo != nullptr; }},
}};

/// A quantity that a push of the motor sets.
struct PushRow {
    std::string_view quantity;
    /// Returns the microsteps by which to push to bring the axis to `value`.
    double (*microsteps)(RunningAxis& axis, double value, Instant now);
};
constexpr PushRow pushes[] = {
    {"position_{u}",
     [](RunningAxis& axis, double value, Instant now) {
         return (value - axis.machine->position(now)) / axis.machine->units_per_pulse();
     }},
    {"position_pulses", [](RunningAxis& axis, double value, Instant now) { return value - rotor_pulses(axis, now); }},
};

// ---- devices of an axis, for its faults

using AxisDevice = std::optional<sim::DeviceId>;

AxisDevice stepper_of(const RunningAxis& axis) {
    return axis.servo ? std::nullopt : AxisDevice(axis.machine->id());
}
AxisDevice servo_of(const RunningAxis& axis) {
    return axis.servo ? AxisDevice(axis.servo->id()) : std::nullopt;
}
AxisDevice motor_of(const RunningAxis& axis) {
    return axis.servo ? axis.servo->id() : axis.machine->id();
}
AxisDevice encoder_of(const RunningAxis& axis) {
    return axis.machine->has_encoder() ? AxisDevice(axis.machine->id()) : std::nullopt;
}
AxisDevice lines_of(const RunningAxis& axis) {
    return axis.lines ? AxisDevice(axis.lines->id()) : std::nullopt;
}
AxisDevice limit_minus_of(const RunningAxis& axis) {
    return axis.machine->switches().limit_minus().present() ? AxisDevice(axis.machine->id()) : std::nullopt;
}
AxisDevice limit_plus_of(const RunningAxis& axis) {
    return axis.machine->switches().limit_plus().present() ? AxisDevice(axis.machine->id()) : std::nullopt;
}
AxisDevice home_of(const RunningAxis& axis) {
    return axis.machine->switches().home().present() ? AxisDevice(axis.machine->id()) : std::nullopt;
}

double counts_per_turn(const RunningAxis& axis) {
    return static_cast<double>(axis.config.encoder_counts_per_rev);
}
double max_dirty_lines(const RunningAxis& axis) {
    return std::floor((counts_per_turn(axis) - 1) / 4);
}
double max_eccentricity(const RunningAxis& axis) {
    return counts_per_turn(axis) / 7;
}

constexpr std::array<FaultRow<RunningAxis>, 20> axis_faults = {{
    {"motor.stall", 0, 1, "", "1: the axle is blocked; 0 releases it", motor_of},
    {"motor.lose_steps", -max_push, max_push, "pulses",
     "pulses by which the rotor falls back, rounded to whole electrical cycles", stepper_of},
    {"motor.push", -max_push, max_push, "microsteps", "microsteps by which the rotor is pushed, approximate", motor_of},
    {"encoder.broken_a", 0, 1, "", "1: track A reads Low; 0 repairs it", encoder_of},
    {"encoder.broken_b", 0, 1, "", "1: track B reads Low; 0 repairs it", encoder_of},
    {"encoder.swapped", 0, 1, "", "1: the tracks are swapped; 0 repairs it", encoder_of},
    {"limit_minus.stuck_open", 0, 1, "", "1: the switch never acts; 0 repairs it", limit_minus_of},
    {"limit_minus.stuck_closed", 0, 1, "", "1: the switch always acts; 0 repairs it", limit_minus_of},
    {"limit_plus.stuck_open", 0, 1, "", "1: the switch never acts; 0 repairs it", limit_plus_of},
    {"limit_plus.stuck_closed", 0, 1, "", "1: the switch always acts; 0 repairs it", limit_plus_of},
    {"home.stuck_open", 0, 1, "", "1: the switch never acts; 0 repairs it", home_of},
    {"home.stuck_closed", 0, 1, "", "1: the switch always acts; 0 repairs it", home_of},
    {"motor.load", 0, max_factor, "", "ratio of the load to the motor's own inertia", servo_of},
    {"encoder.inverted_a", 0, 1, "", "1: track A is inverted; 0 repairs it", lines_of},
    {"encoder.inverted_b", 0, 1, "", "1: track B is inverted; 0 repairs it", lines_of},
    {"encoder.noise", 0, max_wrong_levels, "levels", "number of wrong levels from now on, 0.5 to 10 us each", lines_of},
    {"encoder.jitter", 0, max_edge_delay_s, "s", "maximum delay of the edges", lines_of},
    {"encoder.dirt", 0, 0, "lines", "number of adjacent dirty lines of the disc, which are not read", lines_of,
     max_dirty_lines},
    {"encoder.overspeed", 0, max_push, "1/s", "edge rate (1 or more) above which lines are lost; 0 repairs it",
     lines_of},
    {"encoder.eccentricity", 0, 0, "counts", "eccentricity of the disc", lines_of, max_eccentricity},
}};

class AxisPart final : public TablePart<RunningAxis> {
  public:
    explicit AxisPart(RunningAxis& axis)
        : TablePart(std::string(1, axis.config.letter), axis.config.unit(), axis, axis_quantities, axis_faults) {}

    std::string subject() const override { return "Axis " + name(); }
    /// Returns the range that a push can reach, symmetrical to both sides.
    std::optional<QuantityLimits> limits_to_set(std::string_view quantity_name, Instant now) override {
        const PushRow* row = push_of(quantity_name);
        if (row == nullptr) return std::nullopt;
        const double here = *quantity(quantity_name, now);
        const double farthest = std::fabs(max_push / row->microsteps(running_, here + 1, now));
        return QuantityLimits{here - farthest, here + farthest};
    }
    Result<std::string> fault_to_set(std::string_view quantity_name, double value, Instant now) override;
    std::optional<std::string> describe(const sim::Condition& condition, const sim::Kernel& kernel) const override {
        const bool own =
            condition.device == running_.machine->id() || (running_.servo && condition.device == running_.servo->id());
        if (!own) return std::nullopt;
        return parts::describe(condition, kernel.device_name(condition.device));
    }

  private:
    const PushRow* push_of(std::string_view quantity_name) const {
        for (const PushRow& row : pushes)
            if (with_unit(row.quantity, running_.config.unit()) == quantity_name) return &row;
        return nullptr;
    }
};

Result<std::string> AxisPart::fault_to_set(std::string_view quantity_name, double value, Instant now) {
    if (!quantity(quantity_name, now)) return no_such_quantity(quantity_name);
    const std::string full = full_name(quantity_name);
    const PushRow* row = push_of(quantity_name);
    if (row == nullptr)
        return fail(
            ErrorKind::refused,
            fmt::format("{} follows from the machine and cannot be set; set the position. Nothing was done.", full));
    if (!std::isfinite(value))
        return fail(ErrorKind::refused,
                    fmt::format("{} cannot become {}: that is not a number. Nothing was done.", full, value));
    const double push = row->microsteps(running_, value, now);
    if (!(std::fabs(push) <= max_push))
        return fail(ErrorKind::refused,
                    fmt::format("To bring {} to {} the motor must be pushed by {:.0f} microsteps; the limit is {:.0f}. "
                                "Nothing was done.",
                                full, value, push, max_push));
    // A rotor in step springs back unless it is pushed past the middle of an electrical cycle.
    const parts::AxisMechanics& machine = *running_.machine;
    const double min_push =
        machine.in_step() && !running_.servo ? 2.0 * static_cast<double>(machine.settings().motor.microsteps) : 0.5;
    if (std::fabs(push) < min_push) return std::string();
    return fmt::format("motor.push={:.0f}", push);
}

// ---- signals

bool takes_pulses(const RackAxis& axis) {
    return !axis.servo;
}
bool has_encoder(const RackAxis& axis) {
    return axis.encoder_counts_per_rev > 0;
}

constexpr std::string_view track_a = "enc_a", track_b = "enc_b";
constexpr std::array<SignalRow<RackAxis>, 10> axis_signals = {{
    {"step", PinDirection::input, "a pulse moves the motor by one microstep", takes_pulses,
     "a stepping motor (no servo)"},
    {"dir", PinDirection::input, "the direction of the pulses", takes_pulses, "a stepping motor (no servo)"},
    {"drive", PinDirection::input, "velocity command of the servo amplifier, V",
     [](const RackAxis& axis) { return axis.servo.has_value(); }, "a servo", 1e-6},
    {track_a, PinDirection::output, "encoder track A", has_encoder, "encoder_counts_per_rev above 0"},
    {track_b, PinDirection::output, "encoder track B", has_encoder, "encoder_counts_per_rev above 0"},
    {"enc_z", PinDirection::output, "encoder index, once a motor turn", has_encoder, "encoder_counts_per_rev above 0"},
    {"limit_plus", PinDirection::output, "limit switch at the + end",
     [](const RackAxis& axis) { return axis.switches.limit_plus.has_value(); }, "limit_plus_{u} in its switches"},
    {"limit_minus", PinDirection::output, "limit switch at the - end",
     [](const RackAxis& axis) { return axis.switches.limit_minus.has_value(); }, "limit_minus_{u} in its switches"},
    {"home", PinDirection::output, "home switch", [](const RackAxis& axis) { return axis.switches.home.has_value(); },
     "home_{u} in its switches"},
    {"cam", PinDirection::output, "reference cam: low between its ends",
     [](const RackAxis& axis) { return axis.switches.has_cam(); }, "cam_from_{u} and cam_to_{u} in its switches"},
}};

std::string axis_name_of(const RackConfig& config, std::size_t index) {
    return std::string(1, config.axes[index].letter);
}

std::vector<PartSignal> signals_of_axes(const RackConfig& config) {
    std::vector<PartSignal> out;
    for (std::size_t i = 0; i < config.axes.size(); ++i) {
        const std::string name = axis_name_of(config, i);
        append_signals(axis_signals, config.axes[i], {EndOwner::axis, i, name, "axis " + name, config.axes[i].unit()},
                       out);
    }
    return out;
}

/// Joins each channel to its axis as the type of the card says.
void join_axes(const RackConfig& config, const JoinPins& join) {
    for (const RackAxis& axis : config.axes) {
        if (channel_index(config, axis) < 0) continue;
        for (const DefaultWire& wire : find_card_type(config.card(axis.card)->type)->default_wires)
            join(fmt::format("{}.{}{}", axis.card, axis.channel, wire.pin),
                 fmt::format("{}.{}", axis.letter, wire.end));
    }
}

/// Returns the kernel wire of an axis' signal; adds the wires of the encoder tracks when the first card needs them.
sim::WireId axis_wire(Rack& rack, const WireEnd& end) {
    sim::Kernel& kernel = rack.kernel();
    if (end.pin != track_a && end.pin != track_b) return kernel.find_wire(rack.config().end_name(end));
    RunningAxis& axis = rack.axes()[static_cast<std::size_t>(end.index)];
    const std::string name = fmt::format("{}.lines", axis.config.letter);
    if (!axis.lines) {
        parts::LineEncoderSettings settings;
        settings.counts_per_turn = settings.position_per_turn = axis.config.encoder_counts_per_rev;
        // A pulse may be many counts, and a rotor can jump when it locks elsewhere. Their edges keep a minimum
        // distance, and none is lost.
        settings.min_edge_interval = nanoseconds(200);
        settings.too_quick = parts::TooQuick::loses_by_fault;
        axis.lines = std::make_unique<parts::LineEncoder>(kernel, name, axis.machine->encoder(), settings);
    }
    return kernel.find_wire(name + (end.pin == track_a ? ".a" : ".b"));
}

PartWire wire_of_axis(const Rack& rack, const RunningAxis& axis, const SignalRow<RackAxis>& row) {
    const RackConfig& config = rack.config();
    PartWire out;
    out.name = fmt::format("{}.{}", axis.config.letter, row.name);
    out.id = rack.kernel().find_wire(out.name);
    if (row.name == track_a || row.name == track_b) {
        out.refused = fmt::format(
            "{} cannot be forced: it is the output of the encoder. Force the connected input of a card", out.name);
        out.from_edges = true;
        out.level = [&machine = *axis.machine, second = row.name == track_b](Instant now) {
            const parts::QuadratureLevels lines = machine.encoder_lines(now);
            return second ? lines.b : lines.a;
        };
    } else if (row.volts > 0) {
        out.unit = row.volts;
    } else if (row.direction == PinDirection::input) {
        out.refused = fmt::format(
            "{} cannot be forced: it follows all pulses of a channel. Move it by the card or by set_quantity",
            out.name);
        out.from_edges = true;
        for (const RackWire& joined : config.wires)
            if (config.end_name(joined.to) == out.name) out.id = rack.kernel().find_wire(config.end_name(joined.from));
    }
    return out;
}

std::vector<PartWire> wires_of_axes(Rack& rack) {
    std::vector<PartWire> out;
    for (const RunningAxis& axis : rack.axes())
        for (const SignalRow<RackAxis>& row : axis_signals)
            if (row.has(axis.config)) out.push_back(wire_of_axis(rack, axis, row));
    return out;
}

constexpr PartSignals axis_part_signals = {
    EndOwner::axis,  [] { return declared_signals<RackAxis>(axis_signals, "X"); },
    signals_of_axes, axis_name_of,
    wires_of_axes,   join_axes,
    axis_wire,
};

void add_axis_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (RunningAxis& axis : rack.axes()) parts.push_back(std::make_unique<AxisPart>(axis));
}

}  // namespace

constexpr PartKind axis_part_kind = {
    "axis", add_axis_parts, declared<axis_quantities>, names_of<axis_faults>, &axis_sections, &axis_part_signals};

}  // namespace motionrack::rack
