// Returns the content of the McBSP's memory locations, or the command that must precede a read.
#include <fmt/format.h>

#include <array>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <string_view>

namespace motionrack::rtc5 {

namespace {

/// Commands after which received words go to a location.
constexpr std::array<std::string_view, 4> commands_before_reading = {
    "set_fly_x_pos, set_fly_y_pos or set_fly_rot_pos in a list (with any scale), or set_mcbsp_in, set_multi_mcbsp_in "
    "or get_mcbsp",
    "set_mcbsp_in with Mode 1 or 3, set_multi_mcbsp_in, or online positioning (set_mcbsp_x and the like)",
    "set_mcbsp_in with Mode 2 or 3, set_multi_mcbsp_in, or online positioning with set_mcbsp_rot",
    "set_mcbsp_in with Mode 3, or set_multi_mcbsp_in"};

}  // namespace

bool McBsp::goes_to(int location) const {
    if (multi) return true;
    if (online()) return location == 1 || (location == 2 && online_rot);
    if (location == 0) return to_zero != 0;
    return in_mode == 3 || (location < 3 && in_mode == location);
}

Result<std::int32_t> McBsp::read(int location) const {
    if (location < 0 || location > 3)
        return fail(ErrorKind::refused,
                    fmt::format("read_mcbsp: No is {}; it must be 0 to 3; nothing was done", location));
    if (filled >> location & 1) return memory[static_cast<std::size_t>(location)];
    if (!goes_to(location))
        return fail(ErrorKind::refused, fmt::format("read_mcbsp: location {} is empty; first use {}", location,
                                                    commands_before_reading[static_cast<std::size_t>(location)]));
    if (!received) return fail(ErrorKind::refused, fmt::format("read_mcbsp: {}", no_word_yet));
    return fail(
        ErrorKind::refused,
        fmt::format("read_mcbsp: location {} gets its first word in the next 10 us; advance the time first", location));
}

}  // namespace motionrack::rtc5
