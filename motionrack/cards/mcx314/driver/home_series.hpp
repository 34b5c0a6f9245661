// Homing while the caller waits: one axis, several at once, many times over; and the source's four functions.
#pragma once

#include <functional>
#include <motionrack/cards/mcx314/driver/home.hpp>
#include <span>

namespace motionrack::mcx314 {

/// How often a waiting homing looks where nothing interrupts it.
inline constexpr Duration home_look_every = milliseconds(1);

/// Advances the port's time until every one of `homes` (at least one, of one driver, started) has ended. All are
/// stopped, decelerating, after `timeout`, when the user asks to stop, and when one of them fails. `seen` is called
/// after each round of looks; may be empty. Errors: those of the first that failed.
Result<void> finish_homes(std::span<Home* const> homes, Duration timeout, const std::function<void()>& seen = {});

/// Homes one axis and waits for it.
Result<HomeReport> home(Driver& driver, int axis, const HomeSettings& settings, Duration timeout = whole_seconds(600));

/// Where the same homing ended, time after time, in pulses (LP) and encoder counts (EP) from where the first one ended.
struct HomeSpread {
    std::vector<std::int64_t> pulses;
    std::vector<std::int64_t> counts;
    std::int64_t spread = 0;         ///< greatest less least of `pulses`
    std::int64_t counts_spread = 0;  ///< and of `counts`: with an encoder, lost steps show here
    HomeReport last;
};

/// Homes once, then `repeats` times more, each from another place: off from home, against the search's direction, by
/// the entries of `away` in turn (pulses, > 0, not empty). Errors: refused, and those of the homing that fails.
Result<HomeSpread> repeat_home(Driver& driver, int axis, const HomeSettings& settings, int repeats,
                               std::span<const std::int64_t> away, Duration timeout = whole_seconds(600));

/// The source's homing functions: all axes of the mask at once, in - direction, with R as it was written before.
/// WR1Reg: WR1 with the home input enabled at its level, and in types 3 and 4 IN2's level for the index. Back it goes
/// at SV, slowly at half of SV, in type 3 to the index at SV. Errors: refused; those of the first axis that fails.
Result<std::vector<HomeReport>> HomeType1(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A);
Result<std::vector<HomeReport>> HomeType2(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A);
Result<std::vector<HomeReport>> HomeType3(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A);
Result<std::vector<HomeReport>> HomeType4(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A);

}  // namespace motionrack::mcx314
