// The RTC5's commands, status bits, pins and numbers as constants, shared by model, library, documents and tests.
#pragma once

#include <algorithm>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/rtc5/map/card.hpp>
#include <motionrack/cards/rtc5/map/commands.hpp>
#include <motionrack/cards/rtc5/map/errors.hpp>
#include <motionrack/cards/rtc5/map/pins.hpp>
#include <motionrack/cards/rtc5/map/signals.hpp>
#include <motionrack/cards/rtc5/map/status.hpp>
#include <string>
#include <vector>

namespace motionrack::rtc5 {

inline constexpr Duration tick_time = microseconds(10);           ///< output period of the card
inline constexpr int half_us_per_tick = 20;                       ///< resolution of laser switching: 0.5 us
inline constexpr double min_field = -524288, max_field = 524287;  ///< field of the mirrors, bits (20-bit output)
inline constexpr double min_z = -32768, max_z = 32767;
inline constexpr int encoder_count = 2, head_count = 2, table_count = 4, start_queue = 8;
inline constexpr int simulated_counts = 10;  ///< counts per tick of a simulated encoder: 1 MHz
inline constexpr std::int64_t min_list_memory = 16, max_list_memory = 1 << 20;
inline constexpr std::size_t max_depth = 63, calls_per_tick = 64, subroutine_count = 1024;
inline constexpr double min_resolution = 100;  ///< counts per revolution; a lower one disables a rotary correction

/// Bits of set_control_mode: external start enabled, encoder reset at a start, equidistant starts.
inline constexpr std::uint32_t control_ext_start = 1u << 0, control_reset_at_start = 1u << 9,
                               control_equidistant = 1u << 10;

/// Makes a list command with validated parameters. Clips coordinates and speeds. Errors: refused, with command,
/// parameter, number and range, for NaN, infinities, fractions of whole parameters, and values outside a range that
/// does not clip.
Result<Command> list_command(Op op, std::span<const double> parameters);
inline Result<Command> list_command(Op op, std::initializer_list<double> parameters) {
    return list_command(op, std::span<const double>(parameters.begin(), parameters.size()));
}

/// Validates a parameter of a control command. Errors: refused (with command, if given, parameter, number and range) if
/// it is not a number, or is outside `min` to `max` or the range of its kind.
Result<void> check_parameter(std::string_view command, std::string_view name, double value, double min, double max,
                             std::string_view unit = "");
inline Result<void> check_parameter(std::string_view command, std::string_view name, double value, Kind kind) {
    const KindInfo range = kind_info(kind);
    return check_parameter(command, name, value, range.min, range.max, range.unit);
}
/// Returns the nearest value within the range of a parameter kind.
constexpr double clipped(double value, Kind kind) {
    const KindInfo range = kind_info(kind);
    return std::clamp(value, range.min, range.max);
}

/// Lists the set bits of a word with their meaning: "FLY_X_OVERFLOW: the corrected X was above 524287".
std::vector<std::string> decoded(std::uint32_t word, std::span<const BitInfo> bits);

/// Returns the map of the card (words, commands, pins), for documents, inspectors and traces.
inline const CardMap& card_map() {
    return map::card;
}

}  // namespace motionrack::rtc5
