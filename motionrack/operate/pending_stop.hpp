// Stops and resets that are commanded but not carried out yet.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

namespace motionrack::operate {

/// Used only by the motion thread.
class PendingStop {
  public:
    /// Requests a stop. `at_rest`: nothing was moving or pending, so that the stop precedes all later commands.
    void request(bool at_rest) {
        wanted_ = true;
        at_rest_ = at_rest;
    }
    /// Requests a stop because of a failure, in the order of the present stop, if any.
    void request() { wanted_ = true; }
    /// Requests a reset. `trips`: StopLatch::trips() at the command.
    void request_reset(std::uint64_t trips) { reset_ = trips; }

    bool wanted() const { return wanted_; }
    bool comes_first() const { return wanted_ && at_rest_; }
    bool wants_reset() const { return reset_.has_value(); }
    /// Ends the stop request, after the stop was executed.
    void end() { wanted_ = at_rest_ = false; }
    /// Ends the reset request. Returns true if a reset was requested and the stop latch has not tripped since.
    bool take_reset(std::uint64_t trips) { return std::exchange(reset_, std::nullopt) == trips; }

  private:
    bool wanted_ = false, at_rest_ = false;
    std::optional<std::uint64_t> reset_;
};

}  // namespace motionrack::operate
