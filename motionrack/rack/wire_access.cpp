// Finds wires by name and forces them.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>

namespace motionrack::rack {

namespace {
constexpr double max_volts = 15;           // limit of an analog input
constexpr double stage_drive_unit = 1e-6;  // V, see parts::LinearStage
}  // namespace

std::map<std::string, double> volts_of_wires(const RackConfig& config) {
    std::map<std::string, double> out;
    for (const RackCard& card : config.cards)
        for (const CardPin& pin : pins_of(card))
            if (pin.volts > 0) out[card.name + "." + pin.name] = pin.volts;
    for (const RackAxis& axis : config.axes)
        for (const AxisSignal& end : axis_ends())
            if (end.volts > 0 && end.present(axis)) out[fmt::format("{}.{}", axis.letter, end.name)] = end.volts;
    for (const RackStage& stage : config.stages) out[stage.name + ".drive"] = stage_drive_unit;
    return out;
}

WireAccess::WireAccess(Rack& rack) : rack_(rack) {
    wires_["estop"] = {WireKind::plain, rack_.kernel().find_wire("estop"), -1, 0, 1, 1, {}};
    if (rack_.config().probe) wires_["probe"] = {WireKind::plain, rack_.kernel().find_wire("probe"), -1, 0, 1, 1, {}};
    for (const char* contact : {"estop1", "estop2", "door"})
        if (const sim::WireId wire = rack_.kernel().find_wire(contact); wire != sim::WireId::none)
            wires_[contact] = {WireKind::plain, wire, -1, 0, 1, 1, {}};
    add_cards();
    add_axes();
    add_tracks();
    add_stages();
    add_encoders();
    add_ideal_encoders();
    add_rest();
}

void WireAccess::add_cards() {
    for (const RackCard& card : rack_.config().cards)
        for (const CardPin& pin : pins_of(card)) {
            const std::string name = card.name + "." + pin.name;
            AccessibleWire wire{WireKind::plain, rack_.kernel().find_wire(name), -1, 0, 1, pin.bits, {}};
            if (pin.volts > 0) wire.unit = pin.volts;
            if (pin.direction == PinDirection::output)
                wire.refused = fmt::format(
                    "{} is an output of the card; only inputs, switches and the emergency stop can be forced", name);
            wires_[name] = std::move(wire);
        }
    for (const auto& card : rack_.cards())
        for (const std::string& name : card->shared_wires())
            wires_[name] = {WireKind::plain, rack_.kernel().find_wire(name), -1, 0, 1, 1, {}};
}

void WireAccess::add_axes() {
    const RackConfig& config = rack_.config();
    for (std::size_t i = 0; i < config.axes.size(); ++i)
        for (const AxisSignal& end : axis_ends()) {
            if (!end.present(config.axes[i])) continue;
            const std::string name = fmt::format("{}.{}", config.axes[i].letter, end.name);
            AccessibleWire wire{WireKind::plain, rack_.kernel().find_wire(name), static_cast<int>(i), 0, 1, 1, {}};
            if (end.name == "enc_a" || end.name == "enc_b") {
                wire.kind = WireKind::track;
                wire.which = end.name == "enc_b";
                wire.refused = fmt::format(
                    "{} cannot be forced: it is the output of the encoder. Force the connected input of a card", name);
            } else if (end.volts > 0) {
                wire.unit = end.volts;
            } else if (end.direction == PinDirection::input) {
                wire.kind = WireKind::pulses;
                wire.refused = fmt::format(
                    "{} cannot be forced: it follows all pulses of a channel. Move it by the card or by set_quantity",
                    name);
                for (const RackWire& joined : config.wires)
                    if (config.end_name(joined.to) == name)
                        wire.id = rack_.kernel().find_wire(config.end_name(joined.from));
            }
            wires_[name] = std::move(wire);
        }
}

void WireAccess::add_tracks() {
    for (const RunningConveyor& track : rack_.tracks())
        for (const ConveyorSignal& end : track_ends())
            if (end.present(track.config))
                wires_[fmt::format("{}.{}", track.config.name, end.name)] = {
                    WireKind::plain, rack_.kernel().find_wire(track.wire_name(end.name)), -1, 0, 1, end.bits, {}};
}

void WireAccess::add_stages() {
    for (const RackStage& stage : rack_.config().stages) {
        const std::string drive = stage.name + ".drive";
        wires_[drive] = {WireKind::plain, rack_.kernel().find_wire(drive), -1, 0, stage_drive_unit, 1, {}};
        for (const char* line : {".scale.a", ".scale.b", ".scale.z"}) {
            const std::string name = stage.name + line;
            wires_[name] = {
                WireKind::plain,
                rack_.kernel().find_wire(name),
                -1,
                0,
                1,
                1,
                fmt::format("{} cannot be forced: it is the output of the scale. Force the decoder's input", name)};
        }
    }
}

/// The inputs at the end of a link are not separate wires unless they are forced.
void WireAccess::add_encoders() {
    const RackConfig& config = rack_.config();
    for (const RackWire& joined : config.wires) {
        if (!joined.link || joined.to.owner != EndOwner::card) continue;
        const auto& card = config.cards[static_cast<std::size_t>(joined.to.index)];
        int channel = -1;
        for (const CardPin& pin : pins_of(card))
            if (pin.name == joined.to.pin) channel = pin.channel;
        for (const EncoderLink& link : config.encoder_links) {
            if (link.card != joined.to.index || link.channel != channel) continue;
            auto input = std::find_if(encoders_.begin(), encoders_.end(),
                                      [&](const EncoderInput& known) { return known.link == link; });
            if (input == encoders_.end()) input = encoders_.insert(input, EncoderInput{link, 0});
            AccessibleWire& wire = wires_[config.end_name(joined.to)];
            wire.kind = WireKind::counted;
            wire.index = static_cast<int>(input - encoders_.begin());
            wire.which = (joined.from.pin == "enc_b") != link.swapped;
        }
    }
}

const WireAccess::AccessibleWire* WireAccess::find(std::string_view name) const {
    const auto found = wires_.find(name);
    return found != wires_.end() ? &found->second : nullptr;
}

tl::unexpected<Error> WireAccess::unknown(std::string_view name) const {
    std::vector<std::string_view> names;
    for (const auto& [known, wire] : wires_) names.push_back(known);
    const std::string hint = did_you_mean(name, names);
    return fail(ErrorKind::invalid_input, fmt::format("Unknown wire {}{} Wires are called CARD.PIN, NAME.END or estop, "
                                                      "see the page of the rack file. Nothing was done.",
                                                      in_quotes(name), hint.empty() ? "." : hint));
}

/// Whatever a recording has can be read.
void WireAccess::add_rest() {
    const sim::Kernel& kernel = rack_.kernel();
    for (std::size_t i = 0; i < kernel.wire_count(); ++i) {
        const auto wire = static_cast<sim::WireId>(i);
        for (std::size_t which = 0; !kernel.wire_name(wire, which).empty(); ++which) {
            const std::string& name = kernel.wire_name(wire, which);
            wires_.try_emplace(name, AccessibleWire{WireKind::plain, wire, -1, 0, 1, kernel.wire_bits(wire),
                                                    name + " is the output of a card or part; it can only be read"});
        }
    }
}

std::vector<WireAccess::Named> WireAccess::names() const {
    std::vector<Named> out;
    for (const auto& [name, wire] : wires_) {
        const bool recorded =
            wire.kind == WireKind::plain ? wire.id != sim::WireId::none : wire.kind != WireKind::counted;
        out.push_back({name, wire.unit != 1, wire.refused.empty(), recorded, wire.bits});
    }
    return out;
}

void WireAccess::add_ideal_encoders() {
    for (std::size_t i = 0; i < rack_.cards().size(); ++i) {
        if (rack_.cards()[i]->motion() == nullptr) continue;
        const MotionCard& card = *rack_.cards()[i]->motion();
        const auto pins = card.ideal_encoder();
        if (pins.empty()) continue;
        encoders_.push_back({{no_axis, static_cast<int>(i), 0, false}, 0});
        for (std::size_t which = 0; which < pins.size(); ++which) {
            AccessibleWire& wire = wires_[fmt::format("{}.{}", card.name(), pins[which])];
            wire.kind = WireKind::counted;
            wire.index = static_cast<int>(encoders_.size()) - 1;
            wire.which = static_cast<int>(which);
        }
    }
}

/// Returns the levels of the encoder at the channel (bit 0: A).
unsigned WireAccess::lines_at(const EncoderInput& input) const {
    if (input.link.axis == no_axis)
        return sim::lines_of(
            rack_.cards()[static_cast<std::size_t>(input.link.card)]->motion()->pulses(0).count(rack_.kernel().now()));
    RunningAxis& axis = rack_.axes()[static_cast<std::size_t>(input.link.axis)];
    const std::int64_t count = axis.machine->encoder().count(rack_.kernel().now());
    return sim::lines_of(input.link.swapped ? -count : count);
}

Result<double> WireAccess::get(std::string_view name) const {
    const AccessibleWire* wire = find(name);
    if (wire == nullptr) return unknown(name);
    const sim::Kernel& kernel = rack_.kernel();
    if (wire->kind == WireKind::track) {
        const parts::QuadratureLevels lines =
            rack_.axes()[static_cast<std::size_t>(wire->index)].machine->encoder_lines(kernel.now());
        return wire->which == 0 ? lines.a : lines.b;
    }
    if (wire->kind == WireKind::counted) {
        const EncoderInput& input = encoders_[static_cast<std::size_t>(wire->index)];
        if (input.driven == 0) return lines_at(input) >> wire->which & 1u;
    }
    return wire->id == sim::WireId::none ? 0 : kernel.level(wire->id) * wire->unit;
}

Result<void> WireAccess::check(std::string_view name, double value) const {
    const AccessibleWire* wire = find(name);
    if (wire == nullptr) return unknown(name);
    if (!wire->refused.empty()) return fail(ErrorKind::refused, wire->refused + ". Nothing was done.");
    if (std::isnan(value)) return {};
    if (wire->unit != 1) {
        if (std::fabs(value) <= max_volts) return {};
        return fail(ErrorKind::refused,
                    fmt::format("{} cannot be driven with {} V; it takes -{} .. {} V. Nothing was done.", name, value,
                                max_volts, max_volts));
    }
    if (wire->bits > 1) {
        const double half_range = std::ldexp(1.0, wire->bits - 1);
        if (value >= -half_range && value < half_range && value == std::floor(value)) return {};
        return fail(
            ErrorKind::refused,
            fmt::format("{} cannot be driven with {}: it takes whole numbers from {:.0f} to {:.0f}. Nothing was done.",
                        name, value, -half_range, half_range - 1));
    }
    if (value != 0 && value != 1)
        return fail(ErrorKind::refused,
                    fmt::format("{} cannot be driven with {}: it is a digital wire, 0 or 1 (NaN releases it). "
                                "Nothing was done.",
                                name, value));
    return {};
}

Result<void> WireAccess::force(std::string_view name, double value) {
    MOTIONRACK_CHECK(check(name, value));
    const AccessibleWire& wire = *find(name);
    const bool released = std::isnan(value);
    const int level = released ? 0 : static_cast<int>(std::floor(value / wire.unit + 0.5));
    rack_.input_log().add({rack_.kernel().now(), released ? sim::InputKind::release_wire : sim::InputKind::force_wire,
                           static_cast<std::uint16_t>(wire.id), 0, static_cast<std::uint16_t>(level != 0),
                           static_cast<double>(level)});
    if (released)
        release(wire);
    else
        drive(wire, level);
    rack_.kernel().settle();
    return {};
}

void WireAccess::drive(const AccessibleWire& wire, int level) {
    sim::Kernel& kernel = rack_.kernel();
    if (wire.kind == WireKind::counted) {
        EncoderInput& input = encoders_[static_cast<std::size_t>(wire.index)];
        if (input.driven == 0) {
            // Its lines keep their levels, so that disconnecting it counts nothing.
            rack_.cards()[static_cast<std::size_t>(input.link.card)]->motion()->take_encoder(input.link.channel, true);
            kernel.settle();
        }
        input.driven |= 1u << wire.which;
    }
    kernel.force(wire.id, level);
}

void WireAccess::release(const AccessibleWire& wire) {
    if (wire.kind != WireKind::counted) return rack_.kernel().release(wire.id);
    EncoderInput& input = encoders_[static_cast<std::size_t>(wire.index)];
    if ((input.driven & 1u << wire.which) == 0) return;
    input.driven &= ~(1u << wire.which);
    if (input.driven != 0) return;
    rack_.cards()[static_cast<std::size_t>(input.link.card)]->motion()->take_encoder(input.link.channel, false);
}

}  // namespace motionrack::rack
