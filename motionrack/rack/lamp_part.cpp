// A signal lamp as a part: its quantity, fault and signal.
#include <array>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/table_part.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

namespace {

constexpr std::array<QuantityRow<RunningLamp>, 1> lamp_quantities = {{
    {"lit", "1 while it shines, else 0", [](RunningLamp& lamp, Instant) { return lamp.device->lit() ? 1.0 : 0.0; },
     ValueKind::yes_no},
}};

std::optional<sim::DeviceId> lamp_device(const RunningLamp& lamp) {
    return lamp.device->id();
}

constexpr std::array<FaultRow<RunningLamp>, 1> lamp_faults = {{
    {"burnt_out", 0, 1, "", "1: it stays dark; 0 repairs it", lamp_device},
}};

constexpr std::array<SignalRow<RackLamp>, 1> lamp_signals = {{
    {"in", PinDirection::input, "its input"},
}};

std::string lamp_name_of(const RackConfig& config, std::size_t index) {
    return config.lamps[index].name;
}

std::vector<PartSignal> signals_of_lamps(const RackConfig& config) {
    std::vector<PartSignal> out;
    for (std::size_t i = 0; i < config.lamps.size(); ++i) {
        const std::string& name = config.lamps[i].name;
        append_signals(lamp_signals, config.lamps[i], {EndOwner::lamp, i, name, "lamp " + name, {}}, out);
    }
    return out;
}

std::vector<PartWire> wires_of_lamps(Rack& rack) {
    std::vector<PartWire> out;
    for (const RunningLamp& lamp : rack.lamps())
        for (const SignalRow<RackLamp>& row : lamp_signals) {
            const std::string name = signal_name(lamp.config.name, row.name);
            out.push_back({name, rack.kernel().find_wire(name)});
        }
    return out;
}

constexpr PartSignals lamp_part_signals = {
    EndOwner::lamp,   [] { return declared_signals<RackLamp>(lamp_signals, "NAME", "of a lamp: "); },
    signals_of_lamps, lamp_name_of,
    wires_of_lamps,
};

class LampPart final : public TablePart<RunningLamp> {
  public:
    explicit LampPart(RunningLamp& lamp) : TablePart(lamp.config.name, {}, lamp, lamp_quantities, lamp_faults) {}

    std::string subject() const override { return "Lamp " + name(); }
};

void add_lamp_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (RunningLamp& lamp : rack.lamps()) parts.push_back(std::make_unique<LampPart>(lamp));
}

}  // namespace

constexpr PartKind lamp_part_kind = {
    "lamp", add_lamp_parts, declared<lamp_quantities>, names_of<lamp_faults>, &lamp_sections, &lamp_part_signals};

}  // namespace motionrack::rack
