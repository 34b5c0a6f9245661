// A stage as a part: its quantities, faults and signals.
#include <fmt/format.h>

#include <array>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/table_part.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

namespace {

constexpr double mm_per_nm = 1e-6;

/// Returns true if the stage's control loop is closed by a processor.
bool has_stage_loop(const RunningStage& stage) {
    return stage.loop() != nullptr;
}

constexpr std::array<QuantityRow<RunningStage>, 13> stage_quantities = {{
    {"position_mm", "the true position of the stage",
     [](RunningStage& stage, Instant now) { return stage.motor->position_nm(now) * mm_per_nm; }, ValueKind::measures},
    {"speed_mm_s", "its velocity, signed",
     [](RunningStage& stage, Instant now) { return stage.motor->velocity(now) * 1e3; }, ValueKind::measures},
    {"drive_v", "the voltage at its amplifier", [](RunningStage& stage, Instant) { return stage.motor->volts(); },
     ValueKind::measures},
    {"scale_mm", "its position by its scale",
     [](RunningStage& stage, Instant now) {
         return stage.config.scale.zero_offset_mm + stage.scale->position_nm(now) * mm_per_nm;
     },
     ValueKind::measures},
    {"scale_counts", "counts of its scale",
     [](RunningStage& stage, Instant now) { return static_cast<double>(stage.scale->count(now)); }, ValueKind::whole},
    {"lost_counts", "counts that its scale has lost",
     [](RunningStage& stage, Instant) { return static_cast<double>(stage.scale->lost()); }, ValueKind::amount},
    {"trusted", "1 while its scale has lost none, else 0",
     [](RunningStage& stage, Instant) { return stage.scale->counts_valid() ? 1.0 : 0.0; }, ValueKind::yes_no},
    {"closed", "1 while its loop is closed, else 0",
     [](RunningStage& stage, Instant) { return stage.loop()->closed() ? 1.0 : 0.0; }, ValueKind::yes_no,
     has_stage_loop},
    {"following_nm", "following error at the last frame: commanded - measured",
     [](RunningStage& stage, Instant) { return stage.loop()->error().last_nm; }, ValueKind::measures, has_stage_loop},
    {"following_peak_nm", "the peak following error so far, absolute",
     [](RunningStage& stage, Instant) { return stage.loop()->error().peak_nm; }, ValueKind::measures, has_stage_loop},
    {"following_rms_nm", "the RMS following error so far",
     [](RunningStage& stage, Instant) { return stage.loop()->error().rms_nm(); }, ValueKind::measures, has_stage_loop},
    {"wanted_mm", "its commanded position",
     [](RunningStage& stage, Instant now) { return stage.wanted(to_seconds(now)).position_nm * mm_per_nm; },
     ValueKind::measures, has_stage_loop},
    {"unused_frames", "frames that its loop could not use",
     [](RunningStage& stage, Instant) { return static_cast<double>(stage.loop()->unused()); }, ValueKind::amount,
     has_stage_loop},
}};

std::optional<sim::DeviceId> stage_motor(const RunningStage& stage) {
    return stage.motor->id();
}
std::optional<sim::DeviceId> stage_scale(const RunningStage& stage) {
    return stage.scale->id();
}

constexpr double max_expansion_ppm = 1e5;
constexpr std::array<FaultRow<RunningStage>, 8> stage_faults = {{
    {"motor.stall", 0, 1, "", "1: the stage is blocked; 0 releases it", stage_motor},
    {"motor.push", -max_push, max_push, "nm", "distance by which the stage is pushed, at most to its hard stops",
     stage_motor},
    {"motor.friction", 0, max_factor, "m/s2", "deceleration by added friction", stage_motor},
    {"motor.load", 0, max_factor, "", "ratio of the load to the mass of the stage", stage_motor},
    {"scale.lose", -max_push, max_push, "counts", "number of counts that are lost at once", stage_scale},
    {"scale.dirt", 0, max_push, "nm", "length of the dirty part of the grating, which is not read", stage_scale},
    {"scale.swapped", 0, 1, "", "1: the lines are swapped: the scale counts backwards; 0 repairs it", stage_scale},
    {"scale.expansion", -max_expansion_ppm, max_expansion_ppm, "ppm", "expansion of the grating", stage_scale},
}};

class StagePart final : public TablePart<RunningStage> {
  public:
    explicit StagePart(RunningStage& stage) : TablePart(stage.config.name, {}, stage, stage_quantities, stage_faults) {}

    std::string subject() const override { return "Stage " + name(); }
    std::optional<std::string> describe(const sim::Condition& condition, const sim::Kernel&) const override {
        const sim::DeviceId device = condition.device;
        if (running_.processor != nullptr && running_.processor->id() == device &&
            running_.config.output == condition.a)
            return describe_loop(condition, running_.config);
        if (running_.motor->id() != device && running_.scale->id() != device) return std::nullopt;
        return parts::describe(condition, name());
    }
};

// ---- signals: the rack itself connects them

constexpr std::array<SignalRow<RackStage>, 4> stage_signals = {{
    // its unit is that of parts::LinearStage
    {"drive", PinDirection::input, "voltage at its amplifier, V", nullptr, {}, 1e-6, 1, true},
    {"scale.a", PinDirection::output, "line A of its scale", nullptr, {}, 0, 1, true},
    {"scale.b", PinDirection::output, "line B of its scale", nullptr, {}, 0, 1, true},
    {"scale.z", PinDirection::output, "reference mark of its scale", nullptr, {}, 0, 1, true},
}};

std::string stage_name_of(const RackConfig& config, std::size_t index) {
    return config.stages[index].name;
}

std::vector<PartSignal> signals_of_stages(const RackConfig& config) {
    std::vector<PartSignal> out;
    for (std::size_t i = 0; i < config.stages.size(); ++i) {
        const std::string& name = config.stages[i].name;
        append_signals(stage_signals, config.stages[i], {EndOwner::stage, i, name, "stage " + name, "mm"}, out);
    }
    return out;
}

std::vector<PartWire> wires_of_stages(Rack& rack) {
    std::vector<PartWire> out;
    for (const RackStage& stage : rack.config().stages)
        for (const SignalRow<RackStage>& row : stage_signals) {
            PartWire& wire = out.emplace_back();
            wire.name = signal_name(stage.name, row.name);
            wire.id = rack.kernel().find_wire(wire.name);
            if (row.volts > 0) wire.unit = row.volts;
            if (row.direction == PinDirection::output)
                wire.refused = fmt::format(
                    "{} cannot be forced: it is the output of the scale. Force the decoder's input", wire.name);
        }
    return out;
}

constexpr PartSignals stage_part_signals = {
    EndOwner::stage,   [] { return declared_signals<RackStage>(stage_signals, "NAME"); },
    signals_of_stages, stage_name_of,
    wires_of_stages,
};

void add_stage_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (RunningStage& stage : rack.stages()) parts.push_back(std::make_unique<StagePart>(stage));
}

}  // namespace

constexpr PartKind stage_part_kind = {
    "stage", add_stage_parts, declared<stage_quantities>, names_of<stage_faults>, &stage_sections, &stage_part_signals};

}  // namespace motionrack::rack
