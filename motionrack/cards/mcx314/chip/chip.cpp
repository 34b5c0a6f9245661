// The chip in the rack: time, wires, listeners and the encoders connected to EP.
#include <motionrack/cards/mcx314/chip/chip.hpp>

namespace motionrack::mcx314 {

// ---- construction

Chip::Chip(sim::Kernel& kernel, const std::string& name, const ChipOptions& options)
    : kernel_(kernel),
      id_(kernel.add(*this, sim::Phase::cards, name)),
      options_(options),
      extended_(options.extended()),
      wires_(kernel, id_, name) {
    for (int a = 0; a < axes_of_chip; ++a) {
        positions_[a].chip = encoder_listeners_[a].chip = this;
        positions_[a].axis = encoder_listeners_[a].axis = a;
    }
    for (int a = 0; a < axes_of_chip; ++a) {
        state_.axis[a].offset = options_.offset_after_reset;
        comparators_.compare(a);
    }
    state_.next_event = state_.sampling.next = far;
    kernel_.schedule(id_, Instant{0});
}

// ---- time

/// Publishes the changes of an event to the listeners, and schedules the next event in the kernel.
void Chip::settle(Instant now) {
    if (state_.acting != 0) requests_.wake();
    notifier_.notify(now);
    interrupts_.update();
    if (state_.following != 0) outputs_.show(now);
    if (requests_.stale()) events_.find_next();
    Instant next = state_.next_event > tick_of(never) ? never : Instant{state_.next_event * rules::tick_100ps};
    if (state_.crossed != 0) next = now + Duration{1};  // reports a range already left
    kernel_.schedule(id_, next);
}

void Chip::on_scheduled(Instant now) {
    if (!state_.begun) begin();
    events_.work_to(tick_of(now));
    settle(now);
}

/// Called once all wires are connected: determines the relevant wires and reads their levels.
void Chip::begin() {
    state_.begun = true;
    for (int a = 0; a < axes_of_chip; ++a) {
        inputs_.set_wants(a);
        encoders_.watch(a);
    }
    kernel_.subscribe(wires_.emergency, id_, true);
    state_.emergency_high = kernel_.level(wires_.emergency) != 0;
    kernel_.subscribe(wires_.step, id_, true);
    inputs_.hear_step_wire(kernel_.level(wires_.step));
    state_.sampling.emergency.wire = state_.emergency_high;
    state_.sampling.step.wire = state_.steps.high;
    outputs_.note_followers();
    requests_.make_stale();
}

/// Brings the chip up to `now` before its state is accessed from outside.
void Chip::catch_up(Instant now) {
    if (!state_.begun) begin();
    events_.advance_to(tick_of(now));
    notifier_.note_rates();
    requests_.make_stale();
}

/// Brings the chip up to the last tick before `now`, where an input changes: a change at the very instant of a tick
/// belongs to that tick.
void Chip::catch_up_before(Instant now) {
    events_.advance_to((now.count() + rules::tick_100ps - 1) / rules::tick_100ps - 1);
    notifier_.note_rates();
    requests_.make_stale();
}

void Chip::sync(Instant now) {
    events_.advance_to(tick_of(now));
    for (int a = 0; a < axes_of_chip; ++a)
        if (edges_.wanted(a)) edges_.flush(a);
}

void Chip::on_wire(int pin, int wire_level, Instant now) {
    if (!state_.begun) begin();
    catch_up_before(now);
    if (pin >= ChipWires::encoder_pin) return encoder_lines((pin - ChipWires::encoder_pin) / 2, now);
    if (extended_) {
        requests_.wake();
        if (!filters_.passes(pin, wire_level)) return settle(now);
    }
    if (pin == ChipWires::step_pin) {
        inputs_.hear_step_wire(wire_level);
        return settle(now);
    }
    if (pin == ChipWires::emergency_pin) {
        state_.emergency_high = wire_level != 0;
    } else {
        set_level(state_.axis[pin / 16].levels, pin % 16, wire_level != 0);
        inputs_.hear_external(pin);
    }
    requests_.look_anew();
    settle(now);
}

// ---- encoders

void Chip::connect_encoder(int a, sim::PositionFunction& counts) {
    encoders_.connect(a, counts, encoder_listeners_[a]);
}

void Chip::encoder_crossed(int a, Instant now) {
    catch_up_before(now);
    comparators_.compare(a);
    encoders_.watch(a);
    requests_.look_anew();
    settle(now);
}

void Chip::take_encoder(int a, bool taken) {
    if (!encoders_.has_encoder(a)) return;
    const Instant now = kernel_.now();
    catch_up(now);
    if (taken)
        encoders_.take(a, now);
    else
        encoders_.give_back(a);
    settle(now);
}

/// Counts a change of xeca or xecb of axis `a`, which has no connected encoder.
void Chip::encoder_lines(int a, Instant now) {
    if (!encoders_.count_lines(a)) return;
    comparators_.compare(a);
    requests_.look_anew();
    settle(now);
}

int Chip::level_at(int pin, Instant now) const {
    return outputs_.level_at(pin, tick_of(now));
}

void Chip::wanted_changed(int, bool, Instant now) {
    if (!state_.begun) return;
    catch_up(now);
    outputs_.note_followers();
    settle(now);
}

// ---- position sources

void Chip::set_edge_listener(int a, sim::EdgeListener* listener) {
    events_.advance_to(tick_of(kernel_.now()));
    edges_.set_listener(a, listener);
    requests_.forget_specials();
    requests_.make_stale();
    listeners_.heard =
        listener || listeners_.of_axis[a].size() > 0 ? listeners_.heard | 1u << a : listeners_.heard & ~(1u << a);
}

void Chip::deliver_edges(int a) {
    if (!edges_.wanted(a)) return;
    events_.advance_to(tick_of(kernel_.now()));
    edges_.flush(a);
}

void Chip::watch(int a, int slot, std::int64_t below, std::int64_t above) {
    Axis& axis = state_.axis[a];
    axis.watch[slot] = {below, above};
    requests_.forget_specials();
    requests_.make_stale();
    const Instant now = kernel_.now();
    if (axis.watch[slot].left(law_.count_at(a, now))) state_.crossed |= 1u << a;
    // In an event of the chip settle() follows anyway; otherwise it is requested at this very instant.
    kernel_.schedule(id_, state_.crossed != 0 ? now + Duration{1} : now);
}

std::int64_t Chip::pulses_made(int axis) {
    return state_.axis[axis].made;
}

}  // namespace motionrack::mcx314
