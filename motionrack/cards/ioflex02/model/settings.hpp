// Settings of the card by its switches and by its manufacturer.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <vector>

namespace motionrack::ioflex02 {

struct Settings {
    std::uint32_t base_address = 0x2300;  ///< 0 .. FF00h, a multiple of 100h
    std::uint16_t serial = 1;             ///< unique on a bus
    Duration configuration_time =
        milliseconds(2'000);               ///< time from the image's last byte to the running project, 0 .. 60 s
    bool preloaded = false;                ///< a project runs from power-up without a load by the host
    std::vector<std::uint8_t> image = {};  ///< its image, uncompressed; empty: the built-in "position"
};

/// Checks all settings. Errors: refused, with the setting, its value and its range.
Result<void> check(const Settings& settings);

}  // namespace motionrack::ioflex02
