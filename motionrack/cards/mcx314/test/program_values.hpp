// Values that random register programs write: mostly in range and of a relevant size, sometimes arbitrary.
#pragma once

#include <algorithm>
#include <cstdint>
#include <motionrack/cards/mcx314/test/program.hpp>

namespace motionrack::mcx314::twin {

class Values {
  protected:
    Values(std::uint64_t seed, std::uint64_t number, const ChipOptions& options)
        : random_(seed * 0x2545F4914F6CDD1Dull + number) {
        program_.options = options;
        program_.seed = seed;
        program_.number = number;
    }

    std::int64_t range() {
        static constexpr std::int64_t usual[] = {16'000, 16'000, 20'000, 32'000, 50'000, 80'000, 160'000};
        if (nasty_ && random_.one_in(8)) return random_.between(0, 0x1FF'FFFF);
        return random_.one_in(3) ? random_.between(16'000, long_ ? 800'000 : 60'000) : random_.of(usual);
    }
    std::int64_t accel() {
        if (nasty_ && random_.one_in(10)) return random_.between(0, 65'535);
        if (s_curve_ && random_.one_in(2)) return random_.between(1, long_ ? 2000 : 300);
        return random_.between(1, 80) * 100;
    }
    std::int64_t jerk() {
        if (nasty_ && random_.one_in(10)) return random_.between(0, 65'535);
        return random_.between(1, long_ ? 20 : random_.one_in(2) ? 1 : 3);
    }
    std::int64_t start_speed() {
        if (nasty_ && random_.one_in(10)) return random_.between(0, 65'535);
        return random_.one_in(3) ? random_.between(1, 8000) : random_.between(2000, 7900);
    }
    std::int64_t speed(std::int64_t start) {
        if (nasty_ && random_.one_in(8)) return random_.between(0, 65'535);
        if (random_.one_in(8)) return random_.between(1, 8000);
        // Limits a ramp so that it ends within the program.
        const std::int64_t max_rise = s_curve_ ? program_.ticks * program_.ticks / 4'000'000 + 2 : program_.ticks / 12;
        return std::max<std::int64_t>(
            1, start + random_.between(-max_rise / 8 - 2, std::min<std::int64_t>(max_rise, 2000)));
    }
    std::int64_t pulses() {
        if (nasty_ && random_.one_in(12)) return random_.between(0, 0xFFFF'FFFF);
        if (random_.one_in(3)) return random_.between(0, 40);
        return random_.between(0, program_.ticks / random_.between(4, 40));
    }
    std::int64_t coordinate() {
        if (nasty_ && random_.one_in(20)) return random_.between(0, 0xFFFF'FFFF);
        const std::int64_t max_coordinate =
            random_.one_in(3) ? 6 : std::max<std::int64_t>(3, program_.ticks / random_.between(20, 400));
        return random_.between(-max_coordinate, max_coordinate);
    }
    std::int64_t position() {
        static constexpr std::int64_t ends[] = {0x7FFF'FFFF, -0x7FFF'FFFF - 1, 0x7FFF'FFF0, -0x7FFF'FFF0};
        if (nasty_ && random_.one_in(5)) return random_.of(ends);
        return random_.between(-program_.ticks / 30, program_.ticks / 30);
    }

    Random random_;
    Program program_;
    bool long_ = false, s_curve_ = false, nasty_ = false;
};

}  // namespace motionrack::mcx314::twin
