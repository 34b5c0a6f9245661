// Blocking homing: one axis, several at once, repeated; and the source's four functions.
#pragma once

#include <functional>
#include <motionrack/cards/mcx314/driver/home.hpp>
#include <span>

namespace motionrack::mcx314 {

/// Polling interval of a waiting homing without interrupts.
inline constexpr Duration home_look_every = milliseconds(1);

/// Advances the port's time until every one of `homes` (at least one, of one driver, started) has ended. Stops all,
/// decelerating, after `timeout`, on a stop request by the user, and on the first failure. `seen` is called after each
/// round of polls; may be empty. Errors: those of the first failure.
Result<void> finish_homes(std::span<Home* const> homes, Duration timeout, const std::function<void()>& seen = {});

/// Homes one axis and waits for it.
Result<HomeReport> home(Driver& driver, int axis, const HomeSettings& settings, Duration timeout = whole_seconds(600));

/// End positions of repeated homing, in pulses (LP) and encoder counts (EP) relative to the first end.
struct HomeSpread {
    std::vector<std::int64_t> pulses;
    std::vector<std::int64_t> counts;
    std::int64_t spread = 0;         ///< range of `pulses`
    std::int64_t counts_spread = 0;  ///< range of `counts`; shows step loss of an axis with an encoder
    HomeReport last;
};

/// Homes once, then `repeats` times more, each from another position: off from home, against the search direction, by
/// the entries of `away` in turn (pulses, > 0, not empty). Errors: refused, and those of the failed homing.
Result<HomeSpread> repeat_home(Driver& driver, int axis, const HomeSettings& settings, int repeats,
                               std::span<const std::int64_t> away, Duration timeout = whole_seconds(600));

/// Home all axes of the mask at once, by the source's functions: in - direction, with R as written before. WR1Reg: WR1
/// with the home input enabled at its level, and for types 3 and 4 IN2's level for the index. The return is at SV, the
/// slow approach at half of SV, the index search of type 3 at SV. Errors: refused; those of the first axis that fails.
Result<std::vector<HomeReport>> HomeType1(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A);
Result<std::vector<HomeReport>> HomeType2(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A);
Result<std::vector<HomeReport>> HomeType3(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A);
Result<std::vector<HomeReport>> HomeType4(Driver& driver, unsigned axes, unsigned WR1Reg, std::int64_t SV,
                                          std::int64_t V, std::int64_t A);

}  // namespace motionrack::mcx314
