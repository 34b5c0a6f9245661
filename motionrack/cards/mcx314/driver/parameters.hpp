// The parameters of data commands: the range that the function library accepts, and the name in messages.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

struct Parameter {
    unsigned code = 0;
    std::int64_t min = 0;
    std::int64_t max = 0;
    const char* name = "";
};

/// A parameter with its documented range from the map.
consteval Parameter documented(std::string_view command, const char* name) {
    const CommandInfo& info = command_named(map::commands, command);
    return {info.code, info.min, info.max, name};
}

namespace param {
inline constexpr Parameter R = documented("R", "The range R");
inline constexpr Parameter K = documented("K", "The acceleration's rate K");
inline constexpr Parameter A = documented("A", "The acceleration A");
inline constexpr Parameter D = documented("D", "The deceleration D");
inline constexpr Parameter SV = documented("SV", "The initial speed SV");
inline constexpr Parameter V = documented("V", "The drive speed V");
inline constexpr Parameter DP = documented("DP", "The manual deceleration point DP");
inline constexpr Parameter C = documented("C", "The centre C");
inline constexpr Parameter LP = documented("LP", "The logical position LP");
inline constexpr Parameter EP = documented("EP", "The real position EP");
inline constexpr Parameter COMP_PLUS = documented("COMP_PLUS", "The comparison value COMP+");
inline constexpr Parameter COMP_MINUS = documented("COMP_MINUS", "The comparison value COMP-");
inline constexpr Parameter AO = documented("AO", "The acceleration counter offset AO");
/// Pulses of a fixed drive: the sign selects the command, the register takes the magnitude.
inline constexpr Parameter pulses{cmd::P, -map::max_pulses, map::max_pulses, "The number of output pulses P"};
/// Finish point of an interpolation: the same register as a signed 24-bit number.
inline constexpr Parameter finish{cmd::P, map::min_24, map::max_24, "The finish point P"};
/// R of the axes for the second and third speed of constant vector speed: up to 8,000,000 * 1.732.
inline constexpr Parameter vector_range{cmd::R, R.min, 13'856'407, "The range R"};
}  // namespace param

}  // namespace motionrack::mcx314
