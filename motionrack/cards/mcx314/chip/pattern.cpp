// Bit patterns: a word of 16 steps runs, up to three wait on the stack (RULES.md, "Bit pattern").
//
//   36h  WR2..WR7 = BP1P BP1M BP2P BP2M BP3P BP3M  37h
//                    │ 38h
//                    ▼            BPSC = 3      2      1
//                 registers ──► stack: oldest .. newest ──► running word ──► D0 first: steps of AX1 AX2 AX3
#include <algorithm>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

void Chip::pattern_command(int code) {
    switch (code) {
        case cmd::BP_ENABLE:
        case cmd::BP_DISABLE:
            state_.pattern.writable = code == cmd::BP_ENABLE;
            break;
        case cmd::BP_STACK:
            stack_pattern();
            break;
        default:
            clear_pattern();
            if (state_.chain != 0) requests_.law_changed_of(state_.master);
            break;
    }
}

/// RR0.BPSC.
int Chip::pattern_counter() const {
    return state_.pattern.stacked;
}

void Chip::stack_pattern() {
    Pattern& pattern = state_.pattern;
    pattern.interrupt = false;
    if (pattern_counter() >= Pattern::depth) return kernel_.report(id_, pattern_full);
    pattern.stack[pattern.stacked++] = pattern.registers;
}

void Chip::clear_pattern() {
    state_.pattern.stacked = 0;
    state_.pattern.place = Pattern::length;
}

/// Makes the oldest stacked word, if any, the running one; requires that all steps of the running word are made.
void Chip::next_pattern_word() {
    Pattern& pattern = state_.pattern;
    const int before = pattern_counter();
    pattern.place = Pattern::length;
    if (pattern.stacked > 0) {
        pattern.running = pattern.stack[0];
        std::rotate(pattern.stack.begin(), pattern.stack.begin() + 1, pattern.stack.end());
        --pattern.stacked;
        pattern.place = 0;
    } else {
        kernel_.report(id_, pattern_ran_out, state_.axis[state_.master].gen.n);
    }
    if (before == 2 && pattern_counter() == 1 && wr5::BPINT.test(state_.wr5)) pattern.interrupt = true;
    requests_.law_changed_of(state_.master);
}

/// Executes a basic pulse of a bit pattern; returns the number of axes that stepped, at least one.
int Chip::step_pattern() {
    Pattern& pattern = state_.pattern;
    const PathCommand& command = state_.path.command;
    if (pattern.ends(command.count, pattern.place)) return clear_pattern(), 1;
    int moved = 0;
    for (int i = 0; i < command.count; ++i)
        if (const int step = pattern.step(i, pattern.place); step != 0)
            move(command.axis[i], step, state_.tick), ++moved;
    if (++pattern.place == Pattern::length) next_pattern_word();
    look_ahead_in_pattern();
    return std::max(1, moved);
}

/// Sets the directions of the axes to those of their next steps.
void Chip::look_ahead_in_pattern() {
    const Pattern& pattern = state_.pattern;
    const PathCommand& command = state_.path.command;
    for (int i = 0; i < command.count; ++i) {
        int direction = 0;
        for (int at = pattern.place; at < Pattern::length && direction == 0 && !pattern.ends(command.count, at); ++at)
            direction = pattern.step(i, at);
        Axis& axis = state_.axis[command.axis[i]];
        if (direction == 0 || direction == axis.direction) continue;
        axis.direction = direction;
        state_.axis[state_.master].gen.full_tick = true;  // the opposite limit applies
    }
}

}  // namespace motionrack::mcx314
