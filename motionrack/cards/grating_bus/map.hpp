// The grating bus' registers, states and pins as constants, shared by model, driver, documents and tests.
//
// The motion card's processor reads its logic through a 16-bit interface (the source's processor has one beside its
// 64-bit one). The source names no registers; the map is the project's own. Offsets are byte offsets; values of more
// than 16 bits are several registers, _L the low one.
//
//   00h .. 1Fh   the card: role, state, control
//   20h .. 3Fh   error counters; each is 16 bits and stays at FFFFh
//   40h .. 4Fh   the claimed frame: sequence, time, N, CRC
//  100h .. 2FEh  the claimed frame: count of its word k at 100h + 4k (low) and 102h + 4k (high)
//  300h .. 3FEh  the claimed frame: address of the scale of its word k at 300h + 2k
//  400h .. 4FEh  the card's own list: address of its word k at 400h + 2k
#pragma once

#include <array>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/grating_bus/frame.hpp>

namespace motionrack::grating_bus {

namespace map {

inline constexpr FieldInfo control_fields[] = {
    {"CLAIM", 0x0001, "the buffer published last is the processor's until the next CLAIM or RELEASE"},
    {"RELEASE", 0x0002, "gives the claimed buffer back"},
    {"CLEAR_ERRORS", 0x0004, "makes the counters 20h to 2Fh 0"},
    {"RESET", 0x0008, "aborts the current frame; sequence and counters restart"},
};
inline constexpr FieldInfo role_fields[] = {
    {"HOST", 0x0001, "1: the card drives clock and addresses; 0: it only reads"},
    {"CLOCK_OUT", 0x0002, "the shifter of clk, hold and read_n drives the bus"},
    {"ADDRESS_OUT", 0x0004, "the shifter of addr drives the bus"},
    {"CHECKS", 0x0008, "frames with wrong line levels are not published"},
};
inline constexpr FieldInfo status_fields[] = {
    {"FRAME", 0x0001, "a frame was published since the last CLAIM"},
    {"CLAIMED", 0x0002, "a buffer is claimed"},
    {"STALE", 0x0004, "no frame yet, or none for two periods"},
    {"DIRECTION", 0x0008, "a shifter's direction does not fit the role"},
    {"BUSY", 0x0010, "a frame is being read"},
    {"OFF", 0x0020, "the card is switched off"},
};
inline constexpr FieldInfo state_fields[] = {
    {"STATE", 0x000F, "number of the state, 0 for S0"},
    {"WORD", 0xFF00, "number of the word being read"},
};

inline constexpr Access r = Access::read, w = Access::write;

inline constexpr RegisterInfo registers[] = {
    {"CONTROL", 0x00, 16, w, false, "", "commands of the processor; bits act from the lowest to the highest",
     control_fields},
    {"SIGNATURE", 0x00, 16, r, false, "", "4742h: a card of a grating bus", {}},
    {"ROLE", 0x02, 16, r, false, "", "settings of the card", role_fields},
    {"STATUS", 0x04, 16, r, false, "", "frame and faults", status_fields},
    {"STATE", 0x06, 16, r, false, "", "state of the sequence", state_fields},
    {"SCALES", 0x08, 16, r, false, "", "N, scales of a frame", {}},
    {"FIRST", 0x0A, 16, r, false, "", "address of the first scale of the list", {}},
    {"T1", 0x0C, 16, r, false, "", "wait for the latch, 0.1 ns", {}},
    {"T2", 0x0E, 16, r, false, "", "wait for stable data, 0.1 ns", {}},
    {"T3", 0x10, 16, r, false, "", "wait for the data's latch, 0.1 ns", {}},
    {"CLOCK", 0x12, 16, r, false, "", "period of the logic's clock, 0.1 ns", {}},
    {"PERIOD_L", 0x14, 16, r, false, "", "period of the frames, 0.1 ns, low", {}},
    {"PERIOD_H", 0x16, 16, r, false, "", "the same, high", {}},
    {"FRAMES_L", 0x18, 16, r, false, "", "frames published since the start, low", {}},
    {"FRAMES_H", 0x1A, 16, r, false, "", "the same, high", {}},
    {"BROKEN", 0x20, 16, r, false, "", "bad frames, which were not published", {}},
    {"MISSED_WORDS", 0x22, 16, r, false, "", "words whose read_n was 1", {}},
    {"ALIEN", 0x24, 16, r, false, "", "words whose address differs from the card's own list", {}},
    {"LINES", 0x26, 16, r, false, "", "words at which clk, hold or read_n had a wrong level", {}},
    {"MISSED_EDGES", 0x28, 16, r, false, "", "missed edges of clk", {}},
    {"OVERRUN", 0x2A, 16, r, false, "", "pulses or edges that came while a frame was being read", {}},
    {"SEQUENCE_L", 0x40, 16, r, false, "", "claimed frame: sequence, low", {}},
    {"SEQUENCE_H", 0x42, 16, r, false, "", "claimed frame: the same, high", {}},
    {"TIME_0", 0x44, 16, r, false, "", "claimed frame: time of HOLD, 0.1 ns, bits 0 to 15", {}},
    {"TIME_1", 0x46, 16, r, false, "", "claimed frame: time, bits 16 to 31", {}},
    {"TIME_2", 0x48, 16, r, false, "", "claimed frame: time, bits 32 to 47", {}},
    {"TIME_3", 0x4A, 16, r, false, "", "claimed frame: time, bits 48 to 63", {}},
    {"WORDS", 0x4C, 16, r, false, "", "claimed frame: N, the number of its words; 0: no frame was published yet", {}},
    {"CRC_L", 0x4E, 16, r, false, "", "claimed frame: CRC-32 of the frame, low", {}},
    {"CRC_H", 0x50, 16, r, false, "", "claimed frame: the same, high", {}},
    {"COUNT_L", 0x100, 16, r, false, "", "claimed frame: count of word 0, low; word k follows 4k bytes later", {}},
    {"COUNT_H", 0x102, 16, r, false, "", "claimed frame: the same, high", {}},
    {"ADDRESS", 0x300, 16, r, false, "", "claimed frame: scale address of word 0; word k follows 2k bytes later", {}},
    {"LIST",
     0x400,
     16,
     r,
     false,
     "",
     "address that the card's own list has for word 0; word k follows 2k bytes later",
     {}},
};
static_assert(declared<registers_flaw(registers)>());

inline constexpr StateInfo states[] = {
    {"S0", "idle, waits for the pulse of the period (a slave: for the edge of clk)"},
    {"S1", "waits T1 until the decoder has latched its counts"},
    {"S2", "READ low, then the first address is on the bus; waits T2 for stable data"},
    {"S3", "latches the data, waits T3"},
    {"S4", "read_n is high again"},
    {"S5", "all scales read?"},
    {"S6", "no, one more"},
    {"S7", "waits T1"},
    {"S8", "READ low, then the next address is on the bus; waits T2"},
    {"S9", "latches the data, waits T3"},
    {"S10", "read_n is high again"},
    {"S11", "all scales are read"},
    {"S12", "emits the pulse frame_done"},
};
/// Conditions of S5, the only state with two exits.
inline constexpr std::string_view words_left = "scales are left", all_read = "all are read";
inline constexpr TransitionInfo transitions[] = {
    {"S0", "S1", "pulse or edge"}, {"S1", "S2", "after T1"},    {"S2", "S3", "after T2"},  {"S3", "S4", "after T3"},
    {"S4", "S5", "next clock"},    {"S5", "S6", words_left},    {"S5", "S11", all_read},   {"S6", "S7", "next clock"},
    {"S7", "S8", "after T1"},      {"S8", "S9", "after T2"},    {"S9", "S10", "after T3"}, {"S10", "S5", "next clock"},
    {"S11", "S12", "next clock"},  {"S12", "S0", "next clock"},
};
inline constexpr MachineInfo machines[] = {
    {"frame", "reading of one frame; a slave follows the states of the host", states, transitions},
};
static_assert(declared<machines_flaw(machines)>());

inline constexpr PinInfo pins[] = {
    {"state", PinDirection::output, false, "number of the state, 0 .. 12"},
    {"frame_done", PinDirection::output, false, "pulse of one clock period: a frame is complete"},
    {"int_n", PinDirection::output, true, "low while STATUS.FRAME"},
    {"vout0", PinDirection::output, false, "analog output 0 of the processor, V"},
    {"vout1", PinDirection::output, false, "analog output 1"},
    {"vout2", PinDirection::output, false, "analog output 2"},
    {"vout3", PinDirection::output, false, "analog output 3"},
};
static_assert(declared<pins_flaw(pins)>());

// ---- connector P2, as printed in the source

/// A pin of connector P2. The source's scan has broken characters, so the readings are guesses.
struct ConnectorPin {
    std::string_view printed;  ///< text of the scan
    std::string_view likely;   ///< the likeliest reading
    std::string_view or_else;  ///< another reading; empty: no similar one
    std::string_view line;     ///< the bus line; the source does not assign pins to address lines
    std::string_view doubt;    ///< reason why `likely` is a guess
};
inline constexpr ConnectorPin connector_pins[] = {
    {"F2E12", "P2C12", "P2E12", "clk", "misread: the P printed as F; a VME connector of three rows has no row E"},
    {"?2430", "P2A30", "", "addr", "? for P, 4 for A"},
    {"?2031", "P2C31", "P2D31", "addr", "? for P, 0 for C or D"},
    {"?2431", "P2A31", "", "addr", "? for P, 4 for A"},
    {"?2032", "P2C32", "P2D32", "addr", "? for P, 0 for C or D"},
    {"?2々5", "P2A5", "", "addr", "? for P, 々 for A: the least certain pin"},
    {"?204", "P2C4", "P2D4", "addr", "? for P, 0 for C or D"},
    {"?205", "P2C5", "P2D5", "addr", "? for P, 0 for C or D"},
};

/// Voltage levels on one side of the level shifters.
struct SignalLevels {
    std::string_view side;
    std::string_view family;
    double supply_v;
    double max_low_in_v;   ///< an input reads a voltage below it as low
    double min_high_in_v;  ///< an input reads a voltage above it as high
};
inline constexpr SignalLevels signal_levels[] = {
    {"bus, connector P2", "TTL", 5.0, 0.8, 2.0},
    {"pins of the card's logic", "LVTTL", 3.3, 0.8, 2.0},
};

// ---- the decoder card

inline constexpr RegisterInfo decoder_registers[] = {
    {"SIGNATURE", 0x00, 16, r, false, "", "4744h: the decoder of a grating bus", {}},
    {"SCALES", 0x02, 16, r, false, "", "scales that it counts", {}},
    {"COUNT_L",
     0x100,
     16,
     r,
     false,
     "",
     "count of scale 0 now, low; reading it keeps the high word for the next read; scale n follows 4n bytes later",
     {}},
    {"COUNT_H", 0x102, 16, r, false, "", "the high word of the count whose low word was read last", {}},
};
static_assert(declared<registers_flaw(decoder_registers)>());

/// Name of a numbered pin: "a0" .. "a127".
struct PinName {
    char text[5] = {};
    constexpr std::string_view view() const {
        return text[2] == 0   ? std::string_view(text, 2)
               : text[3] == 0 ? std::string_view(text, 3)
                              : std::string_view(text, 4);
    }
};
consteval std::array<PinName, 2 * max_scales> scale_pin_names() {
    std::array<PinName, 2 * max_scales> out;
    for (int i = 0; i < 2 * max_scales; ++i) {
        const int n = i / 2;
        char* at = out[static_cast<std::size_t>(i)].text;
        *at++ = i % 2 == 0 ? 'a' : 'b';
        for (const int unit : {100, 10, 1})
            if (n >= unit || unit == 1) *at++ = static_cast<char>('0' + n / unit % 10);
    }
    return out;
}
inline constexpr std::array<PinName, 2 * max_scales> scale_pins = scale_pin_names();
/// Pins of the decoder card; a* and b* stand for the lines A and B of each scale n.
inline constexpr PinInfo decoder_pins[] = {
    {"a*", PinDirection::input, false, "scale n, line A"},
    {"b*", PinDirection::input, false, "scale n, line B"},
};

inline constexpr CardMap decoder = {"grating_decoder",
                                    "Decoder card that counts up to 128 scales and freezes all of them at one instant",
                                    decoder_registers,
                                    {},
                                    {},
                                    decoder_pins};

inline constexpr CardMap card = {
    "grating_bus", "Motion card that reads all scales of one instant over a shared bus, as its host or as a listener",
    registers,     {},
    machines,      pins};

}  // namespace map

inline constexpr std::uint16_t signature = 0x4742;
inline constexpr std::uint16_t decoder_signature = 0x4744;
inline constexpr int output_count = 4;  ///< analog outputs of a motion card

/// Returns the offset of a register by its name; undeclared names do not compile.
consteval std::uint32_t offset(std::string_view name) {
    return register_named(map::registers, name).offset;
}
consteval std::uint32_t decoder_offset(std::string_view name) {
    return register_named(map::decoder_registers, name).offset;
}
/// Offset of the first count of a motion card and of a decoder.
inline constexpr std::uint32_t counts_at = offset("COUNT_L");
static_assert(decoder_offset("COUNT_L") == counts_at);
/// Offset of the first address of the claimed frame.
inline constexpr std::uint32_t addresses_at = offset("ADDRESS");
/// Offset of the first address of the card's own list.
inline constexpr std::uint32_t list_at = offset("LIST");
/// Returns a field of a register, as in field("STATUS", "STALE").
consteval Field field(std::string_view reg, std::string_view name) {
    return {mask_of(register_named(map::registers, reg), name)};
}

/// States of the sequence by their numbers.
enum class State : std::uint8_t { S0, S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11, S12 };

/// Returns the map of the card (registers, states, pins), for documents, inspectors and traces.
inline const CardMap& card_map() {
    return map::card;
}
inline const CardMap& decoder_map() {
    return map::decoder;
}

}  // namespace motionrack::grating_bus
