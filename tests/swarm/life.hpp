// Several lives of one machine, all drawn from one seed.
//
//  seed ──► rack; a life: journal opened, machine as the last one left it, commands and faults at random instants
//             │                                 │ each accepted command: an entry, on disk before the next command
//              │                                 ▼
//             ├─ ends regularly ─ is killed ─ loses power ─ its disk fails ──► the next life
//              ▼
//           all faults cleared and reset: it executes moves
//
// The invariants check every snapshot. Journal: the next life contains each acknowledged entry, and an axis whose
// position is valid there is at the recorded position.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <tests/invariants/invariants.hpp>

namespace motionrack::swarm {

struct SeedEnd {
    std::optional<test::Finding> finding;  ///< first violated invariant
    std::string what;                      ///< description of the seed: the rack, and the ends of its lives
    std::deque<std::string> story;         ///< last commands and faults
    int taken = 0, refused = 0;            ///< commands
    int lives = 0, faults = 0;
    /// The seed determines everything except the nth call of a disk and its content at a power loss. The journal's
    /// thread decides how many entries share a transaction, and therefore when an entry fails.
    bool repeats = true;
    std::uint64_t history = 0;  ///< hash of all snapshots, entries and commands while the run is repeatable
};

/// Runs all lives of a seed. `folder`: an empty folder for the journals.
SeedEnd drive_seed(std::uint64_t seed, const std::string& folder);

}  // namespace motionrack::swarm
