// Executes the pending changes of the laser, in half-microseconds.
#include <algorithm>
#include <motionrack/cards/rtc5/model/laser_control.hpp>

namespace motionrack::rtc5 {

void LaserControl::switch_at(std::int64_t half_us, bool on, std::int64_t tick) {
    run_until(tick);
    Laser& l = laser_;
    if (on && l.disabled) return;
    half_us = std::max(half_us, tick * half_us_per_tick);
    const auto place = [&](std::int64_t i) { return static_cast<std::size_t>((l.head + i) % Laser::capacity); };
    while (l.count > 0 && l.at[place(l.count - 1)] >= half_us) --l.count;
    const bool level = (l.on != 0) != (l.count % 2 != 0);
    if (level == on) return;
    if (l.count == Laser::capacity) {
        ++l.lost;
        return;
    }
    l.at[place(l.count++)] = half_us;
}

void LaserControl::switch_now(bool on) {
    begin_tick();
    switch_at(tick_ * half_us_per_tick, on, tick_);
}

void LaserControl::switch_off() {
    begin_tick();
    laser_.count = 0;
    switch_at(tick_ * half_us_per_tick, false, tick_);
}

void LaserControl::disable() {
    switch_off();
    laser_.disabled = 1;
}

void LaserControl::run_until(std::int64_t tick) {
    Laser& l = laser_;
    std::uint8_t* const samples = connections_.sink != nullptr ? buffers_.laser.data() : nullptr;
    const auto constant_to = [&](std::int64_t end) {
        if (samples != nullptr && end > filled_)
            std::fill(samples + (filled_ - tick_), samples + (end - tick_),
                      static_cast<std::uint8_t>(l.on ? half_us_per_tick : 0));
        filled_ = std::max(filled_, end);
    };
    while (l.count > 0 && l.at[static_cast<std::size_t>(l.head)] < tick * half_us_per_tick) {
        const std::int64_t in = l.at[static_cast<std::size_t>(l.head)] / half_us_per_tick;
        constant_to(in);
        const std::int64_t end = (in + 1) * half_us_per_tick;
        std::int64_t cursor = in * half_us_per_tick, gate = 0;
        while (l.count > 0 && l.at[static_cast<std::size_t>(l.head)] < end) {
            const std::int64_t at = l.at[static_cast<std::size_t>(l.head)];
            if (l.on)
                gate += at - cursor, l.on_time += at - l.on_since;
            else
                l.on_since = at;
            cursor = at;
            l.on = !l.on;
            l.head = (l.head + 1) % Laser::capacity;
            --l.count;
            if (connections_.sink != nullptr) connections_.sink->laser(at, l.on != 0);
        }
        if (l.on) gate += end - cursor;
        if (samples != nullptr) samples[in - tick_] = static_cast<std::uint8_t>(gate);
        filled_ = in + 1;
    }
    constant_to(tick);
}

}  // namespace motionrack::rtc5
