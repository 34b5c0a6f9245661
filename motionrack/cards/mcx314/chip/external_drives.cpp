// Wires with commands: nEXPP and nEXPM for drives, EXPLSN for single steps (RULES.md, "Single steps" and "Drives by
// nEXPP and nEXPM").
//
//   nEXPP  ~~~~~~\____________/~~~~~~     f, f + 1: the first two ticks at which it is Low; g: the first at High
//                 f f+1        g
//   EXOP 2            20h                 after all generators have executed tick f + 1
//   EXOP 1            22h      26h
//   EXOP 3 (MCX314As): nEXPP rises: 20h, falls: 21h, while nEXPM is Low
#include <motionrack/cards/mcx314/chip/external_drives.hpp>
#include <utility>

namespace motionrack::mcx314 {

namespace {

/// Counts the ticks at which an input is Low; returns true at the second one.
bool falls(std::uint8_t& low, bool high) {
    if (high)
        low = 0;
    else if (low < 2)
        return ++low == 2;
    return false;
}

}  // namespace

/// Applies the external drive mode in WR3 of axis `a`, whose previous word was `before`.
void ExternalDrives::change_mode(int a, std::uint16_t before) {
    Axis& axis = state_.axis[a];
    if (external_mode(axis.wr3) == external_mode(before)) return;
    if (external_mode(before) == external_wheel) axis.external_low = {2, 2};
    if (axis.external != 0 && external_mode(axis.wr3) != external_continuous) axis.gen.ask_decelerating = true;
    if (drives_by_wire(axis.wr3))
        state_.sampled |= 1u << a;
    else
        axis.external_low = {2, 2};
    inputs_.set_wants(a);
    if (inputs_.turns_by_wire(a)) axis.external_low[0] = level(axis, Pin::exp_plus) ? 0 : 2;
}

/// Executes, after a tick, the drives and steps that the changed wires request.
void ExternalDrives::execute_requests() {
    const std::uint32_t sampled = std::exchange(state_.sampled, 0u);
    for_each_axis(sampled & (InputPins::step_wire - 1), [this](int a) {
        if (drives_by_wire(state_.axis[a].wr3)) sample_drive(a);
        if (inputs_.turns_by_wire(a)) sample_wheel(a);
    });
    if (!(sampled & InputPins::step_wire)) return;
    if (falls(state_.steps.low, state_.steps.high)) generators_.ask_step(PathCommand::by_wire);
    if (state_.steps.low == 1) state_.sampled |= InputPins::step_wire;
}

void ExternalDrives::sample_drive(int a) {
    Axis& axis = state_.axis[a];
    const bool continuous = external_mode(axis.wr3) == external_continuous;
    for (int minus = 0; minus < 2; ++minus) {
        const bool high = level(axis, minus ? Pin::exp_minus : Pin::exp_plus);
        const bool rises = high && axis.external_low[minus] > 0;
        if (falls(axis.external_low[minus], high) && !state_.driving(a) && !axis.hold) {
            drives_.start(a, drive_code(continuous ? Drive::continuous : Drive::fixed, minus ? -1 : 1));
            if (continuous) axis.external = static_cast<std::uint8_t>(1 + minus);
        }
        if (rises && axis.external == 1 + minus) {
            axis.gen.ask_decelerating = true;
            axis.gen.full_tick = true;
        }
        if (axis.external_low[minus] == 1) state_.sampled |= 1u << a;
    }
}

/// Evaluates the hand wheel: while line B (nEXPM) is Low, a rising line A (nEXPP) drives P pulses in + direction, a
/// falling one in - direction.
void ExternalDrives::sample_wheel(int a) {
    Axis& axis = state_.axis[a];
    const bool high = level(axis, Pin::exp_plus), was_high = axis.external_low[0] == 0;
    axis.external_low[0] = high ? 0 : 2;
    if (high == was_high || level(axis, Pin::exp_minus) || state_.driving(a) || axis.hold) return;
    drives_.start(a, drive_code(Drive::fixed, high ? 1 : -1));
}

}  // namespace motionrack::mcx314
