// Additional state of an MCX314As axis of the twin.
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::mcx314::twin {

/// The input pins of one axis, by name; all High at rest.
enum class Pin : std::uint8_t { in0, in1, in2, in3, exp_plus, exp_minus, in_position, alarm, limit_plus, limit_minus };
inline constexpr int pin_count = 10;

/// An input with a filter: the level in the chip, and the number of consecutive different samples.
struct Filter {
    bool out = true;
    std::int64_t different = 0;

    void sample(bool wire, std::int64_t delay) {
        different = wire == out ? 0 : different + 1;
        if (different <= delay) return;
        out = wire;
        different = 0;
    }
};

struct Extension {
    unsigned em6 = 0, em7 = 0, sm6 = 0, sm7 = 0;  ///< the words of 60h and 64h
    std::uint32_t hv = 0, buffer = 0;
    std::array<Filter, pin_count> filter;
    bool in2_before = true, in3_before = true;  ///< levels at the last sample
    bool wheel_before = true;                   ///< nEXPP at the last tick, or at the write of WR3
    std::int64_t clear_until = 0;               ///< tick at which the deviation counter clear pulse ends
    std::int64_t cap = 0;                       ///< speed cap of a drive without triangle; 0: none
    bool acts = false;                          ///< a condition of SM6 has occurred
    int hmst = 0;                               ///< state of the home search, 0: none
    bool found = false, seen = false, cancelled = false, cleared = false, error = false;

    bool filters(Pin pin) const {
        switch (pin) {
            case Pin::in2:
                return (em6 & 0x0200) != 0;
            case Pin::alarm:
            case Pin::in_position:
                return (em6 & 0x0400) != 0;
            case Pin::exp_plus:
            case Pin::exp_minus:
                return (em6 & 0x0800) != 0;
            case Pin::in3:
                return (em6 & 0x1000) != 0;
            default:
                return (em6 & 0x0100) != 0;
        }
    }
    /// Returns the delay of the filters, ticks.
    std::int64_t delay() const { return em6 >> 13 == 0 ? 16 : 1024 << (em6 >> 13); }
    bool ring() const { return (em6 & 0x10) != 0; }
    bool slow() const { return hmst == 8 || hmst == 12 || hmst == 15 || hmst == 20; }
    int step() const { return hmst == 0 ? 0 : hmst == 3 ? 1 : hmst <= 15 ? 2 : hmst == 20 ? 3 : 4; }
    bool enabled(int home_step) const { return (em7 >> (2 * home_step - 2) & 1) != 0; }
    int direction(int home_step) const { return (em7 >> (2 * home_step - 1) & 1) != 0 ? -1 : +1; }
};

}  // namespace motionrack::mcx314::twin
