// Levels of the output pins, computed on demand or for their listeners.
//
//   xpp   ____/~~\____/~~\____   two-pulse mode: + on xpp, - on xpm; one-pulse mode: pulses on xpp, direction on xpm
//             |<>| half a period, but at most until the axis' next basic pulse
#include <motionrack/cards/mcx314/chip/output_pins.hpp>

namespace motionrack::mcx314 {

void OutputPins::set_general_outputs() {
    for (int a = 0; a < axes_of_chip; ++a)
        for (int i = 0; i < 4; ++i) kernel_.set_wire(wires_.general_outputs[a][i], state_.bus.wr4 >> (4 * a + i) & 1);
}

int OutputPins::pulse_level(int a, int which, bool pulse, int direction) const {
    const Axis& axis = state_.axis[a];
    const bool one_pulse = wr2::PLSMD.test(axis.wr2), negative = wr2::PLSL.test(axis.wr2),
               high_is_plus = wr2::DIRL.test(axis.wr2);
    if (em::POINV.test(state_.extension[a].em6)) which = 1 - which;
    if (one_pulse && which == 1) return (axis.direction > 0) == high_is_plus;
    return (pulse && (one_pulse || (direction > 0) == (which == 0))) != negative;
}

/// Returns the level of nOUT4..7: the bit of WR3, or by OUTSL the drive's status CMP+, CMP-, ASND, DSND.
int OutputPins::output_level(int a, int output) const {
    static constexpr std::array<Field, 4> shown = {rr1::CMPP, rr1::CMPM, rr1::ASND, rr1::DSND};
    const Axis& axis = state_.axis[a];
    if (wr3::OUTSL.test(axis.wr3)) return shown[output - 4].test(status_.status1(a));
    return (axis.wr3 & wr3::OUT4.mask << (output - 4)) != 0;
}

/// Returns the level of nDRIVE: High while the axis is busy, or by DCCE the deviation counter clear pulse.
int OutputPins::drive_level(int a, std::int64_t at) const {
    const Extension& ext = state_.extension[a];
    return em::DCCE.test(ext.em7) ? (at < ext.clear_until) != em::DCCL.test(ext.em7) : state_.busy(a);
}

int OutputPins::level_at(int pin, std::int64_t at) const {
    const int a = (pin - ChipWires::output_pin) / 16, which = (pin - ChipWires::output_pin) % 16;
    if (which == 2) return drive_level(a, at);
    if (which >= 8) return output_level(a, which - 8);
    const PulseMark mark = law_.mark_at(a, at);
    return pulse_level(a, which, mark.active(at), mark.direction);
}

/// Determines the axes with listeners on their output wires; every pulse of such an axis is an event.
void OutputPins::note_followers() {
    state_.following = 0;
    for (int a = 0; a < axes_of_chip; ++a) {
        Axis& axis = state_.axis[a];
        const bool pulses = kernel_.wanted(wires_.pulses[a][0]) || kernel_.wanted(wires_.pulses[a][1]);
        bool outputs = false;
        for (int i = 4; i < 8; ++i) outputs = outputs || kernel_.wanted(wires_.general_outputs[a][i]);
        axis.drive_wanted = kernel_.wanted(wires_.drives[a]);
        if (pulses != axis.pulses_wanted || outputs != axis.outputs_wanted) {
            requests_.forget_specials();
            axis.shown = axis.made;
        }
        axis.pulses_wanted = pulses;
        axis.outputs_wanted = outputs;
        if (pulses || outputs || axis.drive_wanted) state_.following |= 1u << a;
    }
}

/// Sets the output wires that have listeners to their levels.
void OutputPins::show(Instant now) {
    const std::int64_t at = tick_of(now);
    for (int a = 0; a < axes_of_chip; ++a) {
        Axis& axis = state_.axis[a];
        if (axis.pulses_wanted) {
            const bool fresh = axis.shown != axis.made;
            axis.shown = axis.made;
            for (int which = 0; which < 2; ++which) {
                const int level = pulse_level(a, which, axis.mark.active(at), axis.mark.direction);
                const int idle = pulse_level(a, which, false, axis.mark.direction);
                if (fresh && level != idle) kernel_.set_wire(wires_.pulses[a][which], idle);  // two pulses never merge
                kernel_.set_wire(wires_.pulses[a][which], level);
            }
        }
        if (axis.drive_wanted) kernel_.set_wire(wires_.drives[a], drive_level(a, at));
        if (axis.outputs_wanted)
            for (int i = 4; i < 8; ++i) kernel_.set_wire(wires_.general_outputs[a][i], output_level(a, i));
    }
}

}  // namespace motionrack::mcx314
