// The DataBoard 4002's ports, words, commands, states and pins as constants, shared by model, driver, documents and
// tests. The tables are in map/.
#pragma once

#include <motionrack/base/card_map.hpp>
#include <motionrack/cards/databoard4002/map/commands.hpp>
#include <motionrack/cards/databoard4002/map/registers.hpp>

namespace motionrack::databoard4002 {

/// Returns the number of the port with this name; an undeclared name does not compile.
consteval std::uint8_t port(std::string_view name) {
    return static_cast<std::uint8_t>(register_named(map::registers, name).offset);
}

namespace ports {
inline constexpr std::uint8_t DATA = port("OUT"), CS = port("CS"), C1 = port("C1"), C2 = port("C2"), C3 = port("C3");
inline constexpr std::uint8_t C4 = port("C4"), STAT = port("STAT"), RST = port("RST");
static_assert(port("INP") == DATA);
}  // namespace ports

/// Returns the byte of the command with this name; an undeclared name does not compile.
consteval std::uint8_t command(std::string_view name) {
    return static_cast<std::uint8_t>(command_named(map::commands, name).code);
}

/// Returns the mask of one bit of a port or word: bit("STAT", "READY") is 80h.
consteval std::uint8_t bit(std::string_view word, std::string_view name) {
    return static_cast<std::uint8_t>(mask_of(register_named(map::registers, word), name));
}

namespace stat {
inline constexpr std::uint8_t INT = bit("STAT", "INT"), EVENT = bit("STAT", "EVENT"), ZERO = bit("STAT", "ZERO");
inline constexpr std::uint8_t REF = bit("STAT", "REF"), EMS = bit("STAT", "EMS"), ESR = bit("STAT", "ESR");
inline constexpr std::uint8_t ESL = bit("STAT", "ESL"), READY = bit("STAT", "READY");
}  // namespace stat

/// Bits of the EVENT word and of the event enables (C4); an event of `maskable` has the same bit in both.
namespace event {
inline constexpr std::uint8_t POSITION = bit("EVENT", "POSITION"), ZERO = bit("EVENT", "ZERO");
inline constexpr std::uint8_t REF = bit("EVENT", "REF"), STOP = bit("EVENT", "STOP");
inline constexpr std::uint8_t WATCH_OUT = bit("EVENT", "WATCH_OUT");
inline constexpr std::uint8_t ON_READY = bit("C4", "ON_READY"), ON_EVENT = bit("C4", "ON_EVENT");
inline constexpr std::uint8_t maskable = POSITION | ZERO | REF | STOP;
static_assert(bit("C4", "POSITION") == POSITION && bit("C4", "ZERO") == ZERO && bit("C4", "REF") == REF &&
              bit("C4", "STOP") == STOP);
}  // namespace event

namespace map {

inline constexpr StateInfo host_states[] = {
    {"ready", "Ready is 1: an access is taken"},
    {"busy", "Ready is 0: the firmware works on the access; another one is lost"},
};
inline constexpr TransitionInfo host_transitions[] = {
    {"ready", "busy", "access to DATA, C2 or C4"},
    {"busy", "ready", "the access is done"},
};
inline constexpr StateInfo firmware_states[] = {
    {"running", "a pass does the access, looks at stops and position, and sets the speed"},
    {"hung", "no passes (a fault): an access clears Ready, and it stays 0"},
};
inline constexpr TransitionInfo firmware_transitions[] = {
    {"running", "hung", "fault watchdog.hang"},
    {"hung", "running", "the watchdog after 1 s, C3, INP 7, or the end of the fault"},
};
inline constexpr StateInfo move_states[] = {
    {"standing", "0 V, no pulses"},
    {"moving", "the output follows Rate and, in slope mode, the table; 0 V at an end stop in this direction"},
    {"locked", "standing, and watching the deviation once a G has been"},
    {"going back", "moving to the requested position with lock on: lock began it, or L came during the move"},
};
inline constexpr TransitionInfo move_transitions[] = {
    {"standing", "moving", "G"},
    {"standing", "locked", "L"},
    {"moving", "standing", "position reached or passed, Q, EMS"},
    {"moving", "going back", "L"},
    {"locked", "standing", "M, Q, EMS"},
    {"locked", "moving", "G"},
    {"locked", "going back", "the deviation is greater than D"},
    {"going back", "locked", "position reached or passed"},
    {"going back", "moving", "M, G"},
    {"going back", "standing", "Q, EMS"},
};
inline constexpr StateInfo collector_states[] = {
    {"idle", "no arguments are open"},
    {"either", "after D, P, R: the first access to DATA decides, OUT or INP"},
    {"collecting", "waits for argument bytes"},
    {"answering", "answer bytes are given out"},
};
inline constexpr TransitionInfo collector_transitions[] = {
    {"idle", "either", "D, P, R"},
    {"idle", "collecting", "N, S"},
    {"idle", "answering", "V"},
    {"either", "collecting", "OUT DATA, C4"},
    {"either", "answering", "INP DATA"},
    {"either", "idle", "another command"},
    {"collecting", "idle", "the last byte, or another command"},
    {"answering", "idle", "the last byte, C4, or another command"},
};
inline constexpr MachineInfo machines[] = {
    {"host", "the handshake; a reset leads to ready", host_states, host_transitions},
    {"firmware", "a reset leads to running", firmware_states, firmware_transitions},
    {"move", "command to the motor; a reset leads to standing", move_states, move_transitions},
    {"collector", "arguments and answers; a reset leads to idle", collector_states, collector_transitions},
};
static_assert(declared<machines_flaw(machines)>());

inline constexpr PinDirection in = PinDirection::input, out = PinDirection::output;
inline constexpr PinInfo pins[] = {
    {"o1", in, false, "encoder track A, or down pulses"},
    {"o2", in, false, "encoder track B, or up pulses"},
    {"zero", in, false, "zero pulse of the encoder"},
    {"ref", in, false, "reference; active without current"},
    {"ems", in, false, "emergency stop; active without current; contact 3P: 10 at 0 V, 23 at 5 V"},
    {"esr", in, false, "end stop right; active without current; contact 3P: 12 at 0 V, 25 at 5 V"},
    {"esl", in, false, "end stop left; active without current; contact 3P: 11 at 0 V, 24 at 5 V"},
    {"vout", out, false, "analog output after the relay, in V"},
    {"sign", out, false, "direction: 1 is +"},
    {"fout", out, false, "speed as a frequency, 400 kHz / (16384 - rate)"},
    {"relay", out, false, "1: the analog output is connected, 0: shorted"},
    {"rst", out, false, "pulse of 10 us at C3"},
    {"int", out, false, "interrupt: 1 while one is asked for"},
    {"vdirect", out, false, "analog output before the relay, on which EMS does not act; in V"},
    {"csb", out, false, "1 while the host addresses the card; also drives the LED"},
};
static_assert(declared<pins_flaw(pins)>());

inline constexpr CardMap card = {
    "databoard4002",
    "Intelligent positioning card for one axis: byte commands, slope table, analog and frequency output",
    registers,
    commands,
    machines,
    pins};

}  // namespace map

/// The whole map, for documents, inspectors and traces.
inline const CardMap& card_map() {
    return map::card;
}

}  // namespace motionrack::databoard4002
