// Which joints of a path are passed and which are stopped at: the quickest row of legs, as far as the path is known.
//
//   joint    0          1           2            the quickest ways to stop at the last joint and to pass it are kept;
//   stop     ●────────  ●  ╲      ╱ ●            what both have in common is decided
//   pass           ╲──  ●  ─╲───── ●
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/control/path/junction.hpp>

namespace motionrack::control {

class JunctionPlanner {
  public:
    /// Joints that wait for what comes after them.
    static constexpr std::size_t most = 12;

    /// The path begins at rest.
    void begin();
    /// A leg, and the joint at its end. After it no more than `most` joints are undecided.
    void add(const LegLimits& leg, const Junction& end);

    /// Joints that are decided and were not taken; the path's begin is none.
    std::size_t decided() const { return decided_; }
    /// Of the first of these: whether it is a stop.
    bool take();

  private:
    /// The quickest way to the last joint, if it is stopped at, or passed.
    struct Candidate {
        bool open = false;
        double seconds = 0;
        std::uint32_t stops = 0;  ///< bit i: at the i-th joint that was not taken
    };

    Candidate time_optimal_to(const LegLimits& leg, const Junction& end, bool stops) const;
    void decide();

    Junction last_;
    std::array<Candidate, 2> ways_;  ///< passed, stopped at
    std::size_t known_ = 0;          ///< joints that were not taken
    std::size_t decided_ = 0;
};

}  // namespace motionrack::control
