// The IOFLEX02's registers, commands, states and pins as constants, shared by model, driver, documents and tests. The
// tables are in map/.
#pragma once

#include <motionrack/base/card_map.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/ioflex02/map/calibration.hpp>
#include <motionrack/cards/ioflex02/map/pins.hpp>
#include <motionrack/cards/ioflex02/map/registers.hpp>

namespace motionrack::ioflex02 {

inline constexpr int axis_count = 4;
inline constexpr Duration sample_time = nanoseconds(100);  ///< sampling period of the lines
inline constexpr Duration time_tick = nanoseconds(1'200);  ///< one count of the time
inline constexpr std::uint32_t mask_24 = 0xFFFFFF;
inline constexpr std::uint32_t window = 0x100;  ///< size of a card's address window on the bus, bytes
inline constexpr std::uint16_t signature = 0x4F49;
inline constexpr std::uint16_t no_answer = 0xFFFF;  ///< answer without a card or a project

/// Returns the offset of the register with this name; an undeclared name does not compile.
consteval std::uint32_t offset(std::string_view name) {
    return register_named(map::registers, name).offset;
}
/// Returns a field of a register: field("CMD", "CMD2").
consteval Field field(std::string_view reg, std::string_view name) {
    return {mask_of(register_named(map::registers, reg), name)};
}

namespace mode {
inline constexpr Field REVERSED = field("MODE", "REVERSED"), EDGES = field("MODE", "EDGES");
inline constexpr Field INDEX_LOW = field("MODE", "INDEX_LOW"), FILTER = field("MODE", "FILTER");
inline constexpr std::uint16_t all = REVERSED.mask | EDGES.mask | INDEX_LOW.mask | FILTER.mask;
}  // namespace mode

/// Reason for which the card refused the last image; value of the register CFG_ERROR.
enum class CfgError : std::uint16_t { none, foreign, length, cut_short, crc, unknown_project };

/// Returns the lowest 24 bits of `bits` as a number in two's complement, -8,388,608 .. 8,388,607.
constexpr std::int32_t signed24(std::int64_t bits) {
    return static_cast<std::int32_t>(((bits & mask_24) ^ 0x800000) - 0x800000);
}

namespace map {

inline constexpr CardMap card = {
    "ioflex02",
    "Position card for four incremental encoders: 24-bit counters with calibration, time of 1.2 us, inputs and outputs",
    registers,
    commands,
    machines,
    pins};

}  // namespace map

/// The whole map, for documents, inspectors and traces.
inline const CardMap& card_map() {
    return map::card;
}

}  // namespace motionrack::ioflex02
