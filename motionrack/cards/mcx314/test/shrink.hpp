// Shrinks a failing program: drops ops while it still fails.
#pragma once

#include <algorithm>
#include <cstddef>
#include <motionrack/cards/mcx314/test/program.hpp>

namespace motionrack::mcx314::twin {

/// `fails(program)`: true while the fault occurs. Tries at most `max_tries` programs.
template <class Fails>
Program shrink(Program program, const Fails& fails, int max_tries = 3000) {
    for (std::size_t piece = std::max<std::size_t>(program.ops.size() / 2, 1); max_tries > 0;) {
        bool dropped = false;
        for (std::size_t at = 0; at < program.ops.size() && max_tries > 0; --max_tries) {
            Program smaller = program;
            const auto from = smaller.ops.begin() + static_cast<std::ptrdiff_t>(at);
            smaller.ops.erase(from, from + static_cast<std::ptrdiff_t>(std::min(piece, program.ops.size() - at)));
            if (!smaller.ops.empty() && fails(smaller)) {
                program = std::move(smaller);
                dropped = true;
            } else {
                at += piece;
            }
        }
        if (piece == 1 && !dropped) break;
        if (!dropped || piece > program.ops.size()) piece = std::max<std::size_t>(piece / 2, 1);
    }
    return program;
}

}  // namespace motionrack::mcx314::twin
