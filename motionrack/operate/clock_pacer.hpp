// Paces a rack's virtual time against the computer's clock: real time, a multiple of it, unthrottled, or paused.
//
//   computer ────┬───────────┬───────────┬──────► s      rack's instants are due at  base + (instant - base) / factor
//   rack     ────┴─2 ms──────┴─2 ms──────┴──────►        too early: the motion thread waits;
//                                                        late: it catches up, and the lateness is counted
//
// Beyond a lateness of `given_up` (250 ms) it does not catch up: both bases move, and the lost time is reported.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/live/clock.hpp>
#include <string_view>

namespace motionrack::operate {

enum class ClockMode : std::uint8_t {
    real,         ///< `factor` seconds of virtual time per second
    unthrottled,  ///< runs without pacing
    paused        ///< virtual time advances only by step()
};
/// Returns "real", "unthrottled", "paused".
std::string_view name_of(ClockMode mode);

/// Distribution of the lateness of slices. Fixed memory.
class Lateness {
  public:
    void add(Duration late);
    std::int64_t count() const { return count_; }
    Duration max() const { return max_; }
    /// Lateness that the fraction `part` (0 .. 1) of all slices did not exceed, rounded up to 20 us; 0 without slices.
    Duration within(double part) const;

  private:
    static constexpr Duration width = microseconds(20);
    std::array<std::int64_t, 5000> counts_ = {};  // the last one counts all later slices
    std::int64_t count_ = 0;
    Duration max_{0};
};

/// Used only by the motion thread.
class ClockPacer {
  public:
    /// `factor`: virtual seconds per real second in mode real, 0.001 .. 1000.
    ClockPacer(live::Clock& clock, ClockMode mode, double factor);

    /// Returns true if the rack may run on from `now`. Waits 5 ms at most.
    bool pace(Instant now);

    /// Sets mode and factor; ends a pending step. Errors: invalid_input if the factor is not 0.001 .. 1000.
    Result<void> set(ClockMode mode, double factor);
    /// Advances virtual time by this duration, as fast as possible. Errors: refused unless paused; invalid_input below
    /// 100 ps or above 3600 s.
    Result<void> step(Duration duration);

    ClockMode mode() const { return mode_; }
    double factor() const { return factor_; }
    /// Lateness of every slice in mode real.
    const Lateness& lateness() const { return lateness_; }
    /// Real time by which the rack fell behind permanently.
    Duration lost() const { return lost_; }

    static constexpr double min_factor = 0.001, max_factor = 1000;
    static constexpr Duration given_up = milliseconds(250);

  private:
    Instant due(Instant now) const;
    void begin_here(Instant now);

    live::Clock& clock_;
    ClockMode mode_;
    double factor_;
    bool begun_ = false;
    Instant rack_base_{}, real_base_{}, last_{}, step_end_{};
    Lateness lateness_;
    Duration lost_{0};
};

}  // namespace motionrack::operate
