// Any number to any command, any word, any start, any file: a stream of numbers becomes a job on a card, and what must
// always hold is checked after each run.
//
//   outputs are in the field   20 bits, whatever was asked for
//   the gate is 0 .. 20        half-microseconds of a tick, and changes alternate
//   looking is free            a card that nobody looks at has the same state as one whose samples are taken
//   it stays alive             in the end it is reset and jumps to a place
#pragma once

#include <cstdint>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>

namespace motionrack::rtc5::fuzz {

using motionrack::fuzz::Feed;

struct Verdict {
    std::string problem;  ///< "" or what does not hold
    std::int64_t commands = 0, refused = 0, ticks = 0, files = 0;
};

/// A job of `steps` commands and runs on a card of its own, fewer if the feed is empty or something does not hold.
void run(Feed& feed, std::int64_t steps, Verdict& verdict);

}  // namespace motionrack::rtc5::fuzz
