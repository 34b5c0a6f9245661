// How fast a rack's time goes beside the computer's: step for step with it, N times as fast, as fast as it can, or not
// at all.
//
//   computer ────┬───────────┬───────────┬──────► s      rack's instants are due at  base + (instant - base) / factor
//   rack     ────┴─2 ms──────┴─2 ms──────┴──────►        too early: the motion thread waits;
//                                                        late: it hurries, and the lateness is counted
//
// Who is later than `given_up` does not hurry after it: the base moves, and what was lost is told.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/live/clock.hpp>
#include <string_view>

namespace motionrack::operate {

enum class ClockMode : std::uint8_t {
    real,   ///< `factor` seconds of the rack a second
    free,   ///< as fast as the computer can
    paused  ///< stands, but for steps
};
/// "real", "free", "paused".
std::string_view name_of(ClockMode mode);

/// How late slices were let go after they were due. Fixed memory.
class Lateness {
  public:
    void add(Duration late);
    std::int64_t count() const { return count_; }
    Duration greatest() const { return greatest_; }
    /// No more than `part` (0 .. 1) of all were later; rounded up to 20 us. 0 of none.
    Duration within(double part) const;

  private:
    static constexpr Duration width = microseconds(20);
    std::array<std::int64_t, 5000> counts_ = {};  // the last one has all that were later
    std::int64_t count_ = 0;
    Duration greatest_{0};
};

/// Only the motion thread uses it.
class ClockPacer {
  public:
    /// Factors are 0.001 .. 1000.
    ClockPacer(live::Clock& clock, ClockMode mode, double factor);

    /// True: the rack may run on from `now`. Waits 5 ms at most.
    bool pace(Instant now);

    /// Errors: invalid_input, a factor out of its range.
    Result<void> set(ClockMode mode, double factor);
    /// Lets so much time go by, as fast as it can. Errors: refused unless paused; invalid_input below 100 ps or above
    /// 3600 s.
    Result<void> step(Duration duration);

    ClockMode mode() const { return mode_; }
    double factor() const { return factor_; }
    /// Of every slice in mode real.
    const Lateness& lateness() const { return lateness_; }
    /// Real time by which the rack fell behind for good.
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
