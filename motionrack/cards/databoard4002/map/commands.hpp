// The DataBoard 4002's commands (bytes to C2), declared once. Arguments and answers go through DATA, low byte first.
#pragma once

#include <motionrack/base/commands.hpp>
#include <motionrack/cards/databoard4002/arithmetic.hpp>
#include <motionrack/cards/databoard4002/slope_table.hpp>
#include <string_view>

namespace motionrack::databoard4002::map {

inline constexpr std::int64_t min_24 = -8'388'608, max_24 = 8'388'607;
inline constexpr std::int64_t max_rate = databoard4002::max_rate;
/// Law of a rate, for forms and tables: see hz_of().
inline constexpr std::string_view rate_law = "register value: pulse rate 400,000 Hz / (16,384 - value)";
inline constexpr int table_bytes = SlopeTable::size;
static_assert(signed24(min_24) == min_24 && signed24(max_24) == max_24 && signed24(max_24 + 1) == min_24);

inline constexpr CommandInfo commands[] = {
    {"A", 'A', 0, 0, 0, "", "", "athome: the present position is 0"},
    {"D", 'D', 3, min_24, max_24, "counts", "",
     "deviation; out: how far lock lets the position deviate (absolute value); in: present minus requested position",
     true, 3},
    {"G", 'G', 0, 0, 0, "", "", "go: starts what N, P, R and S specify; switches lock off"},
    {"I", 'I', 0, 0, 0, "", "", "initialise: without effect; the maker's programs send it"},
    {"L", 'L', 0, 0, 0, "", "", "lock: goes back to the requested position whenever it deviates by more than D"},
    {"M", 'M', 0, 0, 0, "", "", "manual: slope mode and lock off"},
    {"N", 'N', 3, min_24, max_24, "counts", "", "number: the target relative to the position at the next G"},
    {"O", 'O', 0, 0, 0, "", "", "on regulation: slope mode on, Rate to its maximum"},
    {"P", 'P', 3, min_24, max_24, "counts", "",
     "position; out: the absolute target of the next G; in: the present position", true, 3},
    {"Q", 'Q', 0, 0, 0, "", "", "quit: stops; the position register is zeroed, Rate stays"},
    {"R", 'R', 2, 0, max_rate, rate_law, "",
     "rate; out: the speed, at once, 0 switches the relay off; in: the present speed, negative backwards", true, 2},
    {"S", 'S', table_bytes, 0, 0, "", "", "slope: 48 intervals of rate (2 bytes) and position (3 bytes)"},
    {"V", 'V', 0, 0, 0, "", "", "version of the card's program", true, 1},
    {"W", 'W', 0, 0, 0, "", "", "watch out: clears the reset mark in EVENT"},
};
static_assert(clock_hz == 400'000 && divisor_of(0) == 16'384);  // as rate_law says
static_assert(declared<commands_flaw(commands)>());

}  // namespace motionrack::databoard4002::map
