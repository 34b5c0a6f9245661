// Settings of the cards of a grating bus.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace motionrack::grating_bus {

/// Role of a motion card. remote: a slave whose bus is in another crate; its frames arrive through Card::take().
enum class CardRole : std::uint8_t { host, slave, remote };
/// Direction of a level shifter; as_role: out on a host, in on a slave.
enum class Shifter : std::uint8_t { as_role, out, in };

/// Settings of a motion card.
struct CardSettings {
    CardRole role = CardRole::slave;
    int scales = 4;              ///< N, 1 .. 128: scales in a frame
    int first = 0;               ///< 0 .. 128 - N: address of the first scale, without a list
    std::vector<int> addresses;  ///< the list: N different addresses, 0 .. 127; empty: consecutive from `first`
    BusTiming timing;            ///< waits and clock, 0.1 ns .. 6 us each
    Duration period = microseconds(200);         ///< frame period, 1 us .. 100 ms
    Duration offset{0};                          ///< host: instant of its first pulse, 0 .. period
    Shifter clock_shifter = Shifter::as_role;    ///< direction for clk, hold and read_n
    Shifter address_shifter = Shifter::as_role;  ///< direction for addr
    bool verify_lines = true;                    ///< frames with wrong line levels are not published
    std::uint32_t seed = 1;                      ///< seed of the jitter

    /// Returns the address of the scale of word `k` (0 .. N - 1).
    int address(int k) const { return addresses.empty() ? first + k : addresses[static_cast<std::size_t>(k)]; }
    bool same_list(const CardSettings& other) const;
    /// Returns the highest address of the list.
    int last_address() const;

    bool clock_out() const {
        return clock_shifter == Shifter::as_role ? role == CardRole::host : clock_shifter == Shifter::out;
    }
    bool address_out() const {
        return address_shifter == Shifter::as_role ? role == CardRole::host : address_shifter == Shifter::out;
    }
    bool wrong_direction() const {
        return clock_out() != (role == CardRole::host) || address_out() != (role == CardRole::host);
    }
};

/// Settings of a decoder card.
struct DecoderSettings {
    int scales = 4;                     ///< 1 .. 128
    Duration latch = nanoseconds(10);   ///< from HOLD to valid counts, 0 .. 6 us
    Duration output = nanoseconds(20);  ///< from the address to valid data, 0.1 ns .. 6 us
};

/// Parses the addresses in a rack file: "5, 2, 9". Errors: invalid_input if the text is not a comma-separated list of
/// whole numbers, an address is beyond 127 or occurs twice, or the list has more than 128 addresses.
Result<std::vector<int>> addresses_from_text(std::string_view text);

/// Checks settings. Errors: refused, with the setting, its value and its range; also if a frame does not fit into its
/// period, with its duration.
Result<void> check(const CardSettings& settings);
Result<void> check(const DecoderSettings& settings);
/// Checks that the decoder answers within the card's bus wait times. Errors: refused, with the numbers.
Result<void> check(const CardSettings& card, const DecoderSettings& decoder);

}  // namespace motionrack::grating_bus
