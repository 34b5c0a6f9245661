// The lines of the bus: their drivers, their resulting levels, and the conflicts between drivers.
//
//   host  ──1──┐
//   slave ──z──┼── line: the common level of its drivers; drivers that differ conflict, bit by bit the low level wins
//   host 2 ─0──┘
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>
#include <string_view>

namespace motionrack::grating_bus {

enum class Line : std::uint8_t { clk, hold, read_n, addr, data };
inline constexpr std::size_t line_count = 5;
inline constexpr int max_drivers = 64;  ///< maximum number of cards and decoders of a bus

struct LineType {
    std::string_view name;
    std::uint32_t rest;  ///< level of an undriven line
    int bits;
};
inline constexpr std::array<LineType, line_count> line_types = {{
    {"clk", 0, 1},
    {"hold", 0, 1},
    {"read_n", 1, 1},
    {"addr", 0x7F, 7},
    {"data", 0xFFFFFFFF, 32},
}};
constexpr std::uint32_t rest_of(Line line) {
    return line_types[static_cast<std::size_t>(line)].rest;
}
/// Returns the number of bits of a line.
constexpr int bits_of_line(Line line) {
    return line_types[static_cast<std::size_t>(line)].bits;
}
/// Returns the mask of all bits of a line.
constexpr std::uint32_t bits_of(Line line) {
    return 0xFFFFFFFFu >> (32 - bits_of_line(line));
}
static_assert(1 << bits_of_line(Line::addr) == max_scales, "every address is that of a scale");

/// A conflict: drivers differed on a line from `begin` to `end`.
struct Conflict {
    Instant begin{};
    Instant end = never;     ///< never: the conflict persists
    std::uint64_t high = 0;  ///< bit n: driver n drove a bit high that another drove low, at some time of the conflict
    std::uint64_t low = 0;   ///< bit n: driver n drove such a bit low
    std::uint64_t line = 0;  ///< Line
};

/// Drivers and levels of all lines, and the list of conflicts; trivially copyable.
class Lines {
  public:
    static constexpr std::size_t kept = 256;  ///< number of conflicts kept in the list

    std::uint32_t level(Line line) const { return level_[at(line)]; }
    void drive(Line line, int driver, std::uint32_t value) {
        driving_[at(line)] |= std::uint64_t{1} << driver;
        value_[at(line)][static_cast<std::size_t>(driver)] = value;
    }
    void leave(Line line, int driver) { driving_[at(line)] &= ~(std::uint64_t{1} << driver); }
    /// Forces the bits `mask` of the line to `value`, whatever is driven.
    void force(Line line, std::uint32_t mask, std::uint32_t value) {
        forced_[at(line)] = mask, stuck_[at(line)] = value & mask;
    }
    bool any_forced() const { return (forced_[0] | forced_[1] | forced_[2] | forced_[3] | forced_[4]) != 0; }

    /// Computes the levels from the drivers.
    void settle();
    /// Lists conflicts once an instant has settled. Returns the lines (one bit each) on which a conflict began.
    unsigned note_conflicts(Instant now);
    bool conflict() const { return in_conflict_ != 0; }
    /// Returns the number of conflicts on this line since the start.
    std::uint64_t conflicts(Line line) const { return reported_[at(line)]; }
    std::uint64_t all_conflicts() const { return count_; }
    /// Returns conflict number `n` (all_conflicts() - kept .. all_conflicts() - 1).
    const Conflict& conflict(std::uint64_t n) const { return list_[n % slots]; }

  private:
    static constexpr std::size_t slots =
        kept + line_count;  // conflicts of no length, which are removed again, push no other out

    static constexpr std::size_t at(Line line) { return static_cast<std::size_t>(line); }
    /// Returns the AND of all driven levels; sets `any` to their OR.
    std::uint32_t driven(std::size_t i, std::uint32_t& any) const;
    unsigned note_conflicts(std::size_t i, Instant now);
    void end_conflict(std::size_t i, Instant now);
    /// Returns true if the line's last conflict ended at this instant.
    bool ended_now(std::size_t i, Instant now) const;
    /// Returns true while conflict number `n` is still in the list.
    bool listed(std::uint64_t n) const { return count_ <= n + kept; }

    std::array<std::uint32_t, line_count> level_ = {0, 0, 1, rest_of(Line::addr), rest_of(Line::data)};
    std::array<std::uint32_t, line_count> forced_{};
    std::array<std::uint32_t, line_count> stuck_{};
    std::uint32_t in_conflict_ = 0;  // one bit per line
    std::array<std::uint64_t, line_count> driving_{};
    std::array<std::array<std::uint32_t, max_drivers>, line_count> value_{};
    std::array<std::uint64_t, line_count> reported_{};
    std::array<std::uint64_t, line_count> open_{};  // number of the present conflict
    std::uint64_t count_ = 0;
    std::array<Conflict, slots> list_{};
};

}  // namespace motionrack::grating_bus
