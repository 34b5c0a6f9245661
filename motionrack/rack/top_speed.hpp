// The greatest speed of an axis that lasted. A piece of the path begins and ends at whole pulses, so that one of a few
// pulses has a rate that the axis never had: such a rate counts less the pulse that it may be wrong by.
//
//   rate    ___/~~~~\___|^|___|^|___|~~~~~~~~~~    between jumps: counts in full where it lasts for many pulses
//   pulses  |  w  |     w     |          w    |    over all: of windows of 1 ms to 1 s the fullest, less two
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <vector>

namespace motionrack::rack {

/// Allocates only when it is made.
class TopSpeed {
  public:
    /// A rate that changes by more than `jump_hz` at once begins another piece. `period`: between two looks.
    TopSpeed(double jump_hz, Duration period);
    /// The rate was `before` and is `rate` from now on, pulses/s.
    void changed(double before, double rate, Instant now);
    /// Every period: the pulses so far, and their rate now.
    void look(std::int64_t count, double rate, Instant now);
    /// Nothing more comes.
    void finish();
    double hz() const { return top_; }

  private:
    void pass(double rate, Instant now);
    void end_piece();

    double jump_hz_;
    double period_s_;
    std::size_t min_looks_ = 1;         ///< of a window
    std::vector<std::int64_t> counts_;  ///< at the last looks
    std::size_t looks_ = 0;
    double top_ = 0;
    // of the piece
    double rate_ = 0, piece_top_ = 0, pulses_ = 0;
    bool whole_pulses_ = false;  ///< a jump is at its begin or its end
    Instant since_{};            ///< when rate_ was
};

}  // namespace motionrack::rack
