// The status bits of the RTC5, by name.
#pragma once

#include <cstdint>
#include <motionrack/base/declaration.hpp>
#include <span>
#include <string_view>

namespace motionrack::rtc5 {

struct BitInfo {
    std::string_view name;
    int bit = 0;
    std::string_view meaning;
};

namespace map {

inline constexpr BitInfo marking_info_bits[] = {
    {"FLY_X_UNDERFLOW", 0, "the corrected X was below -524288"},
    {"FLY_X_OVERFLOW", 1, "the corrected X was above 524287"},
    {"FLY_Y_UNDERFLOW", 2, "the corrected Y was below -524288"},
    {"FLY_Y_OVERFLOW", 3, "the corrected Y was above 524287"},
    {"LIMIT_X_MIN", 4, "the corrected X was below Xmin of set_fly_limits"},
    {"LIMIT_X_MAX", 5, "the corrected X was above Xmax"},
    {"LIMIT_Y_MIN", 6, "the corrected Y was below Ymin"},
    {"LIMIT_Y_MAX", 7, "the corrected Y was above Ymax"},
    {"TRIGGER_ERROR", 8, "a start came while a list was running"},
    {"ACTIVATE_FLY_ERROR", 9, "activate_fly_2d or activate_fly_xy failed"},
    {"ENCODER_X_SEQUENCE", 20, "both lines of encoder 0 changed at once"},
    {"ENCODER_Y_SEQUENCE", 21, "both lines of encoder 1 changed at once"},
    {"FLY_Z_UNDERFLOW", 22, "the corrected Z was below -32768"},
    {"FLY_Z_OVERFLOW", 23, "the corrected Z was above 32767"},
    {"LIMIT_Z_MIN", 24, "the corrected Z was below Zmin of set_fly_limits_z"},
    {"LIMIT_Z_MAX", 25, "the corrected Z was above Zmax"},
};

inline constexpr BitInfo startstop_info_bits[] = {
    {"INTERNAL_START", 0, "execute_list or the like started a list since the last reading"},
    {"EXTERNAL_START", 1, "an external start started a list since the last reading"},
    {"INTERNAL_STOP", 2, "stop_execution came since the last reading"},
    {"EXTERNAL_STOP", 3, "an external stop came since the last reading"},
    {"NO_STOP_SIGNAL", 4, "no stop signal is present"},
    {"LASER_ENABLED", 9, "the laser is not disabled"},
    {"START_LOST", 11, "a start was lost: a list was running, or eight starts were waiting"},
};

inline constexpr BitInfo status_bits[] = {
    {"BUSY", 0, "a list is running"},
    {"INTERNAL_BUSY", 7, "the card moves by itself (goto_xy)"},
    {"PAUSED", 15, "a list was paused"},
};

inline constexpr BitInfo list_status_bits[] = {
    {"LOAD1", 0, "list commands go into list 1"},
    {"LOAD2", 1, "list commands go into list 2"},
    {"READY1", 2, "set_end_of_list was added to list 1"},
    {"READY2", 3, "set_end_of_list was added to list 2"},
    {"BUSY1", 4, "list 1 is running"},
    {"BUSY2", 5, "list 2 is running"},
    {"USED1", 6, "list 1 ran to its end, and got no commands since"},
    {"USED2", 7, "list 2 ran to its end, and got no commands since"},
};

constexpr DeclarationError bits_flaw(std::span<const BitInfo> bits) {
    return names_flaw("the status words", "bit", bits);
}
static_assert(declared<bits_flaw(marking_info_bits)>() && declared<bits_flaw(startstop_info_bits)>() &&
              declared<bits_flaw(status_bits)>() && declared<bits_flaw(list_status_bits)>());

consteval std::uint32_t bit_named(std::span<const BitInfo> bits, std::string_view name) {
    for (const BitInfo& bit : bits)
        if (bit.name == name) return std::uint32_t{1} << bit.bit;
    throw "unknown bit name";
}

}  // namespace map

/// Returns the bit mask of a bit of get_marking_info, by its name; the following two do so for their words.
consteval std::uint32_t marking_bit(std::string_view name) {
    return map::bit_named(map::marking_info_bits, name);
}
consteval std::uint32_t startstop_bit(std::string_view name) {
    return map::bit_named(map::startstop_info_bits, name);
}
consteval std::uint32_t status_bit(std::string_view name) {
    return map::bit_named(map::status_bits, name);
}

/// Returns the bit mask of a bit of read_status, by its name.
consteval std::uint32_t list_status_bit(std::string_view name) {
    return map::bit_named(map::list_status_bits, name);
}

/// Reading get_marking_info clears all bits except these.
inline constexpr std::uint32_t kept_when_read = marking_bit("LIMIT_X_MIN") | marking_bit("LIMIT_X_MAX") |
                                                marking_bit("LIMIT_Y_MIN") | marking_bit("LIMIT_Y_MAX") |
                                                marking_bit("LIMIT_Z_MIN") | marking_bit("LIMIT_Z_MAX");

}  // namespace motionrack::rtc5
