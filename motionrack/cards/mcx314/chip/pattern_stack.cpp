// Bit patterns: a word of 16 steps runs, up to three wait on the stack (RULES.md, "Bit pattern").
//
//   36h  WR2..WR7 = BP1P BP1M BP2P BP2M BP3P BP3M  37h
//                    │ 38h
//                    ▼            BPSC = 3      2      1
//                 registers ──► stack: oldest .. newest ──► running word ──► D0 first: steps of AX1 AX2 AX3
#include <algorithm>
#include <motionrack/cards/mcx314/chip/chip_conditions.hpp>
#include <motionrack/cards/mcx314/chip/pattern_stack.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

void PatternStack::execute(int code) {
    switch (code) {
        case cmd::BP_ENABLE:
        case cmd::BP_DISABLE:
            pattern_.writable = code == cmd::BP_ENABLE;
            break;
        case cmd::BP_STACK:
            stack();
            break;
        default:
            clear();
            break;
    }
}

void PatternStack::stack() {
    pattern_.interrupt = false;
    if (pattern_.stacked >= Pattern::depth) return kernel_.report(id_, pattern_full);
    pattern_.stack[pattern_.stacked++] = pattern_.registers;
}

void PatternStack::clear() {
    pattern_.stacked = 0;
    pattern_.place = Pattern::length;
}

void PatternStack::next_word(std::int64_t made, bool interrupts) {
    const int before = pattern_.stacked;
    pattern_.place = Pattern::length;
    if (pattern_.stacked > 0) {
        pattern_.running = pattern_.stack[0];
        std::rotate(pattern_.stack.begin(), pattern_.stack.begin() + 1, pattern_.stack.end());
        --pattern_.stacked;
        pattern_.place = 0;
    } else {
        kernel_.report(id_, pattern_ran_out, made);
    }
    if (before == 2 && pattern_.stacked == 1 && interrupts) pattern_.interrupt = true;
}

}  // namespace motionrack::mcx314
