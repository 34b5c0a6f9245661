// Describes parts, wires and work pieces of a rack as JSON.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/panel/card_view.hpp>
#include <motionrack/panel/rack_view.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::panel {

using nlohmann::json;

namespace {

json axes_of(const rack::RackConfig& config) {
    json out = json::array();
    for (const rack::RackAxis& axis : config.axes)
        out.push_back({{"letter", std::string(1, axis.letter)},
                       {"unit", axis.unit()},
                       {"card", axis.card},
                       {"channel", axis.channel},
                       {"min", axis.min_limit},
                       {"max", axis.max_limit},
                       {"max_velocity", axis.max_velocity},
                       {"max_accel", axis.max_accel},
                       {"pulses_per_unit", axis.pulses_per_unit()},
                       {"counts_per_unit", axis.counts_per_unit()},
                       {"servo", axis.servo.has_value()},
                       {"can_home", config.can_home(axis)}});
    return out;
}

template <class Parts>
json names_of(const Parts& parts) {
    json out = json::array();
    for (const auto& part : parts) out.push_back(part.name);
    return out;
}

/// Describes stages, conveyors and scan heads.
json parts_of(const rack::RackConfig& config) {
    json out = json::array();
    for (const rack::RackStage& stage : config.stages)
        out.push_back({{"name", stage.name},
                       {"kind", "stage"},
                       {"card", stage.card},
                       {"output", stage.output},
                       {"input", stage.input},
                       {"servo", stage.servo.has_value()},
                       {"min", stage.hard_stop_minus_mm},
                       {"max", stage.hard_stop_plus_mm}});
    for (const rack::RackConveyor& track : config.tracks)
        out.push_back({{"name", track.name},
                       {"kind", track.rotary ? "table" : "belt"},
                       {"unit", track.unit()},
                       {"card", track.card ? json(*track.card) : json()},
                       {"velocity", track.velocity}});
    for (const rack::RackScanner& scanner : config.scanners)
        out.push_back({{"name", scanner.name},
                       {"kind", "scanner"},
                       {"card", scanner.card},
                       {"track", scanner.conveyor ? json(*scanner.conveyor) : json()},
                       {"bits_per_mm", scanner.bits_per_mm}});
    return out;
}

json faults_of(operate::Machine& machine) {
    json out = json::array();
    for (const rack::FaultTarget& target : rack::fault_targets(machine.rack()))
        if (machine.service().live_place(target.name) == nullptr)
            out.push_back({{"target", target.name}, {"faults", target.faults}});
    return out;
}

}  // namespace

json rack_facts(operate::Machine& machine) {
    rack::Rack& rack = machine.rack();
    const rack::RackConfig& config = rack.config();
    json cards = json::array(), joined = json::array(), wires = json::array();
    for (const auto& card : rack.cards()) cards.push_back(card_facts(machine, *card));
    for (const rack::RackWire& wire : config.wires)
        joined.push_back({{"from", config.end_name(wire.from)}, {"to", config.end_name(wire.to)}});
    for (const rack::WireAccess::Named& wire : machine.wires().names())
        if (machine.service().live_place(card_part(wire.name)) == nullptr)
            wires.push_back(
                {{"name", wire.name}, {"volts", wire.volts}, {"bits", wire.bits}, {"drivable", wire.drivable}});
    json out = {{"name", config.name},
                {"stages", names_of(config.stages)},
                {"tracks", names_of(config.tracks)},
                {"scanners", names_of(config.scanners)}};
    out["parts"] = parts_of(config);
    out["axes"] = axes_of(config);
    out["cards"] = std::move(cards);
    out["joined"] = std::move(joined);
    out["wires"] = std::move(wires);
    out["faults"] = faults_of(machine);
    return out;
}

Result<json> workpiece_now(operate::Machine& machine, const std::string& name, std::size_t max_kept) {
    const rack::RunningScanner* scanner = machine.rack().scanner(name);
    if (scanner == nullptr) {
        std::string known;
        for (const rack::RunningScanner& one : machine.rack().scanners())
            known += (known.empty() ? "" : ", ") + one.config.name;
        return fail(ErrorKind::invalid_input, fmt::format("Unknown scan head {}; the rack has: {}.",
                                                          rack::in_quotes(name), known.empty() ? "none" : known));
    }
    const parts::MarkingStation& station = scanner->station();
    const std::span<const parts::MarkedPoint> points = station.workpiece().points();
    // Reduces the points to every nth, but keeps the first and last of each stroke.
    const std::size_t step = points.size() / std::max<std::size_t>(max_kept, 2) + 1;
    json strokes = json::array();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool last = i + 1 == points.size() || points[i + 1].first;
        if (points[i].first || strokes.empty()) strokes.push_back(json::array());
        if (points[i].first || last || i % step == 0) strokes.back().push_back({points[i].at.x, points[i].at.y});
    }
    const rack::RackScanner& config = scanner->config;
    const double half = 524'288 / (config.lens ? config.lens->bits_per_mm : config.bits_per_mm);
    json out = {{"scanner", name},
                {"unit", "mm"},
                {"at", to_seconds(machine.now())},
                {"marks", std::move(strokes)},
                {"points", points.size()},
                {"shown_every", step},
                {"lost_points", station.workpiece().lost_points()},
                {"marked_mm", station.workpiece().length_mm()},
                {"energy_j", station.workpiece().energy_j()},
                {"beam", {station.spot().x, station.spot().y}},
                {"laser", station.gate().on()},
                {"field", {{"min", {-half, -half}}, {"max", {half, half}}}}};
    if (const auto piece = station.workpiece().collecting())
        out["marking"] = {{piece->from.x, piece->from.y}, {piece->to.x, piece->to.y}};
    if (const rack::RunningConveyor* track =
            scanner->config.conveyor ? machine.rack().track(*scanner->config.conveyor) : nullptr)
        out["part"] = {{"name", track->config.name},
                       {"unit", track->config.unit()},
                       {"position", track->track().travel(to_seconds(machine.now()))},
                       {"velocity", track->track().velocity(to_seconds(machine.now()))},
                       {"stopped", track->drive->stopped(machine.now())},
                       {"direction_deg", track->config.direction_deg}};
    return out;
}

}  // namespace motionrack::panel
