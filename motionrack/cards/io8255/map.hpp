// The IO8255's registers, modes and pins as constants, shared by model, driver, documents and tests. The tables are in
// map/.
#pragma once

#include <motionrack/base/card_map.hpp>
#include <motionrack/cards/io8255/map/modes.hpp>
#include <motionrack/cards/io8255/map/pins.hpp>
#include <motionrack/cards/io8255/map/registers.hpp>

namespace motionrack::io8255 {

inline constexpr int port_count = 3, lines_of_port = 8, group_count = 2;
inline constexpr std::uint8_t no_answer = 0xFF;  ///< read from an offset without a register

/// Returns the offset of the register with this name; an undeclared name does not compile.
consteval std::uint8_t offset(std::string_view name) {
    return static_cast<std::uint8_t>(register_named(map::registers, name).offset);
}
/// Returns a field of a register: field("BIT", "NUMBER").
consteval Field field(std::string_view reg, std::string_view name) {
    return {mask_of(register_named(map::registers, reg), name)};
}

namespace map {

inline constexpr CardMap card = {
    "io8255", "Parallel input and output card: three ports of 8 lines, of which two can be strobed", registers, {}, {},
    pins};

}  // namespace map

/// The whole map, for documents, inspectors and traces.
inline const CardMap& card_map() {
    return map::card;
}

}  // namespace motionrack::io8255
