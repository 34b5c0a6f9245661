// Clock of a card that is served in simulated time: the server advances time at the request of the driver's process.
#pragma once

#include <poll.h>

#include <motionrack/live/clock.hpp>
#include <tests/live/doorbell.hpp>

namespace motionrack::live_test {

class ServedClock final : public live::Clock {
  public:
    explicit ServedClock(Doorbell& bell) : bell_(bell) {}
    Instant now() const override { return Instant{bell_.now.load()}; }
    void sleep(Duration duration) override { ask(bell_, Question::pass, duration.count()); }
    bool wait_readable(int descriptor, Duration timeout) override {
        ask(bell_, Question::interrupt, timeout.count());
        pollfd file{descriptor, POLLIN, 0};
        return ::poll(&file, 1, 0) == 1 && (file.revents & POLLIN) != 0;
    }

  private:
    Doorbell& bell_;
};

}  // namespace motionrack::live_test
