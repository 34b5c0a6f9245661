// Virtual cards over the C library, from power-up, with their observations.
#pragma once

#include <gtest/gtest.h>
#include <rtc5sim.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace motionrack::rtc5sim_test {

struct Trace {
    std::vector<std::int32_t> x, y;
    std::vector<int> laser;
    bool operator==(const Trace&) const = default;
};

/// Cards from power-up to shutdown.
class Session {
  public:
    explicit Session(const char* cards = "1") {
        free_rtc5_dll();
        ::setenv("RTC5SIM_CARDS", cards, 1);
        rtc5sim_on_samples(keep, this);
        rtc5sim_question_us(10);
        rtc5sim_clear_error();
    }
    ~Session() {
        rtc5sim_on_samples(nullptr, nullptr);
        free_rtc5_dll();
        ::unsetenv("RTC5SIM_CARDS");
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    Trace card[16];

  private:
    static void keep(void* user, UINT number, std::int64_t, const std::int32_t* x, const std::int32_t* y,
                     const std::uint8_t* laser, std::size_t n) {
        Trace& t = static_cast<Session*>(user)->card[number - 1];
        t.x.insert(t.x.end(), x, x + n);
        t.y.insert(t.y.end(), y, y + n);
        t.laser.insert(t.laser.end(), laser, laser + n);
    }
};

}  // namespace motionrack::rtc5sim_test
