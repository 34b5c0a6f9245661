// Which conditions are selected in SM6, and which comparisons are therefore evaluated.
#include <motionrack/cards/mcx314/chip/action_conditions.hpp>

namespace motionrack::mcx314 {

namespace {

/// Fields of one comparison: the condition in SM6 and the interrupt in RR3.
struct Comparison {
    Field condition, interrupt;
};
constexpr std::array<Comparison, 4> comparisons = {
    {{sm::PGECP, rr3::PGECP}, {sm::PLCP, rr3::PLCP}, {sm::PLCM, rr3::PLCM}, {sm::PGECM, rr3::PGECM}}};

}  // namespace

/// Notes that `condition` (a field of SM6) has occurred on axis `a`. If SM6 of `a` selects it, axis `a` and the axes
/// that SM6 names act at the end of the tick or write.
void ActionConditions::note(int a, Field condition) {
    Extension& ext = state_.extension[a];
    if (!condition.test(ext.sm6)) return;
    state_.acting |= 1u << a;
}

/// Notes the comparisons of axis `a` that have become true; `risen`: bits of RR3.
void ActionConditions::note_comparisons(int a, unsigned risen) {
    for (const Comparison& each : comparisons)
        if (each.interrupt.test(risen)) note(a, each.condition);
}

/// Updates the comparisons that axis `a` must evaluate: those that WR1 enables as interrupts or SM6 selects as
/// conditions.
void ActionConditions::hear_comparisons(int a) {
    Axis& axis = state_.axis[a];
    const unsigned conditions = state_.extension[a].sm6;
    unsigned enabled = axis.wr1 >> enable_shift & rr3::comparisons.mask;
    for (const Comparison& each : comparisons)
        if (each.condition.test(conditions)) enabled |= each.interrupt.mask;
    axis.comparisons = static_cast<std::uint16_t>(enabled);
}

}  // namespace motionrack::mcx314
