// Reads CLOCK_MONOTONIC and sleeps until an instant of it; converts between its nanoseconds and ticks of 0.1 ns.
#include <ctime>
#include <motionrack/dds/clock.hpp>

namespace motionrack::dds {

Instant monotonic_now() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return whole_seconds(now.tv_sec) + nanoseconds(now.tv_nsec);
}

void sleep_until(Instant when) {
    const std::int64_t ticks = when.count() < 0 ? 0 : when.count();
    timespec until{};
    until.tv_sec = static_cast<std::time_t>(ticks / 10'000'000'000);
    until.tv_nsec = static_cast<long>(ticks % 10'000'000'000 / 10);
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace motionrack::dds
