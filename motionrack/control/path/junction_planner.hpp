// Chooses which junctions of a path are passed and which are stops: the fastest sequence over the known path.
//
//   junction 0          1           2            the fastest candidates for stopping at and for passing the last
//   stop     ●────────  ●  ╲      ╱ ●            junction are kept; their common beginning is decided
//   pass           ╲──  ●  ─╲───── ●
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/control/path/junction.hpp>

namespace motionrack::control {

class JunctionPlanner {
  public:
    /// Maximum number of junctions that wait for later ones.
    static constexpr std::size_t max_junctions = 12;

    /// Starts a path at standstill.
    void begin();
    /// Adds a leg and the junction at its end. Afterwards at most `max_junctions` junctions are undecided.
    void add(const LegLimits& leg, const Junction& end);

    /// Returns the number of decided junctions that were not taken; the start of the path does not count.
    std::size_t decided() const { return decided_; }
    /// Takes the first decided junction; returns true if the path stops there.
    bool take();

  private:
    /// The fastest sequence that stops at, or passes, the last junction.
    struct Candidate {
        bool open = false;
        double seconds = 0;
        std::uint32_t stops = 0;  ///< bit i: stop at the i-th junction that was not taken
    };

    Candidate time_optimal_to(const LegLimits& leg, const Junction& end, bool stops) const;
    void decide();

    Junction last_;
    std::array<Candidate, 2> candidates_;  ///< [0] passes, [1] stops
    std::size_t known_ = 0;                ///< number of junctions that were not taken
    std::size_t decided_ = 0;
};

}  // namespace motionrack::control
