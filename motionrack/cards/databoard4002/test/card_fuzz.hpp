// Any byte to any port at any time: a stream of numbers becomes accesses, wires, faults and passing time on a card with
// an ideal motor, and what must always hold is checked after each.
//
//   Ready returns       within the firmware's time for an access, unless the firmware hangs
//   no motion without G no move, no volt and no pulse before the host's first G after a reset
//   a reset is at once  C3, INP 7: 0 V, relay open, Ready; a firmware that hangs is reset 1 s after its last pass
//   stops hold          0 V with EMS, no volt into an active end stop
//   counters add up     counter = pulses since it was zeroed; edges = pulses; a second card on the bus does nothing
//   it stays alive      in the end, all inputs released, a reset card goes 100 counts
#pragma once

#include <cstdint>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>

namespace motionrack::databoard4002::fuzz {

using motionrack::fuzz::Feed;

/// What a run came to.
struct Verdict {
    std::string problem;  ///< "" or what does not hold
    std::int64_t accesses = 0;
    std::int64_t pulses = 0;     ///< in either direction, as far as they were seen between two accesses
    std::int64_t resets = 0;     ///< by the host
    std::int64_t watchdogs = 0;  ///< hangs that the watchdog was seen to end
    double seconds = 0;          ///< virtual time
};

/// Runs `accesses` accesses on a card of its own, fewer if the feed is empty or something does not hold.
void run(Feed& feed, std::int64_t accesses, Verdict& verdict);

}  // namespace motionrack::databoard4002::fuzz
