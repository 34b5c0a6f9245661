// Finds wires by name and forces them.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>

namespace motionrack::rack {

namespace {
constexpr double max_volts = 15;  // limit of an analog input
}  // namespace

std::map<std::string, double> volts_of_wires(const RackConfig& config) {
    std::map<std::string, double> out;
    for (const RackCard& card : config.cards)
        for (const CardPin& pin : pins_of(card))
            if (pin.volts > 0) out[card.name + "." + pin.name] = pin.volts;
    for (const PartSignal& signal : part_signals(config))
        if (signal.volts > 0 && signal.missing.empty()) out[signal.name] = signal.volts;
    return out;
}

WireAccess::WireAccess(Rack& rack) : rack_(rack) {
    add_cards();
    add_parts();
    add_encoders();
    add_ideal_encoders();
    add_rest();
}

void WireAccess::add_cards() {
    for (const RackCard& card : rack_.config().cards)
        for (const CardPin& pin : pins_of(card)) {
            const std::string name = card.name + "." + pin.name;
            PartWire wire{name, rack_.kernel().find_wire(name), 1, pin.bits};
            if (pin.volts > 0) wire.unit = pin.volts;
            if (pin.direction == PinDirection::output)
                wire.refused = fmt::format(
                    "{} is an output of the card; only inputs, switches and the emergency stop can be forced", name);
            add(std::move(wire));
        }
    for (const auto& card : rack_.cards())
        for (const std::string& name : card->shared_wires()) add({name, rack_.kernel().find_wire(name)});
}

void WireAccess::add_parts() {
    for (const PartKind* kind : part_kinds())
        if (kind->signals != nullptr)
            for (PartWire& wire : kind->signals->wires(rack_)) add(std::move(wire));
}

void WireAccess::add(PartWire wire) {
    std::string name = wire.name;
    wires_[std::move(name)].wire = std::move(wire);
}

/// Adds the encoder inputs of links. They are not separate wires unless they are forced.
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
            wire.encoder = static_cast<int>(input - encoders_.begin());
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

/// Adds the other kernel wires, so that every recorded wire can be read.
void WireAccess::add_rest() {
    const sim::Kernel& kernel = rack_.kernel();
    for (std::size_t i = 0; i < kernel.wire_count(); ++i) {
        const auto wire = static_cast<sim::WireId>(i);
        for (std::size_t which = 0; !kernel.wire_name(wire, which).empty(); ++which) {
            const std::string& name = kernel.wire_name(wire, which);
            wires_.try_emplace(name, AccessibleWire{{name, wire, 1, kernel.wire_bits(wire),
                                                     name + " is the output of a card or part; it can only be read"}});
        }
    }
}

std::vector<WireAccess::Named> WireAccess::names() const {
    std::vector<Named> out;
    for (const auto& [name, known] : wires_) {
        const PartWire& wire = known.wire;
        const bool recorded = known.encoder < 0 && (wire.id != sim::WireId::none || wire.from_edges);
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
            wire.encoder = static_cast<int>(encoders_.size()) - 1;
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
    const AccessibleWire* known = find(name);
    if (known == nullptr) return unknown(name);
    const PartWire& wire = known->wire;
    const sim::Kernel& kernel = rack_.kernel();
    if (wire.level) return wire.level(kernel.now());
    if (known->encoder >= 0) {
        const EncoderInput& input = encoders_[static_cast<std::size_t>(known->encoder)];
        if (input.driven == 0) return lines_at(input) >> known->which & 1u;
    }
    return wire.id == sim::WireId::none ? 0 : kernel.level(wire.id) * wire.unit;
}

Result<void> WireAccess::check(std::string_view name, double value) const {
    const AccessibleWire* known = find(name);
    if (known == nullptr) return unknown(name);
    const PartWire& wire = known->wire;
    if (!wire.refused.empty()) return fail(ErrorKind::refused, wire.refused + ". Nothing was done.");
    if (std::isnan(value)) return {};
    if (wire.unit != 1) {
        if (std::fabs(value) <= max_volts) return {};
        return fail(ErrorKind::refused,
                    fmt::format("{} cannot be driven with {} V; the voltage must be -{} to {} V. Nothing was done.",
                                name, value, max_volts, max_volts));
    }
    if (wire.bits > 1) {
        const double half_range = std::ldexp(1.0, wire.bits - 1);
        if (value >= -half_range && value < half_range && value == std::floor(value)) return {};
        return fail(
            ErrorKind::refused,
            fmt::format("{} cannot be driven with {}: the value must be whole, {:.0f} to {:.0f}. Nothing was done.",
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
    const AccessibleWire& known = *find(name);
    const PartWire& wire = known.wire;
    const bool released = std::isnan(value);
    const int level = released ? 0 : static_cast<int>(std::floor(value / wire.unit + 0.5));
    rack_.input_log().add({rack_.kernel().now(), released ? sim::InputKind::release_wire : sim::InputKind::force_wire,
                           static_cast<std::uint16_t>(wire.id), 0, static_cast<std::uint16_t>(level != 0),
                           static_cast<double>(level)});
    if (released)
        release(known);
    else
        drive(known, level);
    rack_.kernel().settle();
    return {};
}

void WireAccess::drive(const AccessibleWire& known, int level) {
    sim::Kernel& kernel = rack_.kernel();
    if (known.encoder >= 0) {
        EncoderInput& input = encoders_[static_cast<std::size_t>(known.encoder)];
        if (input.driven == 0) {
            // Its lines keep their levels, so that disconnecting it counts nothing.
            rack_.cards()[static_cast<std::size_t>(input.link.card)]->motion()->take_encoder(input.link.channel, true);
            kernel.settle();
        }
        input.driven |= 1u << known.which;
    }
    kernel.force(known.wire.id, level);
}

void WireAccess::release(const AccessibleWire& known) {
    if (known.encoder < 0) return rack_.kernel().release(known.wire.id);
    EncoderInput& input = encoders_[static_cast<std::size_t>(known.encoder)];
    if ((input.driven & 1u << known.which) == 0) return;
    input.driven &= ~(1u << known.which);
    if (input.driven != 0) return;
    rack_.cards()[static_cast<std::size_t>(input.link.card)]->motion()->take_encoder(input.link.channel, false);
}

}  // namespace motionrack::rack
