// Instants of the firmware's passes, and the next one that can have an effect.
#pragma once

#include <algorithm>
#include <cstdint>
#include <motionrack/cards/databoard4002/model/state.hpp>

namespace motionrack::databoard4002 {

class PassSchedule {
  public:
    /// `next`, the next pass that can have an effect, is part of the card's state and must outlive this.
    PassSchedule(Instant& next, std::int32_t period_ticks) : next_(next), period_(period_ticks * tick.count()) {}

    Instant first_from(Instant t) const { return Duration{(t.count() + period_ - 1) / period_ * period_}; }
    Instant last_until(Instant t) const { return Duration{t.count() / period_ * period_}; }
    Instant next() const { return next_; }

    /// Requests the first pass from `t` on.
    void request(Instant t) { request_at(first_from(t)); }
    void request_at(Instant pass) { next_ = std::min(next_, pass); }
    /// Makes the first pass from `now` on the next one, whatever was requested.
    void restart(Instant now) { next_ = first_from(now); }
    /// Clears the request: a pass begins.
    void clear() { next_ = never; }

  private:
    Instant& next_;
    std::int64_t period_;
};

}  // namespace motionrack::databoard4002
