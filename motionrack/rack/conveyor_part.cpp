// A belt or rotary table as a part: its quantities, how its velocity is set, its faults, and its
// signals.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/table_part.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

namespace {

bool has_conveyor_encoder(const RunningConveyor& conveyor) {
    return conveyor.encoder != nullptr;
}

constexpr std::string_view conveyor_velocity = "speed_{u}_s";
constexpr std::array<QuantityRow<RunningConveyor>, 6> conveyor_quantities = {{
    {"position_{u}", "its travel since the start",
     [](RunningConveyor& conveyor, Instant now) { return conveyor.track().travel(to_seconds(now)); },
     ValueKind::measures},
    {conveyor_velocity, "its velocity, signed",
     [](RunningConveyor& conveyor, Instant now) { return conveyor.track().velocity(to_seconds(now)); },
     ValueKind::measures},
    {"encoder_counts", "counts of its encoder",
     [](RunningConveyor& conveyor, Instant) { return static_cast<double>(conveyor.encoder->count()); },
     ValueKind::whole, has_conveyor_encoder},
    {"lost_counts", "counts that the encoder lost above its maximum rate",
     [](RunningConveyor& conveyor, Instant) { return static_cast<double>(conveyor.encoder->lost()); },
     ValueKind::amount, has_conveyor_encoder},
    {"word", "the sender's last complete word",
     [](RunningConveyor& conveyor, Instant) { return static_cast<double>(conveyor.sender->word()); }, ValueKind::whole,
     [](const RunningConveyor& conveyor) { return conveyor.sender != nullptr; }},
    {"parts", "number of parts that reached the sensor",
     [](RunningConveyor& conveyor, Instant now) { return static_cast<double>(conveyor.sensor->parts(now)); },
     ValueKind::whole, [](const RunningConveyor& conveyor) { return conveyor.sensor != nullptr; }},
}};

using ConveyorDevice = std::optional<sim::DeviceId>;

ConveyorDevice conveyor_drive(const RunningConveyor& conveyor) {
    return conveyor.drive->id();
}
ConveyorDevice conveyor_encoder(const RunningConveyor& conveyor) {
    return conveyor.encoder ? ConveyorDevice(conveyor.encoder->id()) : std::nullopt;
}
ConveyorDevice conveyor_sender(const RunningConveyor& conveyor) {
    return conveyor.sender ? ConveyorDevice(conveyor.sender->id()) : std::nullopt;
}

double max_conveyor_velocity(const RunningConveyor& conveyor) {
    return conveyor.config.max_velocity();
}
/// Returns the maximum value of the fault that switches back to the profile: 1, or the maximum velocity if that is
/// lower.
double max_profile_switch(const RunningConveyor& conveyor) {
    return std::min(1.0, max_conveyor_velocity(conveyor));
}

constexpr std::string_view velocity_fault = "drive.speed";
constexpr std::array<FaultRow<RunningConveyor>, 10> conveyor_faults = {{
    {velocity_fault, 0, 0, "/s", "velocity from now on, mm/s or degrees/s; 0: standstill", conveyor_drive,
     max_conveyor_velocity},
    {"drive.profile", 0, 1, "", "1: back to the profile of the rack file", conveyor_drive, max_profile_switch},
    {"encoder.broken_a", 0, 2, "", "1: track A reads Low, 2: High; 0 repairs it", conveyor_encoder},
    {"encoder.broken_b", 0, 2, "", "1: track B reads Low, 2: High; 0 repairs it", conveyor_encoder},
    {"encoder.swapped", 0, 1, "", "1: the tracks are swapped; 0 repairs it", conveyor_encoder},
    {"encoder.inverted_a", 0, 1, "", "1: track A is inverted; 0 repairs it", conveyor_encoder},
    {"encoder.inverted_b", 0, 1, "", "1: track B is inverted; 0 repairs it", conveyor_encoder},
    {"encoder.noise", 0, max_wrong_levels, "levels", "number of wrong levels from now on, 0.5 to 10 us each",
     conveyor_encoder},
    {"encoder.jitter", 0, max_edge_delay_s, "s", "maximum delay of the edges", conveyor_encoder},
    {"sender.silent", 0, 1, "", "1: the sender is silent; 0 repairs it", conveyor_sender},
}};

class ConveyorPart final : public TablePart<RunningConveyor> {
  public:
    explicit ConveyorPart(RunningConveyor& conveyor)
        : TablePart(conveyor.config.name, conveyor.config.unit(), conveyor, conveyor_quantities, conveyor_faults) {}

    std::optional<QuantityLimits> limits_to_set(std::string_view quantity_name, Instant) override {
        if (quantity_name != velocity_name()) return std::nullopt;
        const double max_velocity = running_.config.max_velocity();
        return QuantityLimits{-max_velocity, max_velocity};
    }
    Result<std::string> fault_to_set(std::string_view quantity_name, double value, Instant) override {
        if (quantity_name != velocity_name())
            return fail(ErrorKind::refused, fmt::format("Of {} only {} can be set, not {}. Nothing was done.", name(),
                                                        velocity_name(), in_quotes(quantity_name)));
        const double max_velocity = running_.config.max_velocity();
        if (!(std::fabs(value) <= max_velocity))
            return fail(ErrorKind::refused, fmt::format("{} is {}; it must be {:.6g} to {:.6g}. Nothing was done.",
                                                        full_name(quantity_name), value, -max_velocity, max_velocity));
        return fmt::format("{}={:.17g}", velocity_fault, value);
    }

    /// Returns the faults of the fitted components only: others are unknown.
    std::vector<std::string_view> fault_names() const override {
        std::vector<std::string_view> out = TablePart::fault_names();
        std::erase_if(out, [this](std::string_view name) { return !can_have(name); });
        return out;
    }
    bool drives(std::string_view fault) const override { return fault.starts_with("drive."); }
    FaultRange fault_range(std::string_view fault) const override {
        FaultRange out = TablePart::fault_range(fault);
        if (fault != velocity_fault) return out;
        out.min = -out.max;
        out.unit.insert(0, running_.config.unit());
        return out;
    }

  private:
    std::string velocity_name() const { return with_unit(conveyor_velocity, running_.config.unit()); }
};

// ---- signals

bool has_encoder(const RackConveyor& track) {
    return track.has_encoder();
}
bool has_sender(const RackConveyor& track) {
    return track.sender.has_value();
}
bool has_parts(const RackConveyor& track) {
    return track.passing.has_value();
}

constexpr std::array<SignalRow<RackConveyor>, 5> conveyor_signals = {{
    {"enc_a", PinDirection::output, "encoder line A", has_encoder, "counts_per_{u} other than 0"},
    {"enc_b", PinDirection::output, "encoder line B", has_encoder, "counts_per_{u} other than 0"},
    {"mcbsp", PinDirection::output, "the sender's last complete word", has_sender, "a section sender", 0, 32},
    {"mcbsp_frame", PinDirection::output, "toggles when a complete word equals the previous one", has_sender,
     "a section sender"},
    {"sensor_n", PinDirection::output, "light barrier: low while a part is there", has_parts, "a section parts"},
}};
/// Card pins to which the default rule connects the conveyor's signals, in their order; "#" stands for the number of
/// the encoder input.
constexpr std::array<std::string_view, conveyor_signals.size()> conveyor_pins = {"enc#_a", "enc#_b", "mcbsp",
                                                                                 "mcbsp_frame", "start_n"};

std::string conveyor_name_of(const RackConfig& config, std::size_t index) {
    return config.tracks[index].name;
}

std::vector<PartSignal> signals_of_conveyors(const RackConfig& config) {
    std::vector<PartSignal> out;
    for (std::size_t i = 0; i < config.tracks.size(); ++i) {
        const RackConveyor& track = config.tracks[i];
        append_signals(conveyor_signals, track, {EndOwner::track, i, track.name, track.name, track.unit()}, out);
    }
    return out;
}

void join_conveyors(const RackConfig& config, const JoinPins& join) {
    for (const RackConveyor& track : config.tracks)
        for (std::size_t i = 0; track.card && i < conveyor_signals.size(); ++i) {
            std::string pin(conveyor_pins[i]);
            if (const std::size_t at = pin.find('#'); at != std::string::npos)
                pin.replace(at, 1, std::to_string(track.encoder));
            join(fmt::format("{}.{}", *track.card, pin), signal_name(track.name, conveyor_signals[i].name));
        }
}

sim::WireId conveyor_wire(Rack& rack, const WireEnd& end) {
    return rack.kernel().find_wire(rack.tracks()[static_cast<std::size_t>(end.index)].wire_name(end.pin));
}

std::vector<PartWire> wires_of_conveyors(Rack& rack) {
    std::vector<PartWire> out;
    for (const RunningConveyor& track : rack.tracks())
        for (const SignalRow<RackConveyor>& row : conveyor_signals)
            if (row.has(track.config))
                out.push_back({signal_name(track.config.name, row.name),
                               rack.kernel().find_wire(track.wire_name(row.name)), 1, row.bits});
    return out;
}

constexpr PartSignals conveyor_part_signals = {
    EndOwner::track,
    [] { return declared_signals<RackConveyor>(conveyor_signals, "NAME", "of a belt or table: "); },
    signals_of_conveyors,
    conveyor_name_of,
    wires_of_conveyors,
    join_conveyors,
    conveyor_wire,
};

void add_conveyor_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (RunningConveyor& conveyor : rack.tracks()) parts.push_back(std::make_unique<ConveyorPart>(conveyor));
}

}  // namespace

constexpr PartKind conveyor_part_kind = {
    "conveyor",         add_conveyor_parts,    declared<conveyor_quantities>, names_of<conveyor_faults>,
    &conveyor_sections, &conveyor_part_signals};

}  // namespace motionrack::rack
