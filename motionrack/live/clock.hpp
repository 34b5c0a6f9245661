// Time and waiting on the computer, for drivers of real cards.
#pragma once

#include <motionrack/base/time.hpp>

namespace motionrack::live {

/// Time functions of a live port. A card in virtual time needs a clock of that time.
class Clock {
  public:
    virtual ~Clock() = default;
    virtual Instant now() const = 0;
    /// Waits for `duration` or longer.
    virtual void sleep(Duration duration) = 0;
    /// Waits until the file is readable, at most `timeout`, less on a signal; returns true if it is readable.
    virtual bool wait_readable(int descriptor, Duration timeout) = 0;
};

/// The monotonic clock of Linux, from 0 at construction. Waits below 50 us are busy waits: a sleep takes longer.
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
