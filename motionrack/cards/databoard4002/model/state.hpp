// The complete state of the card; trivially copyable, so a snapshot is one assignment.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/databoard4002/map.hpp>
#include <motionrack/cards/databoard4002/slope_table.hpp>
#include <motionrack/sim/blocks/pulse_train.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <type_traits>

namespace motionrack::databoard4002 {

inline constexpr Duration tick = Duration{25'000};  ///< one period of the 400 kHz clock
inline constexpr Duration watchdog_time = whole_seconds(1);
inline constexpr Duration reset_pulse = microseconds(10);

/// An access that the firmware has not processed yet.
enum class Work : std::uint8_t { none, in_data, out_data, command, enables };

// ---- states of the map's machines, in its order

enum class HostState : std::uint8_t { ready, busy };
enum class FirmwareState : std::uint8_t { running, hung };
/// Two bits of PositionerState: a move is on, lock is on.
enum class MoveState : std::uint8_t { standing, moving, locked, going_back };
/// Meaning of the next access to DATA.
enum class Collecting : std::uint8_t { idle, either, collecting, answering };

struct CollectorState {
    Collecting collecting = Collecting::idle;
    std::uint8_t code = 0;         ///< the command whose arguments or answer are open
    std::uint8_t answer_left = 0;  ///< bytes that still have to enter the latch
    std::uint8_t reserved0 = 0;
    std::int32_t collected = 0;  ///< argument bytes received
    std::uint32_t argument = 0;
    std::uint32_t answer = 0;  ///< remaining part of the answer
    std::int32_t reserved1 = 0;
};

struct HostPortsState {
    std::uint8_t ready = 1;
    Work access = Work::none;
    std::uint8_t access_value = 0;
    std::uint8_t latch = 0;  ///< value that INP DATA returns
    CollectorState collector;
    Instant access_due = never;
};

struct TargetMove {
    std::int64_t target = 0;  ///< -8,388,608 .. 8,388,607
    std::int64_t start = 0;   ///< start of the move by the counter
    std::int32_t direction = 1;
    std::uint8_t on = 0;
    std::uint8_t sloped = 0;
    std::uint16_t reserved = 0;
    SlopeTable table;
};

struct PositionerState {
    std::int64_t target = 0, number = 0, window = 0, requested = 0;
    std::int32_t rate = 0;
    std::uint8_t relative = 0, sloped = 0, lock = 0, went = 0;  ///< went: a G was executed
    SlopeTable table;
    TargetMove move;
};

struct EventState {
    std::uint8_t event = event::WATCH_OUT, latched = 0, pending = 0, enables = 0;
    std::uint8_t interrupts = 0, armed = 0, armed_condition = 0,
                 stops = 0;  ///< stops: STAT bits of ESL, ESR, EMS at the last pass
};

/// The part of the state that a reset clears.
struct Firmware {
    HostPortsState ports;
    PositionerState positioner;
    EventState events;
    // outputs of the last pass
    std::int32_t out_rate = 0;
    std::int32_t reserved2 = 0;
    std::int64_t turn = 0;  ///< index of the counter's interval of 2^24 counts
};

/// The input line O1 or O2 while the card counts it as a wire.
struct OutputLine {
    std::uint8_t taken = 0;     ///< the counted level
    std::uint8_t raw = 0;       ///< the level of the wire
    std::uint16_t changes = 0;  ///< changes since the line was last counted
    std::uint32_t reserved = 0;
    Instant free_at{};  ///< the line is evaluated again from here on
};

struct CounterState {
    sim::ClosedFormCounter closed;  ///< count of a connected motion
    std::int64_t count = 0;         ///< count of the wires, or while frozen
    std::int64_t frozen_from = 0;   ///< count of the motion when it exceeded the rate limit
    std::uint32_t frozen = 0;
    std::uint32_t cut = 0;  ///< the motion is disconnected; the wires are counted instead
    std::array<OutputLine, 2> lines{};
};

struct State {
    Firmware firmware;
    CounterState counter;
    sim::PulseTrainState train;
    Instant pass_at = never;      ///< the next pass that can have an effect
    Instant watchdog_at = never;  ///< the firmware hangs until then
    Instant reset_pulse_end = never;
    Instant fout_at = never;  ///< the next edge of the followed wire fout
    std::uint8_t broken = 0;  ///< STAT bits of inputs whose wire is broken
    FirmwareState hung = FirmwareState::running;
    std::uint8_t fout_wanted = 0;
    std::uint8_t begun = 0;
    std::uint32_t reserved = 0;
};

static_assert(sizeof(HostPortsState) == 32 && offsetof(Firmware, positioner) == 32 &&
                  offsetof(Firmware, events) == 576 && offsetof(Firmware, turn) == 592 && sizeof(Firmware) == 600,
              "another layout would change the state's hash");
static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");

}  // namespace motionrack::databoard4002
