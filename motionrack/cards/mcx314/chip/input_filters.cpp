// Inputs of an MCX314As, once per tick: filters, and the edges for EPCLR and synchronous actions.
//
//   wire    ────┐  ┌─┐ ┌──────────────          delay D: the first differing sample is at tick n; if all up to
//               └──┘ └─┘                        tick n + D do, the chip sees the new level from tick n + D on
//   level   ─────────────────────────
//                      |<─ D ─>|
#include <motionrack/cards/mcx314/chip/input_filters.hpp>
#include <utility>

namespace motionrack::mcx314 {

namespace {

/// The pins with the filters FE0..FE4 of EM6.
constexpr std::array<unsigned, 5> filter_pins = {
    pin_mask(Pin::limit_plus) | pin_mask(Pin::limit_minus) | pin_mask(Pin::in0) | pin_mask(Pin::in1),
    pin_mask(Pin::in2),
    pin_mask(Pin::alarm) | pin_mask(Pin::in_position),
    pin_mask(Pin::exp_plus) | pin_mask(Pin::exp_minus),
    pin_mask(Pin::in3),
};
constexpr Field emergency_is_filtered = em::FE0, step_is_filtered = em::FE3;  // of X
constexpr unsigned edge_pins = pin_mask(Pin::in2) | pin_mask(Pin::in3);

std::int64_t delay_of(const Extension& ext) {
    return map::filter_ticks[em::FL.get(ext.em6)];
}

}  // namespace

/// Applies a write to EM of axis `a`: a new filter begins with the level of its wire, a disabled one ends.
void InputFilters::set(int a) {
    Extension& ext = state_.extension[a];
    unsigned pins = 0;
    for (std::size_t i = 0; i < filter_pins.size(); ++i)
        if ((ext.em6 & em::FE0.mask << i) != 0) pins |= filter_pins[i];
    const unsigned begun = pins & ~ext.filtered;
    ext.filtered = 0;
    for_each_axis(begun, [&](int pin) {
        const bool high = kernel_.level(wires_.inputs[a][pin]) != 0;
        set_level(ext.wires, pin, high);
        set_level(state_.axis[a].levels, pin, high);
        ext.since[pin] = -1;
    });
    ext.filtered = static_cast<std::uint16_t>(pins);
    if (a == 0 && !emergency_is_filtered.test(ext.em6)) state_.emergency_high = state_.sampling.emergency.wire != 0;
    if (a == 0 && !step_is_filtered.test(ext.em6)) inputs_.hear_step_wire(static_cast<int>(state_.sampling.step.wire));
    inputs_.set_wants(a);
    ext.sampled = state_.axis[a].levels;
    inputs_.hear_external(16 * a + static_cast<int>(Pin::exp_plus));
    requests_.wake();
}

/// Records a changed wire level (0, 1). Returns false if the pin has a filter, which passes the change on after its
/// delay.
bool InputFilters::passes(int pin, int wire_level) {
    const unsigned chip_filters = state_.extension[0].em6;
    if (pin == ChipWires::emergency_pin) {
        state_.sampling.emergency.wire = wire_level != 0;
        return !emergency_is_filtered.test(chip_filters);
    }
    if (pin == ChipWires::step_pin) {
        state_.sampling.step.wire = wire_level != 0;
        return !step_is_filtered.test(chip_filters);
    }
    Extension& ext = state_.extension[pin / 16];
    set_level(ext.wires, pin % 16, wire_level != 0);
    return !bit(ext.filtered, pin % 16);
}

/// Samples the inputs for tick `to`, before the tick is executed.
void InputFilters::sample(std::int64_t to) {
    state_.sampling.next = far;
    bool changed = sample_chip_filter(state_.sampling.emergency, emergency_is_filtered, state_.emergency_high, to);
    if (changed) state_.emergency_high = !state_.emergency_high;
    if (sample_chip_filter(state_.sampling.step, step_is_filtered, state_.steps.high, to))
        inputs_.hear_step_wire(state_.steps.high ? 0 : 1);
    for (int a = 0; a < axes_of_chip; ++a) {
        if (sample_axis(a, to)) changed = true;
        sample_edges(a);
        if (const std::int64_t end = state_.extension[a].clear_until; end > to)
            state_.sampling.next = std::min(state_.sampling.next, end);
    }
    if (changed) forward_.work_in_full(to);
}

/// Filters EMGN or EXPLSN, whose level in the chip is `seen`; returns true if that level must change.
bool InputFilters::sample_chip_filter(ChipFilter& filter, Field enable, bool seen, std::int64_t to) {
    const Extension& x = state_.extension[0];
    if (!enable.test(x.em6) || (filter.wire != 0) == seen) {
        filter.since = -1;
        return false;
    }
    if (filter.since < 0) filter.since = to;
    const std::int64_t end = filter.since + delay_of(x);
    if (end > to) {
        state_.sampling.next = std::min(state_.sampling.next, end);
        return false;
    }
    filter.since = -1;
    return true;
}

/// Samples the filtered pins of axis `a`; returns true if a level in the chip has changed.
bool InputFilters::sample_axis(int a, std::int64_t to) {
    Extension& ext = state_.extension[a];
    Axis& axis = state_.axis[a];
    bool changed = false;
    for_each_axis(ext.filtered, [&](int pin) {
        std::int64_t& since = ext.since[pin];
        if (bit(ext.wires, pin) == bit(axis.levels, pin)) {
            since = -1;
            return;
        }
        if (since < 0) since = to;
        const std::int64_t end = since + delay_of(ext);
        if (end > to) {
            state_.sampling.next = std::min(state_.sampling.next, end);
            return;
        }
        set_level(axis.levels, pin, bit(ext.wires, pin));
        inputs_.hear_external(16 * a + pin);
        since = -1;
        changed = true;
    });
    return changed;
}

/// Evaluates the edges of two inputs: an active IN2 clears EP if EPCLR is set, IN3 is a condition of synchronous
/// actions.
void InputFilters::sample_edges(int a) {
    Extension& ext = state_.extension[a];
    Axis& axis = state_.axis[a];
    const unsigned changed = (axis.levels ^ std::exchange(ext.sampled, axis.levels)) & edge_pins;
    if (changed == 0) return;
    if ((changed & pin_mask(Pin::in3)) != 0) conditions_.note(a, level(axis, Pin::in3) ? sm::IN3UP : sm::IN3DN);
    if ((changed & pin_mask(Pin::in2)) == 0 || !em::EPCLR.test(ext.em6)) return;
    if (!input_active(axis, 2)) return;
    encoders_.set_position(a, 0);
    if (!wr2::CMPSL.test(axis.wr2)) return;
    comparators_.compare(a);
    encoders_.watch(a);
    forward_.work_in_full(state_.tick);
}

}  // namespace motionrack::mcx314
