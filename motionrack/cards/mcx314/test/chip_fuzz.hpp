// Fuzzer of the chip: a stream of numbers becomes register accesses, wires and passing time. The invariants are checked
// after each.
//
//   counts add up      LP = value written to it + pulses since; edges = counts
//   every state ends   after 27h with all inputs released no axis drives, and no drive waits for 25h
//   exactly P          a fixed drive ends at P unless a stop was commanded or is latched, or P was lowered below it
//                      (of an MCX314As: while no synchronous action is set up, which may stop drives and write P)
//   reads are reads    reading RR0, RR1, RR2, RR4 .. RR7 has no visible effect, then or later
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/fnv.hpp>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>

namespace motionrack::mcx314::fuzz {

using motionrack::fuzz::Feed;

/// Result of a run.
struct Verdict {
    std::string problem;  ///< "" or the violated invariant
    std::uint64_t hash = fnv_start;
    std::int64_t accesses = 0;
    std::int64_t pulses = 0;
    std::int64_t exact_drives = 0;  ///< fixed drives observed to end at P

    void mix(std::uint64_t value) { hash = fnv_step(hash, value); }
};

/// Runs `accesses` accesses on a new chip, fewer if the feed is empty or an invariant is violated.
void run(Feed& feed, std::int64_t accesses, Verdict& verdict, Variant variant = Variant::mcx314);

}  // namespace motionrack::mcx314::fuzz
