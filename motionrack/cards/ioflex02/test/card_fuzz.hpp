// Fuzzer of the card: a stream of numbers becomes accesses to any register, levels at any wire, images and passing
// time. The invariants are checked after each.
//
//   numbers stay in range   24 bits of position and time; statuses are those of the state table; X7 stays 0
//   counts come from edges  the raw count moves at most one for each change of A or B, and not at all without a project
//   no project, no effect   its registers read FFFFh, outputs are 0
//   peeking is free         a peek changes nothing, and returns the value of a read
//   it stays alive          in the end a reloaded card counts 100 and calibrates at an index
#pragma once

#include <cstdint>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>

namespace motionrack::ioflex02::fuzz {

using motionrack::fuzz::Feed;

/// Result of a run.
struct Verdict {
    std::string problem;  ///< "" or the violated invariant
    std::int64_t accesses = 0;
    std::int64_t counts = 0;   ///< counts in either direction, as observed between two accesses
    std::int64_t illegal = 0;  ///< illegal transitions observed
    std::int64_t images = 0;   ///< accepted images
    std::int64_t refused = 0;  ///< refused images
    double seconds = 0;        ///< virtual time
};

/// Runs `accesses` accesses on a new card, fewer if the feed is empty or an invariant is violated.
void run(Feed& feed, std::int64_t accesses, Verdict& verdict);

}  // namespace motionrack::ioflex02::fuzz
