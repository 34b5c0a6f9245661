// The active repeat loops of a program and of the calls in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace motionrack::control::gcode {

/// Active repeat loops, identified by the location of their repeat. Only loops of the present call are changed.
class RepeatLoops {
  public:
    void begin(std::int32_t location, std::int64_t times) { loops_.push_back({location, times}); }
    /// Ends an iteration of the loop. Returns true if another one follows; otherwise the loop is over.
    bool next(std::int32_t location);
    /// Ends the innermost loops whose repeat is at `first` or later, and before `last`.
    void end_between(std::int32_t first, std::int32_t last);

    void enter_call() { outer_.push_back(loops_.size()); }
    /// Ends all loops of the present call.
    void end_all() { loops_.resize(outer_.back()); }
    /// Ends the call with its loops.
    void leave_call();

  private:
    struct ActiveRepeat {
        std::int32_t location = 0;
        std::int64_t left = 0;  ///< remaining iterations, including the present one
    };
    std::vector<ActiveRepeat> loops_;  ///< the innermost last
    std::vector<std::size_t> outer_;   ///< number of loops before each call
};

}  // namespace motionrack::control::gcode
