// The bits of get_last_error and get_error, and their assignment to errors.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/cards/rtc5/map/status.hpp>

namespace motionrack::rtc5 {

namespace map {

inline constexpr BitInfo error_bits[] = {
    {"NO_CARD", 0, "init_rtc5_dll found no card"},
    {"ACCESS_DENIED", 1, "unknown card number"},
    {"PARAM_ERROR", 4, "a parameter is wrong"},
    {"BUSY", 5, "a list is running, or the card moves"},
    {"REJECTED", 6, "the list is full, none is open, or nothing can be read"},
};
static_assert(declared<bits_flaw(error_bits)>());

}  // namespace map

consteval std::uint32_t error_bit(std::string_view name) {
    return map::bit_named(map::error_bits, name);
}

/// Returns the bits of get_last_error for a command that ended with this error.
constexpr std::uint32_t error_bits_of(ErrorKind trouble) {
    switch (trouble) {
        case ErrorKind::invalid_input:
        case ErrorKind::refused:
        case ErrorKind::io:
            return error_bit("PARAM_ERROR");
        case ErrorKind::machine:
            return error_bit("BUSY");
        case ErrorKind::stopped:
            break;
    }
    return error_bit("REJECTED");
}

}  // namespace motionrack::rtc5
