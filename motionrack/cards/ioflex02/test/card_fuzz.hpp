// Any word to any register, any level at any wire and any image at any time: a stream of numbers becomes accesses,
// wires, images and passing time on a card, and what must always hold is checked after each.
//
//   numbers stay in range   24 bits of position and time; statuses are those of the state table; X7 stays 0
//   counts come from edges  the raw count moves at most one for each change of A or B, and not at all without a project
//   no project, no effect   its registers read FFFFh, outputs are 0
//   looking is free         a peek changes nothing, and reads what a read reads
//   it stays alive          in the end a card that is loaded anew counts 100 and calibrates at an index
#pragma once

#include <cstdint>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>

namespace motionrack::ioflex02::fuzz {

using motionrack::fuzz::Feed;

/// What a run came to.
struct Verdict {
    std::string problem;  ///< "" or what does not hold
    std::int64_t accesses = 0;
    std::int64_t counts = 0;   ///< in either direction, as far as they were seen between two accesses
    std::int64_t illegal = 0;  ///< transitions that were seen
    std::int64_t images = 0;   ///< that were taken
    std::int64_t refused = 0;  ///< images
    double seconds = 0;        ///< virtual time
};

/// Runs `accesses` accesses on a card of its own, fewer if the feed is empty or something does not hold.
void run(Feed& feed, std::int64_t accesses, Verdict& verdict);

}  // namespace motionrack::ioflex02::fuzz
