// Synchronous actions of an MCX314As: a condition of one axis makes it and others act, in the same tick.
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <utility>

namespace motionrack::mcx314 {

namespace {

/// The axes that act when axis `a` is the one with the condition.
unsigned acting_with(int a, const Extension& ext) {
    unsigned axes = 1u << a;
    int place = 0;
    for (int other = 0; other < axes_of_chip; ++other) {
        if (other == a) continue;
        if (bit(sm::AXIS.get(ext.sm6), place)) axes |= 1u << other;
        ++place;
    }
    return axes;
}

}  // namespace

/// A condition has come: axes act at the end of the tick or write.
void Chip::note(int a, Field condition) {
    Extension& ext = state_.extension[a];
    if (!condition.test(ext.sm6)) return;
    state_.acting |= 1u << a;
}

/// Comparisons of RR3 D1..D4 have become true; those of SM6 D3..D0 are the same.
void Chip::note_comparisons(int a, unsigned risen) {
    for (int i = 0; i < 4; ++i)
        if (bit(risen, 4 - i)) note(a, Field{static_cast<std::uint16_t>(1u << i)});
}

/// Which comparisons anybody hears of.
void Chip::hear_comparisons(int a) {
    Axis& axis = state_.axis[a];
    const unsigned conditions = state_.extension[a].sm6;
    unsigned heard = axis.wr1 >> 8 & 0x1Eu;
    for (int i = 0; i < 4; ++i)
        if (bit(conditions, i)) heard |= 1u << (4 - i);
    axis.comparisons = static_cast<std::uint16_t>(heard);
}

/// At the end of a tick or a write: what the conditions so far bring about. What these actions bring about comes later.
void Chip::act_together() {
    unsigned acting = 0;
    for_each_axis(std::exchange(state_.acting, 0u), [&](int a) { acting |= acting_with(a, state_.extension[a]); });
    for_each_axis(state_.working, [&](int a) { bring_up(a, state_.tick); });
    for_each_axis(acting, [&](int a) { act_alone(a); });
    for (Axis& axis : state_.axis) {
        axis.gen.look = true;
        axis.gen.special_known = false;
    }
    if (state_.acting != 0) wake();
    stale_ = true;
}

/// What SM7 says, as if the host had written it.
void Chip::act_alone(int a) {
    Extension& ext = state_.extension[a];
    Axis& axis = state_.axis[a];
    auto asked = [&ext](int action) { return bit(ext.sm7, action); };
    if (asked(6)) ext.buffer = static_cast<std::uint32_t>(axis.lp);
    if (asked(7)) ext.buffer = static_cast<std::uint32_t>(encoder_position(axis, a));
    static constexpr std::array<int, 4> sets = {cmd::LP, cmd::EP, cmd::P, cmd::V};
    for (int i = 0; i < 4; ++i)
        if (asked(8 + i)) data_write(sets[i], a);
    if (asked(10) && axis.gen.drive == Drive::fixed) check_final(a);
    if (asked(4)) ask_stop(1u << a, false);
    if (asked(5)) ask_stop(1u << a, true);
    for (int i = 0; i < 4; ++i)
        if (asked(i)) drive_command(0x20 + i, 1u << a);
    if (asked(14)) ask_clear(a);
    if (asked(15)) axis.flags = static_cast<std::uint16_t>(axis.flags | 1u << 9);
}

}  // namespace motionrack::mcx314
