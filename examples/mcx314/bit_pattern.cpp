#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> bit_pattern(mcx314::Driver& card) {
    const unsigned axes = axis_x | axis_y;
    MOTIONRACK_CHECK(card.SetMultiple(axes, 1));
    mcx314::BPDATA speeds;
    speeds.V = 100;  // steps of the pattern a second
    MOTIONRACK_CHECK(card.BP2D(speeds, axes));
    const std::array<mcx314::BPWORD, 4> words = {{
        // X +     Y +              X -     Y -         the lowest bit is the first step
        {{0xFFFF, 0x5555}, {0x0000, 0x0000}},  // 16 to the right, 8 up
        {{0x1111, 0xFFFF}, {0x0000, 0x0000}},  // 4 to the right, 16 up
        {{0x0000, 0x0000}, {0xFFFF, 0x8888}},  // 16 to the left, 4 down
        {{0x0100, 0x0000}, {0x0100, 0x00FF}},  // 8 down; then X + and - at once: the end
    }};
    for (std::size_t i = 0; i < 3; ++i) MOTIONRACK_CHECK(card.BPStack(words[i]));
    MOTIONRACK_CHECK(card.BPStart());
    MOTIONRACK_CHECK(card.BPStack(words[3]));  // waits until there is room
    MOTIONRACK_CHECK(card.BPEnd());
    fmt::print("X {}, Y {}\n", card.ReadLPS(0), card.ReadLPS(1));
    return {};
}

}  // namespace howto
