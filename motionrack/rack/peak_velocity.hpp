// Sustained peak velocity of an axis. Path segments begin and end at whole pulses, so a segment of a few pulses can
// show a rate that the axis never had. Such a rate counts less the pulse by which it may be wrong.
//
//   rate    ___/~~~~\___|^|___|^|___|~~~~~~~~~~    between steps: counts fully if it lasts for many pulses
//   pulses  |  w  |     w     |          w    |    overall: most pulses in a window of 1 ms to 1 s, less two
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <vector>

namespace motionrack::rack {

/// Allocates only in the constructor.
class PeakVelocity {
  public:
    /// A rate change above `jump_hz` starts another segment. `period`: time between two samples.
    PeakVelocity(double jump_hz, Duration period);
    /// Reports a rate change from `before` to `rate`, pulses/s.
    void changed(double before, double rate, Instant now);
    /// Call every period with the pulse count and the present rate.
    void sample(std::int64_t count, double rate, Instant now);
    /// Ends the last segment.
    void finish();
    double hz() const { return top_; }

  private:
    void pass(double rate, Instant now);
    void end_piece();

    double jump_hz_;
    double period_s_;
    std::size_t min_looks_ = 1;         ///< samples per window
    std::vector<std::int64_t> counts_;  ///< counts of the last samples
    std::size_t looks_ = 0;
    double top_ = 0;
    // state of the present segment
    double rate_ = 0, piece_top_ = 0, pulses_ = 0;
    bool whole_pulses_ = false;  ///< the segment begins or ends with a velocity step
    Instant since_{};            ///< instant of the last change of rate_
};

}  // namespace motionrack::rack
