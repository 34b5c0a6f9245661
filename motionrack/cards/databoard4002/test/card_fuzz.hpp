// Fuzzer of the card: a stream of numbers becomes accesses to any port, wires, faults and passing time on a card with
// an ideal motor. The invariants are checked after each.
//
//   Ready returns       within the firmware's time for an access, unless the firmware hangs
//   no motion without G no move, no voltage and no pulse before the host's first G after a reset
//   a reset is at once  C3, INP 7: 0 V, relay open, Ready; hung firmware is reset 1 s after its last pass
//   stops hold          0 V with EMS, no voltage into an active end stop
//   counters add up     counter = pulses since it was zeroed; edges = pulses; a second card on the bus does nothing
//   it stays alive      in the end, with all inputs released, a reset card moves 100 counts
#pragma once

#include <cstdint>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>

namespace motionrack::databoard4002::fuzz {

using motionrack::fuzz::Feed;

/// Result of run().
struct Verdict {
    std::string problem;  ///< "" or the violated invariant
    std::int64_t accesses = 0;
    std::int64_t pulses = 0;     ///< pulses in either direction, as observed between two accesses
    std::int64_t resets = 0;     ///< resets by the host
    std::int64_t watchdogs = 0;  ///< hangs ended by the watchdog
    double seconds = 0;          ///< virtual time
};

/// Runs `accesses` accesses on a new card, fewer if the feed is empty or an invariant is violated.
void run(Feed& feed, std::int64_t accesses, Verdict& verdict);

}  // namespace motionrack::databoard4002::fuzz
