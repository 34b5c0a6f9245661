// Synchronous actions of an MCX314As: a condition of one axis makes this and other axes act, in the same tick.
#include <motionrack/cards/mcx314/chip/synchronous_actions.hpp>
#include <utility>

namespace motionrack::mcx314 {

namespace {

/// Actions (SM7) that are commands.
struct Act {
    Field action;
    int code;
};
constexpr std::array<Act, 4> sets = {
    {{sm::LPSET, cmd::LP}, {sm::EPSET, cmd::EP}, {sm::OPSET, cmd::P}, {sm::VLSET, cmd::V}}};
constexpr std::array<Act, 4> drives = {{{sm::FDRVP, cmd::FIXED_PLUS},
                                        {sm::FDRVM, cmd::FIXED_MINUS},
                                        {sm::CDRVP, cmd::CONTINUOUS_PLUS},
                                        {sm::CDRVM, cmd::CONTINUOUS_MINUS}}};

/// Returns the axes, one bit each, that act on a condition of axis `a`.
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

/// Executes the actions of all conditions noted so far; called at the end of a tick or a write. Conditions that these
/// actions cause are handled in the next tick.
void SynchronousActions::act() {
    unsigned acting = 0;
    for_each_axis(std::exchange(state_.acting, 0u), [&](int a) { acting |= acting_with(a, state_.extension[a]); });
    for_each_axis(state_.working, [&](int a) { forward_.bring_up(a, state_.tick); });
    for_each_axis(acting, [&](int a) { act_alone(a); });
    requests_.look_anew();
    requests_.forget_specials();
    if (state_.acting != 0) requests_.wake();
    requests_.make_stale();
}

/// Executes the commands of SM7 as if the host had written them.
void SynchronousActions::act_alone(int a) {
    Extension& ext = state_.extension[a];
    Axis& axis = state_.axis[a];
    auto asked = [&ext](Field action) { return action.test(ext.sm7); };
    if (asked(sm::LPSAV)) ext.buffer = static_cast<std::uint32_t>(axis.lp);
    if (asked(sm::EPSAV)) ext.buffer = static_cast<std::uint32_t>(encoders_.position(axis, a));
    for (const Act& each : sets)
        if (asked(each.action)) commands_.data_write(each.code, a);
    if (asked(sm::OPSET) && axis.gen.drive == Drive::fixed) generators_.check_final(a);
    if (asked(sm::SSTOP)) drives_.ask_stop(1u << a, false);
    if (asked(sm::ISTOP)) drives_.ask_stop(1u << a, true);
    for (const Act& each : drives)
        if (asked(each.action)) drives_.command(each.code, 1u << a);
    if (asked(sm::OUT)) homes_.ask_clear(a);
    if (asked(sm::INT)) axis.flags |= rr3::SYNC.mask;
}

}  // namespace motionrack::mcx314
