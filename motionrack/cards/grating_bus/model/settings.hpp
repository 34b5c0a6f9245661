// How the cards of a grating bus are set.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace motionrack::grating_bus {

/// remote: a slave whose bus is in another crate: its frames come from outside (Card::take).
enum class Role : std::uint8_t { host, slave, remote };
/// Which way a level shifter works; as_role: out on a host, in on a slave.
enum class Shifter : std::uint8_t { as_role, out, in };

/// Of a motion card.
struct CardSettings {
    Role role = Role::slave;
    int scales = 4;                       ///< N, 1 .. 128: scales of a frame
    int first = 0;                        ///< 0 .. 128 - N: address of the first one, without a list
    std::vector<int> addresses;           ///< the list: 0 .. 127 each, N of them, each once; empty: from `first` on
    Timing timing;                        ///< waits and clock, 0.1 ns .. 6 us each
    Duration period = microseconds(200);  ///< of the frames, 1 us .. 100 ms
    Duration offset{0};                   ///< host: its first pulse, 0 .. period
    Shifter clock_shifter = Shifter::as_role;    ///< of clk, hold and read_n
    Shifter address_shifter = Shifter::as_role;  ///< of addr
    bool checks = true;                          ///< frames whose lines are not as they should be are not published
    std::uint32_t seed = 1;                      ///< of jitter

    /// Of the scale of word `k` (0 .. N - 1).
    int address(int k) const { return addresses.empty() ? first + k : addresses[static_cast<std::size_t>(k)]; }
    bool same_list(const CardSettings& other) const;
    /// The greatest address of the list.
    int last_address() const;

    bool clock_out() const {
        return clock_shifter == Shifter::as_role ? role == Role::host : clock_shifter == Shifter::out;
    }
    bool address_out() const {
        return address_shifter == Shifter::as_role ? role == Role::host : address_shifter == Shifter::out;
    }
    bool wrong_direction() const {
        return clock_out() != (role == Role::host) || address_out() != (role == Role::host);
    }
};

/// Of a decoder card.
struct DecoderSettings {
    int scales = 4;                     ///< 1 .. 128
    Duration latch = nanoseconds(10);   ///< from HOLD to valid counts, 0 .. 6 us
    Duration output = nanoseconds(20);  ///< from the address to valid data, 0.1 ns .. 6 us
};

/// The addresses of a list as a rack file has it: "5, 2, 9". Errors: invalid_input with what is wrong: no list of whole
/// numbers with commas between them, an address beyond 127, more than 128 of them, one that is there twice.
Result<std::vector<int>> addresses_from_text(std::string_view text);

/// Errors: refused, with the setting, its value and its range; so is a frame that does not fit into its period, with
/// its time.
Result<void> check(const CardSettings& settings);
Result<void> check(const DecoderSettings& settings);
/// Whether a card can read its scales from this decoder in its waits. Errors: refused, with the numbers.
Result<void> check(const CardSettings& card, const DecoderSettings& decoder);

}  // namespace motionrack::grating_bus
