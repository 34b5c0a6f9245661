// Constructs a card, and handles its wires, reset and faults.
#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <motionrack/cards/grating_bus/model/card.hpp>

namespace motionrack::grating_bus {

Card::Card(sim::Kernel& kernel, const std::string& name, Bus& bus, const CardSettings& settings)
    : kernel_(kernel),
      settings_(settings),
      bus_(bus),
      id_(kernel.add(*this, sim::Phase::cards, name)),
      errors_(state_.errors, kernel, id_),
      pulses_(state_.pulses, state_.sequence, state_.jitter, settings_, errors_),
      lines_(state_.outputs, settings_),
      age_(state_.age, state_.stale, settings_, errors_),
      frames_(state_, settings_, errors_),
      wires_(kernel, id_, name, state_.fresh) {
    MOTIONRACK_ASSERT(check(settings).has_value());
    age_.begin();
    if (is_host()) pulses_.begin();
    bus.plug(*this);
}

// ---- wires

int Card::level_at(int pin, Instant) const {
    const State state = moment().state;
    return pin == CardWires::state_pin ? static_cast<int>(state) : state == State::S12;
}

void Card::wanted_changed(int, bool wanted, Instant now) {
    bus_.wanted(wanted, now);
}

// ---- reset and faults

// Resets the logic. The buffers, the claim and the age of the frame survive.
void Card::reset() {
    frames_.abandon();
    CardState begun;
    begun.buffers = state_.buffers;
    begun.fresh = state_.fresh;
    begun.stale = state_.stale, begun.age = state_.age;
    begun.pulses.number = state_.pulses.number, begun.pulses.next = state_.pulses.next;
    begun.miss = state_.miss, begun.late = state_.late, begun.jitter = state_.jitter;
    begun.off = state_.off;
    begun.outputs.quiet = 1;
    state_ = begun;
    wires_.show(state_.fsm);
}

bool Card::fault(std::string_view name, double value, Instant now) {
    const bool whole_tick = value >= 0 && value <= 1e9;
    const auto ns = [&] { return Duration{static_cast<std::int64_t>(value * 10 + 0.5)}; };
    const bool host_only = name == "jitter", slave_only = name == "late" || name == "miss_edge";
    if (!whole_tick || (host_only && !is_host()) || (slave_only && is_host())) return false;
    if (host_only && ns() >= settings_.period / 2) return false;
    if (name != "off" && name != "reset" && !host_only && !slave_only) return false;
    bus_.interrupt_span(now);
    if (name == "off" && (value != 0) != (state_.off != 0)) {
        state_.off = value != 0 ? 1 : 0;
        reset();
    } else if (name == "reset" && value != 0 && state_.off == 0) {
        reset();
    } else if (name == "late") {
        state_.late = ns();
    } else if (name == "miss_edge") {
        state_.miss = static_cast<std::uint32_t>(value);
    } else if (name == "jitter") {
        pulses_.set_jitter(ns(), now);
    }
    bus_.look_again(now);
    return true;
}

}  // namespace motionrack::grating_bus
