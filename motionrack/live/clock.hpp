// The computer's time and its way of waiting, for drivers on real cards.
#pragma once

#include <motionrack/base/time.hpp>

namespace motionrack::live {

/// What a live port asks of its computer. A card that is served in virtual time is served with a clock of that time.
class Clock {
  public:
    virtual ~Clock() = default;
    virtual Instant now() const = 0;
    /// Returns when `duration` has passed, never before.
    virtual void sleep(Duration duration) = 0;
    /// Waits until the file can be read, at most `timeout`, and less if a signal comes; true if it can.
    virtual bool wait_readable(int descriptor, Duration timeout) = 0;
};

/// The monotonic clock of Linux, from 0 when it was made. Waits under 50 us keep the processor: a sleep takes longer.
class MonotonicClock final : public Clock {
  public:
    MonotonicClock();
    Instant now() const override;
    void sleep(Duration duration) override;
    bool wait_readable(int descriptor, Duration timeout) override;

  private:
    Instant start_;
};

}  // namespace motionrack::live
