// State of the MCX314As functions, per axis; trivially copyable, without padding.
#pragma once

#include <array>
#include <cstdint>

namespace motionrack::mcx314 {

struct HomingSequence {
    std::int32_t hmst = 0;   ///< 0: none
    bool found = false;      ///< the event that the step waits for has occurred
    bool seen = false;       ///< in state HMST 12, IN1 was active
    bool cancelled = false;  ///< a stop command was received during the search
    bool cleared = false;    ///< the clear pulse at the end of step 3 was requested
    bool error = false;      ///< the search has failed (RR2 HOME)
    std::array<std::uint8_t, 7> reserved{};
};

/// An input of the whole chip with a filter.
struct ChipFilter {
    std::int64_t since = -1;  ///< first sample with a different wire level, -1: none
    std::int64_t wire = 1;    ///< level of its wire, 0 or 1
};

struct Extension {
    std::uint16_t em6 = 0, em7 = 0, sm6 = 0, sm7 = 0;
    std::uint16_t hv = 0;
    std::uint16_t v = 0;                   ///< V as written, on any chip; Axis::speed is the target of the drive
    std::uint16_t cap = 0;                 ///< V cap of a drive with triangle prevention; 0: none
    std::uint16_t filtered = 0;            ///< pins with a filter, bit Pin
    std::uint16_t wires = 0;               ///< levels of the wires of all pins, bit Pin
    std::uint16_t sampled = 0;             ///< levels at the last sample, bit Pin
    std::uint32_t buffer = 0;              ///< buffer register BR
    std::int64_t clear_until = 0;          ///< tick at which the clear pulse ends
    std::array<std::int64_t, 10> since{};  ///< filtered pins: first sample with a different wire level, -1: none
    HomingSequence home;

    Extension() { since.fill(-1); }
};

}  // namespace motionrack::mcx314
