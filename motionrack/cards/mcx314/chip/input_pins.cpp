// Subscribes to the wires of those input pins that matter, and holds their levels.
#include <motionrack/cards/mcx314/chip/input_pins.hpp>

namespace motionrack::mcx314 {

/// Subscribes to the inputs that matter to axis `a`. A disabled input is not subscribed, so a wire that is computed on
/// demand (an index) costs no time.
void InputPins::set_wants(int a) {
    Axis& axis = state_.axis[a];
    const unsigned filtered = state_.extension[a].filtered, also = extended_ ? inputs_of_extension(a) : 0u;
    auto set = [&](Pin pin, bool wanted) {
        const int i = static_cast<int>(pin);
        wanted = wanted || bit(also, i);
        kernel_.subscribe(wires_.inputs[a][i], id_, wanted);
        if (bit(filtered, i)) return;  // its level is that of the filter
        set_level(axis.levels, i, !wanted || kernel_.level(wires_.inputs[a][i]) != 0);
    };
    for (int i = 0; i < 4; ++i) set(static_cast<Pin>(i), stop_input_enabled(axis, i));
    set(Pin::exp_plus, drives_by_wire(axis.wr3));
    set(Pin::exp_minus, drives_by_wire(axis.wr3));
    set(Pin::in_position, wr2::INPE.test(axis.wr2));
    set(Pin::alarm, wr2::ALME.test(axis.wr2));
    set(Pin::limit_plus, true);
    set(Pin::limit_minus, true);
    for (int i = 0; i < 2; ++i) kernel_.subscribe(wires_.encoders[a][i], id_, true);
}

/// Returns the pins, bit Pin, whose wires MCX314As functions need.
unsigned InputPins::inputs_of_extension(int a) const {
    const Extension& ext = state_.extension[a];
    unsigned pins = ext.filtered;
    if (bit(state_.homing, a)) pins |= pin_mask(Pin::in0) | pin_mask(Pin::in1) | pin_mask(Pin::in2);
    if (em::EPCLR.test(ext.em6)) pins |= pin_mask(Pin::in2);
    if (turns_by_wire(a)) pins |= pin_mask(Pin::exp_plus) | pin_mask(Pin::exp_minus);
    if (sm::IN3UP.test(ext.sm6) || sm::IN3DN.test(ext.sm6)) pins |= pin_mask(Pin::in3);
    return pins;
}

/// Returns the eight input levels of one axis, as RR4 and RR5 show them; filtered inputs show the output of the filter.
std::uint16_t InputPins::input_levels(int a) const {
    const unsigned filtered = state_.extension[a].filtered;
    unsigned v = state_.axis[a].levels & filtered & 0xFFu;
    for (int i = 0; i < 8; ++i)
        if (!bit(filtered, i)) v |= static_cast<unsigned>(kernel_.level(wires_.inputs[a][i]) != 0) << i;
    return static_cast<std::uint16_t>(v);
}

/// Returns true if nEXPP and nEXPM are the lines A and B of a hand wheel.
bool InputPins::turns_by_wire(int a) const {
    return extended_ && external_mode(state_.axis[a].wr3) == external_wheel;
}

/// Notes a change of an axis' input (`pin`: 16 * axis + Pin): if it is nEXPP or nEXPM, the next tick samples it.
void InputPins::hear_external(int pin) {
    const int which = pin % 16;
    if (which == static_cast<int>(Pin::exp_plus) || which == static_cast<int>(Pin::exp_minus))
        state_.sampled |= 1u << pin / 16;
}

void InputPins::hear_step_wire(int wire_level) {
    state_.steps.high = wire_level != 0;
    if (!state_.steps.high || state_.steps.low != 0) state_.sampled |= step_wire;
}

}  // namespace motionrack::mcx314
