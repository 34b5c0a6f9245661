// From a rack file's config to cards, parts and wires in one kernel.
#include <fmt/format.h>

#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/rack.hpp>

namespace motionrack::rack {

Rack::Rack(const RackConfig& config) : config_(config) {
    build_cards();
    build_axes();
    join_links();
    build_wires();
}

Rack::~Rack() = default;

Card* Rack::card(std::string_view name) {
    for (const auto& card : cards_)
        if (card->name() == name) return card.get();
    return nullptr;
}

void Rack::build_cards() {
    for (const RackCard& card : config_.cards) {
        const CardKind* kind = find_card_kind(card.type);
        MOTIONRACK_ASSERT(kind != nullptr);  // read_rack knows the same types
        cards_.push_back(kind->make(kernel_, card, log_, cards_));
    }
}

void Rack::build_axes() {
    for (const RackAxis& axis : config_.axes) {
        parts::AxisMachineSettings settings;
        settings.motor = {axis.motor_steps_per_rev, axis.microsteps, axis.motor.start_stop_hz, axis.motor.pull_out_hz};
        settings.axle.travel_per_rev =
            axis.kind == AxisKind::linear ? parts::linear_travel(axis.lead_mm) : parts::rotary_travel(axis.gear_ratio);
        settings.axle.start_position = axis.start_position;
        settings.encoder.counts_per_rev = axis.encoder_counts_per_rev;
        auto set = [&](parts::LimitSwitchSettings& which, const std::optional<double>& position) {
            which.position = position;
            which.hysteresis = axis.switches.hysteresis;
            which.bounce = from_seconds(axis.switches.bounce_ms * 1e-3);
        };
        set(settings.limit_minus, axis.switches.limit_minus);
        set(settings.limit_plus, axis.switches.limit_plus);
        set(settings.home, axis.switches.home);
        RunningAxis running;
        running.config = axis;
        running.card = card(axis.card);
        MOTIONRACK_ASSERT(running.card != nullptr);
        running.channel = running.card->channel_number(axis.channel);
        running.machine = std::make_unique<parts::AxisMachine>(kernel_, std::string(1, axis.letter), settings);
        axes_.push_back(std::move(running));
    }
}

void Rack::join_links() {
    std::vector<sim::Motion*> pulses(axes_.size(), &still_);
    for (const PulseLink& link : config_.pulse_links)
        pulses[static_cast<std::size_t>(link.axis)] = &cards_[static_cast<std::size_t>(link.card)]->pulses(link.channel);
    for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].machine->connect(*pulses[i]);
    for (const EncoderLink& link : config_.encoder_links) {
        sim::Motion* counts = &axes_[static_cast<std::size_t>(link.axis)].machine->encoder();
        if (link.swapped) {
            mirrored_.push_back(std::make_unique<MirroredMotion>(*counts));
            counts = mirrored_.back().get();
        }
        cards_[static_cast<std::size_t>(link.card)]->connect_encoder(link.channel, *counts);
    }
}

/// The name of an end's wire in the kernel. Pulses and encoder tracks of an axis have none: they are links.
std::string Rack::wire_name(const WireEnd& end) const {
    switch (end.owner) {
        case EndOwner::card: return config_.cards[static_cast<std::size_t>(end.index)].name + "." + end.pin;
        case EndOwner::axis: return std::string(1, config_.axes[static_cast<std::size_t>(end.index)].letter) + "." + end.pin;
        case EndOwner::estop: return "estop";
    }
    return {};
}

void Rack::build_wires() {
    kernel_.add_wire("estop", 1);
    junctions_ = std::make_unique<sim::Junctions>(kernel_, "wiring");
    for (const RackWire& wire : config_.wires) {
        if (is_link(wire)) continue;
        const sim::WireId from = kernel_.find_wire(wire_name(wire.from));
        const sim::WireId to = kernel_.find_wire(wire_name(wire.to));
        MOTIONRACK_ASSERT(from != sim::WireId::none && to != sim::WireId::none);
        junctions_->join(from, to);
    }
}

void Rack::start() {
    kernel_.start();
    started_ = true;
    while (kernel_.run_until(kernel_.now()) == sim::RunEnd::broken) {
    }
}

Result<control::PathAxes*> Rack::path_axes() {
    if (axes_.empty())
        return fail(Trouble::refused, "The rack has no axes, so no program can run on it; add an [axis.X] section to the rack file.");
    for (const RunningAxis& axis : axes_)
        if (axis.card != axes_.front().card)
            return fail(Trouble::refused, fmt::format("Axis {} is on card '{}' and axis {} on card '{}', but a path is followed by the axes of "
                                                      "one card. Nothing was moved; put them on one card.",
                                                      axes_.front().config.letter, axes_.front().config.card, axis.config.letter,
                                                      axis.config.card));
    return axes_.front().card->path_axes(config_, start_position());
}

void Rack::on_slice(Duration slice, std::function<void()> call) {
    for (const auto& card : cards_) card->host().on_slice(slice, call);
}

void Rack::set_stop_flag(const std::atomic<bool>* stop) {
    for (const auto& card : cards_) card->host().set_stop_flag(stop);
}

control::Point Rack::start_position() const {
    control::Point out = {};
    for (const RackAxis& axis : config_.axes) out[static_cast<std::size_t>(axis.index())] = axis.start_position;
    return out;
}

std::string Rack::describe(const sim::Condition& condition) {
    if (condition.device == sim::no_device)
        return fmt::format("{}: at {:.6f} s this wire leads back to what drives it and did not come to rest after {} changes; it was left as "
                           "it was. Look at the section [wires] of the rack file",
                           kernel_.wire_name(static_cast<sim::WireId>(condition.a)), to_seconds(condition.at), condition.b);
    for (const RunningAxis& axis : axes_)
        if (axis.machine->id() == condition.device) return parts::describe(condition, kernel_.device_name(condition.device));
    for (const auto& card : cards_)
        if (card->device() == condition.device) return card->describe(condition);
    return fmt::format("{}: condition {} ({}, {})", kernel_.device_name(condition.device), condition.code, condition.a, condition.b);
}

}  // namespace motionrack::rack
