// The touch probe as a part: its signal.
#include <fmt/format.h>

#include <array>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

namespace {

constexpr std::array<SignalRow<RackProbe>, 1> probe_signals = {{
    {{}, PinDirection::output, "the touch probe: high while it touches", nullptr, "the section `[probe]` is there"},
}};

std::string probe_name_of(const RackConfig&, std::size_t) {
    return "probe";
}

std::vector<PartSignal> signals_of_probe(const RackConfig& config) {
    std::vector<PartSignal> out;
    if (config.probe) append_signals(probe_signals, *config.probe, {EndOwner::probe, 0, "probe", "the probe", {}}, out);
    return out;
}

/// Joins the probe to the input of each axis' channel that catches positions.
void join_probe(const RackConfig& config, const JoinPins& join) {
    for (const RackAxis& axis : config.axes) {
        if (channel_index(config, axis) < 0) continue;
        const std::string_view pin = find_card_type(config.card(axis.card)->type)->probe_pin;
        if (!pin.empty()) join(fmt::format("{}.{}{}", axis.card, axis.channel, pin), "probe");
    }
}

std::vector<PartWire> wires_of_probe(Rack& rack) {
    if (!rack.config().probe) return {};
    return {{"probe", rack.kernel().find_wire("probe")}};
}

constexpr PartSignals probe_part_signals = {
    EndOwner::probe,  [] { return declared_signals<RackProbe>(probe_signals, "probe"); },
    signals_of_probe, probe_name_of,
    wires_of_probe,   join_probe,
};

}  // namespace

constexpr PartKind probe_part_kind = {"probe", nullptr, nullptr, nullptr, &probe_sections, &probe_part_signals};

}  // namespace motionrack::rack
