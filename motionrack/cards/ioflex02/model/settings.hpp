// What is set on the card by its switches, and what a real one has from its maker.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <vector>

namespace motionrack::ioflex02 {

struct Settings {
    std::uint32_t base_address = 0x2300;  ///< 0 .. FF00h, a multiple of 100h
    std::uint16_t serial = 1;             ///< every card of a bus its own
    Duration configuration_time =
        milliseconds(2'000);               ///< from the image's last byte to the running project, 0 .. 60 s
    bool loaded = false;                   ///< a project runs from power-up, without the host loading it
    std::vector<std::uint8_t> image = {};  ///< its image, not compressed; empty: "position" as it is built in
};

/// Errors: refused, with the setting, its value and its range.
Result<void> check(const Settings& settings);

}  // namespace motionrack::ioflex02
