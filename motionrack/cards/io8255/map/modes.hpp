// The rules of the modes: what the control word says, and which lines of port C a handshake uses.
//
//   line of port C       7     6     5     4     3      2     1     0
//   A strobed, input     free  free  IBF   STB   INTR
//   A strobed, output    OBF   ACK   free  free  INTR
//   B strobed, input                                    STB   IBF   INTR
//   B strobed, output                                   ACK   OBF   INTR
//
// STB, ACK and OBF are active low.
#pragma once

#include <cstdint>
#include <motionrack/cards/io8255/map/registers.hpp>

namespace motionrack::io8255 {

enum class IoPort : std::uint8_t { a, b, c };
/// Port A with the upper half of port C, or port B with the lower half.
enum class PortGroup : std::uint8_t { a, b };

namespace mode {
consteval Field field(std::string_view name) {
    return {mask_of(register_named(map::registers, "MODE_SET"), name)};
}
inline constexpr Field SET = field("SET"), A_MODE = field("A_MODE"), A_INPUT = field("A_INPUT");
inline constexpr Field C_UPPER_INPUT = field("C_UPPER_INPUT"), B_MODE = field("B_MODE"), B_INPUT = field("B_INPUT");
inline constexpr Field C_LOWER_INPUT = field("C_LOWER_INPUT");
}  // namespace mode

/// Modes and directions; initially those after power-up.
struct PortModes {
    bool a_strobed = false, a_input = true, c_upper_input = true;
    bool b_strobed = false, b_input = true, c_lower_input = true;

    constexpr bool is_strobed(PortGroup group) const { return group == PortGroup::a ? a_strobed : b_strobed; }
    constexpr bool is_input(PortGroup group) const { return group == PortGroup::a ? a_input : b_input; }
};

constexpr std::uint8_t word_of(const PortModes& modes) {
    unsigned out = mode::SET.mask;
    out = mode::A_MODE.set(out, modes.a_strobed);
    out = mode::A_INPUT.set(out, modes.a_input);
    out = mode::C_UPPER_INPUT.set(out, modes.c_upper_input);
    out = mode::B_MODE.set(out, modes.b_strobed);
    out = mode::B_INPUT.set(out, modes.b_input);
    out = mode::C_LOWER_INPUT.set(out, modes.c_lower_input);
    return static_cast<std::uint8_t>(out);
}
constexpr PortModes modes_of(unsigned word) {
    return {.a_strobed = mode::A_MODE.test(word),
            .a_input = mode::A_INPUT.test(word),
            .c_upper_input = mode::C_UPPER_INPUT.test(word),
            .b_strobed = mode::B_MODE.test(word),
            .b_input = mode::B_INPUT.test(word),
            .c_lower_input = mode::C_LOWER_INPUT.test(word)};
}

/// Lines of port C that the handshake of a strobed group uses.
struct HandshakeLines {
    int strobe = 0;   ///< STB or ACK: the peripheral drives it
    int flag = 0;     ///< IBF or OBF
    int request = 0;  ///< INTR
};
constexpr HandshakeLines handshake_of(PortGroup group, bool input) {
    if (group == PortGroup::b) return {2, 1, 0};
    return input ? HandshakeLines{4, 5, 3} : HandshakeLines{6, 7, 3};
}

/// Lines of port C by their use, a bit each. Lines in none of the masks are inputs.
struct PortCLines {
    unsigned strobes = 0;   ///< inputs of handshakes: STB, ACK
    unsigned flags = 0;     ///< outputs of handshakes: IBF, OBF, INTR
    unsigned outputs = 0;   ///< outputs that no handshake uses
    unsigned writable = 0;  ///< those of `outputs` that OUT_C writes; BIT writes every one of `outputs`
};
constexpr PortCLines port_c_lines(const PortModes& modes) {
    PortCLines out;
    for (const PortGroup group : {PortGroup::a, PortGroup::b}) {
        if (!modes.is_strobed(group)) continue;
        const HandshakeLines lines = handshake_of(group, modes.is_input(group));
        out.strobes |= 1u << lines.strobe;
        out.flags |= 1u << lines.flag | 1u << lines.request;
    }
    const unsigned upper = modes.c_upper_input ? 0 : 0xF0u, lower = modes.c_lower_input ? 0 : 0x0Fu;
    out.outputs = (upper | lower) & ~(out.strobes | out.flags);
    out.writable = out.outputs & ((modes.a_strobed ? 0 : 0xF0u) | (modes.b_strobed ? 0 : 0x0Fu));
    return out;
}

}  // namespace motionrack::io8255
