// Windows' performance counter; sleeps by a timer, which ends a sleep late by up to 0.5 ms, or 15.6 ms before
// Windows 10.
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <algorithm>
#include <motionrack/live/clock.hpp>

#ifndef CREATE_WAITABLE_TIMER_HIGH_RESOLUTION
#define CREATE_WAITABLE_TIMER_HIGH_RESOLUTION 0x00000002
#endif

namespace motionrack::live {

namespace {

constexpr Duration worth_a_sleep = microseconds(50);

Instant since_boot() {
    static const std::int64_t per_second = [] {
        LARGE_INTEGER frequency{};
        ::QueryPerformanceFrequency(&frequency);
        return static_cast<std::int64_t>(frequency.QuadPart);
    }();
    LARGE_INTEGER count{};
    ::QueryPerformanceCounter(&count);
    const std::int64_t counts = count.QuadPart;
    return whole_seconds(counts / per_second) + nanoseconds(counts % per_second * 1'000'000'000 / per_second);
}

/// Waits by a timer for at least `duration`. Returns false if no timer is available.
bool wait_by_timer(Duration duration) {
    HANDLE timer = ::CreateWaitableTimerExW(nullptr, nullptr, CREATE_WAITABLE_TIMER_HIGH_RESOLUTION, TIMER_ALL_ACCESS);
    if (timer == nullptr) timer = ::CreateWaitableTimerExW(nullptr, nullptr, 0, TIMER_ALL_ACCESS);
    if (timer == nullptr) return false;
    LARGE_INTEGER due{};
    due.QuadPart = -static_cast<LONGLONG>(duration / nanoseconds(100) + 1);
    const bool done = ::SetWaitableTimer(timer, &due, 0, nullptr, nullptr, FALSE) != 0 &&
                      ::WaitForSingleObject(timer, INFINITE) == WAIT_OBJECT_0;
    ::CloseHandle(timer);
    return done;
}

}  // namespace

MonotonicClock::MonotonicClock() : start_(since_boot()) {}

Instant MonotonicClock::now() const {
    return since_boot() - start_;
}

void MonotonicClock::sleep(Duration duration) {
    const Instant end = later(since_boot(), duration);
    for (Duration left = duration; left > Duration{0}; left = end - since_boot())
        if (left >= worth_a_sleep && !wait_by_timer(left))
            ::Sleep(static_cast<DWORD>(std::min<std::int64_t>(left / milliseconds(1) + 1, 1'000'000)));
}

/// Waits for the whole `timeout` and returns false: on Windows no file delivers a card's interrupts, see InterruptLine.
bool MonotonicClock::wait_readable(int, Duration timeout) {
    sleep(timeout);
    return false;
}

}  // namespace motionrack::live
