// A machine through several lives, all drawn from one seed.
//
//   seed ──► rack; a life: journal opened, machine where the last one left it, orders and faults at random instants
//              │                                 │ each order that is taken: an entry, safe before the next order
//              │                                 ▼
//              ├─ ends clean ─ is killed ─ loses power ─ its disk fails ──► the next life
//              ▼
//            all mended and reset: it drives where it is sent
//
// The invariants watch every picture. Of a journal: each entry that was acknowledged is there in the next life, and an
// axis that is trusted there stands where the record says.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <tests/invariants/invariants.hpp>

namespace motionrack::swarm {

struct SeedEnd {
    std::optional<test::Finding> finding;  ///< the first law that was broken
    std::string what;                      ///< what the seed was: the rack, and how its lives ended
    std::deque<std::string> story;         ///< the last orders and faults
    int taken = 0, refused = 0;            ///< orders
    int lives = 0, faults = 0;
    /// The seed decides on all that happens. A disk's nth call is not of it, nor what was on the disk when power went:
    /// how many entries share a transaction is the journal's thread's affair, and with it when an entry fails.
    bool repeats = true;
    std::uint64_t history = 0;  ///< hash of all pictures, entries and orders, for as long as it repeats
};

/// `folder`: an empty one, for the journals.
SeedEnd drive_seed(std::uint64_t seed, const std::string& folder);

}  // namespace motionrack::swarm
