// Linux' monotonic clock; sleeps until an instant, so that a sleep interrupted by a signal is completed.
#include <poll.h>

#include <cerrno>
#include <ctime>
#include <motionrack/live/clock.hpp>

namespace motionrack::live {

namespace {

constexpr Duration worth_a_sleep = microseconds(50);

Instant since_boot() {
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return whole_seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

/// Rounds up: a wait is never too short. `duration`: >= 0.
timespec timespec_of(Duration duration) {
    const std::int64_t ns = duration.count() / 10 + (duration.count() % 10 != 0);
    return {static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
}

}  // namespace

MonotonicClock::MonotonicClock() : start_(since_boot()) {}

Instant MonotonicClock::now() const {
    return since_boot() - start_;
}

void MonotonicClock::sleep(Duration duration) {
    const Instant end = later(since_boot(), duration);
    if (duration < worth_a_sleep) {
        while (since_boot() < end) continue;
        return;
    }
    const timespec until = timespec_of(end);
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) continue;
}

bool MonotonicClock::wait_readable(int descriptor, Duration timeout) {
    pollfd file{descriptor, POLLIN, 0};
    const timespec max_wait = timespec_of(timeout < Duration{0} ? Duration{0} : timeout);
    return ::ppoll(&file, 1, &max_wait, nullptr) == 1 && (file.revents & POLLIN) != 0;
}

}  // namespace motionrack::live
