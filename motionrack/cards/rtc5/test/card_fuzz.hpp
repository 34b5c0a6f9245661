// Fuzzer of the card: a stream of numbers becomes a job of commands, words, starts and files. The invariants are
// checked after each run.
//
//   outputs are in the field   20 bits, for every request
//   the gate is 0 .. 20        half-microseconds of a tick, and changes alternate
//   sampling is free           a card without a sink has the same state as one whose samples are taken
//   it still works             after a final reset the card jumps to a position
#pragma once

#include <cstdint>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>

namespace motionrack::rtc5::fuzz {

using motionrack::fuzz::Feed;

struct Verdict {
    std::string problem;  ///< "" or the violated invariant
    std::int64_t commands = 0, refused = 0, ticks = 0, files = 0;
};

/// Executes a job of `steps` commands and runs on a new card; fewer if the feed ends or an invariant is violated.
void run(Feed& feed, std::int64_t steps, Verdict& verdict);

}  // namespace motionrack::rtc5::fuzz
