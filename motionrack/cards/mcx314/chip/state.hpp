// The complete state of the chip, trivially copyable: registers, one speed generator per axis, the interpolation with
// its queue.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/mcx314/chip/extension.hpp>
#include <motionrack/cards/mcx314/chip/fields.hpp>
#include <motionrack/cards/mcx314/ramp.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/listeners.hpp>
#include <type_traits>

namespace motionrack::mcx314 {

inline constexpr int axes_of_chip = 4;

enum class Drive : std::uint8_t { idle, fixed, continuous, path };

/// Returns the command code of a fixed or continuous drive in `direction` (+1, -1).
constexpr int drive_code(Drive drive, int direction) {
    if (drive == Drive::fixed) return direction > 0 ? cmd::FIXED_PLUS : cmd::FIXED_MINUS;
    return direction > 0 ? cmd::CONTINUOUS_PLUS : cmd::CONTINUOUS_MINUS;
}

/// Parameters captured by an interpolation command.
struct PathCommand {
    std::int32_t code = 0;  ///< cmd::LINE2 .. cmd::BP3
    std::int32_t count = 2;
    std::int32_t vector_speed = 0;  ///< WR5.LSPD
    std::uint32_t steps = 0;        ///< WR5.EXPLS, CMPLS: one basic pulse per request
    std::array<std::int32_t, 3> axis{};
    std::int32_t reserved = 0;
    std::array<std::int64_t, 3> finish{};
    std::array<std::int64_t, 2> centre{};

    static constexpr std::uint32_t by_wire = 1, by_command = 2;  ///< bits of steps

    bool line() const { return code <= static_cast<int>(cmd::LINE3); }
    bool arc() const { return code == cmd::ARC_CW || code == cmd::ARC_CCW; }
    bool pattern() const { return code >= static_cast<int>(cmd::BP2); }
    unsigned mask() const {
        unsigned bits = 0;
        for (int i = 0; i < count; ++i) bits |= 1u << axis[static_cast<std::size_t>(i)];
        return bits;
    }
    bool names_an_axis_twice() const {
        return axis[0] == axis[1] || (count == 3 && (axis[2] == axis[0] || axis[2] == axis[1]));
    }
};

/// Progress of the running interpolation segment.
struct Path {
    PathCommand command;
    rules::Arc arc;
    std::int64_t max_pulses = 0;              ///< basic pulses of the whole segment (lines)
    std::array<std::int64_t, 3> made{};       ///< steps of each axis so far (lines)
    std::array<std::int64_t, 3> range_for{};  ///< Rnow when one, two, three axes stepped
};

/// Sixteen pattern steps of three axes: registers BP1P, BP1M, BP2P, BP2M, BP3P, BP3M.
using PatternWord = std::array<std::uint16_t, 6>;

/// The bit pattern: its registers, the stack, and the running word with its next step `place`.
struct Pattern {
    static constexpr std::uint8_t depth = 3, length = 16;
    PatternWord registers{};
    std::array<PatternWord, depth> stack{};
    PatternWord running{};
    std::uint8_t stacked = 0;
    std::uint8_t place = length;  ///< `length`: no running word
    bool writable = false;        ///< 36h: the registers replace WR2..WR7
    bool interrupt = false;

    /// Returns the step of AX(i+1) at place `at` (0 .. 15) of the running word: -1, 0 or +1.
    int step(int i, int at) const { return (running[2 * i] >> at & 1) - (running[2 * i + 1] >> at & 1); }
    /// Returns true if one of the first `axes` axes has the end code at place `at` (0 .. 15) of the running word.
    bool ends(int axes, int at) const {
        unsigned both = 0;
        for (int i = 0; i < axes; ++i) both |= running[2 * i] & running[2 * i + 1];
        return (both >> at & 1u) != 0;
    }
};

/// Consecutive speed steps of a generator, combined up to a tick; nothing else happens in their ticks.
struct Walk {
    Speed law;                                    ///< speed and ramp after the steps
    std::int64_t ticks = 0;                       ///< duration of the steps
    std::int64_t phase = 0;                       ///< sum of the speed in these ticks
    std::int64_t last_phase = 0, last_speed = 0;  ///< phase and speed of the last step
};

/// Instant of a pulse: `tick`, or as a fraction of a tick tick - acc / speed.
struct PulseMoment {
    std::int64_t tick = 0, acc = 0, speed = 0;

    std::int64_t when() const { return tick - acc / speed; }
};

/// State of one speed generator and its drive.
struct Generator : Speed {
    Drive drive = Drive::idle;
    bool manual = false, own_deceleration = false, s_curve = false;
    bool final = false, final_seen = false, stopping = false, constant = false;
    bool ask_decelerating = false, ask_immediate = false;
    bool full_tick = false;  ///< the next working tick must be executed in full (inputs, limits or commands changed)
    bool special_known = false;  ///< next_special is up to date
    bool plain = false;          ///< the event at next_tick is only a step of the speed
    bool walks =
        false;  ///< like plain, with further speed steps before next_tick (State::ahead); or waits for a step request
    bool weighted = false;     ///< the automatic deceleration uses D (MCX314As)
    bool no_triangle = false;  ///< half of the pulses must be at constant speed (MCX314As)
    std::int64_t wait = 0;
    std::int64_t range = 0, range_now = 0, acc = 0;
    std::int64_t n = 0, accel_pulses = 0;
    std::int64_t next_special = 0;  ///< value of n at the next pulse that does more than step the axes
    std::int64_t next_tick = 0;     ///< the next tick that is not executed in closed form
    std::int64_t at = 0;            ///< last executed tick; may be behind State::tick while no event occurs
};

/// The last pulse on an axis' wires; the same however the time since has been divided into advances.
struct PulseMark {
    std::int64_t tick = 0;   ///< tick of the pulse
    std::int32_t speed = 0;  ///< generator speed at the pulse; 0: the pulse has ended
    std::int32_t range = 0;  ///< R in use after the pulse
    std::int32_t direction = 0;
    std::int32_t reserved = 0;

    std::int64_t width() const { return std::max<std::int64_t>(1, range / speed / 2); }
    /// Returns the tick at which the pulse ends.
    std::int64_t end() const { return tick + width(); }
    bool active(std::int64_t at) const { return speed > 0 && at < end(); }
};

struct Axis {
    std::uint32_t range = 0, pulses = 0, decel_point = 0, centre = 0;
    std::uint16_t jerk = 0, accel = 0, decel = 0, start_speed = 0, offset = 8;
    std::uint16_t speed = 0;        ///< V, or its replacement (set_drive_speed)
    std::uint16_t decel_jerk = 0;   ///< K, or L of the MCX314As
    std::uint16_t comparisons = 0;  ///< comparisons with subscribed interrupts or actions, as bits of RR3
    std::uint16_t wr1 = 0, wr2 = 0, wr3 = 0;
    std::uint16_t causes = 0, finished = 0, flags = 0, compared = 0;
    std::uint16_t levels = 0x3FF;  ///< input pins as last received, bit Pin
    std::int32_t lp = 0, comp_plus = 0, comp_minus = 0;
    std::int32_t ep = 0;             ///< EP without a connected encoder
    sim::ClosedFormCounter encoder;  ///< EP of a connected encoder
    /// Returns true if a step may change a subscribed comparison; for comparisons with EP the encoder reports it.
    bool steps_compared() const { return comparisons != 0 && !wr2::CMPSL.test(wr2); }
    std::int32_t direction = 1;
    std::int32_t held_command = 0;
    bool hold = false;
    bool pulses_wanted = false, outputs_wanted = false;  ///< xpp, xpm or nOUT4..7 have listeners
    std::uint8_t encoder_lines = 3;                      ///< xeca, xecb as last received
    std::uint8_t external = 0;  ///< input whose continuous drive lasts until it is High: 1 nEXPP, 2 nEXPM; 0: none
    std::array<std::uint8_t, 2> external_low{2, 2};  ///< ticks, up to 2, since nEXPP, nEXPM were seen High
    bool drive_wanted = false;                       ///< xdrive has listeners
    bool ring = false;                               ///< LP and EP count 0 .. COMP+ (MCX314As)
    std::array<std::uint8_t, 7> reserved{};
    std::int64_t shown = 0;  ///< `made` at the last update of the pulse wires
    PulseMark mark;
    std::int64_t count = 0;  ///< + pulses minus - pulses since the start
    std::int64_t made = 0;   ///< pulses of both directions added, since the start
    std::uint64_t reported_rate =
        0;  ///< bits of the rate (a double) that listeners last received, updated by its drift since
    sim::Listeners::Watches watch{};
    PathCommand held_path;
    Generator gen;

    /// Resets the axis; AO becomes `offset_after_reset`. The levels of the pins, the counts since the start and the
    /// listeners remain.
    void reset(std::uint16_t offset_after_reset) {
        Axis fresh;
        fresh.levels = levels;
        fresh.count = count;
        fresh.made = made;
        fresh.watch = watch;
        fresh.pulses_wanted = pulses_wanted;
        fresh.outputs_wanted = outputs_wanted;
        fresh.drive_wanted = drive_wanted;
        fresh.encoder_lines = encoder_lines;
        fresh.shown = shown;
        fresh.mark = mark;
        fresh.reported_rate = reported_rate;
        fresh.offset = offset_after_reset;
        *this = fresh;
    }
};

/// Bus registers of the whole chip, and the selected axes.
struct BusRegisters {
    std::uint16_t wr4 = 0, wr5 = 0, wr6 = 0, wr7 = 0, rr6 = 0, rr7 = 0;
    std::uint16_t selected = 1;  ///< axes, one bit each, to which WR1 .. WR3 and RR1 .. RR3 belong

    void reset() { *this = {}; }
};

/// State of single steps, which EXPLSN or command 3Ah requests.
struct StepRequests {
    std::uint8_t low = 0;      ///< ticks, up to 2, since EXPLSN was seen High
    bool high = true;          ///< EXPLSN as last received
    bool in_progress = false;  ///< a single step is in progress

    /// Ends a step in progress and forgets that EXPLSN was Low.
    void reset() {
        low = 0;
        in_progress = false;
    }
};

/// Sampling of the inputs of an MCX314As: its next tick, and the filters of the inputs of the whole chip.
struct InputSampling {
    std::int64_t next = 0;       ///< the next tick at which inputs are sampled
    ChipFilter emergency, step;  ///< filters of EMGN, EXPLSN

    /// Cancels the next sample; the filters keep the levels of their wires.
    void reset() { next = far; }
};

/// Outputs that a stop of the machine cleared, and that the host has not written low since: bits of WR3 and WR4.
struct HeldOutputs {
    std::array<std::uint32_t, axes_of_chip> wr3{};
    std::uint32_t wr4 = 0;
    std::uint32_t reported = 0;  ///< 1: the condition output_held has been reported
};

struct State {
    std::array<Axis, axes_of_chip> axis{};
    std::int64_t tick = 0;        ///< last executed tick
    std::int64_t next_event = 0;  ///< the next tick that must be executed in full
    BusRegisters bus;
    std::uint8_t wr0_high = 0;  ///< high byte of WR0 as last written on the 8-bit bus
    StepRequests steps;
    bool emergency_high = true;
    bool queued = false, decel_enabled = false, path_interrupt = false, interrupt = false;
    bool begun = false;       ///< the wires have been read since the start
    std::uint32_t chain = 0;  ///< axes, one bit each, of the running interpolation
    std::int32_t master = 0;
    std::int32_t stepped = 1;     ///< number of axes stepped in the last basic pulse, 1 .. 3
    std::uint32_t working = 0;    ///< axes whose generator is running
    std::uint32_t in_place = 0;   ///< axes whose drive has ended and that are not yet in position
    std::uint32_t following = 0;  ///< axes with listeners on output wires that are computed on demand
    std::uint32_t sampled = 0;    ///< axes whose nEXPP, nEXPM the next tick samples; bit 4: EXPLSN
    std::uint32_t crossed = 0;    ///< axes that may have left a watched range
    Path path;
    PathCommand queue;
    Pattern pattern;
    std::array<Walk, axes_of_chip> ahead{};  ///< combined speed steps of each generator from Generator::at to next_tick

    HeldOutputs held;

    // MCX314As only.
    InputSampling sampling;
    std::uint32_t homing = 0;  ///< axes with a home search in progress
    std::uint32_t acting = 0;  ///< axes whose selected condition (SM6) has occurred
    std::array<Extension, axes_of_chip> extension{};

    bool driving(int a) const { return axis[a].gen.drive != Drive::idle || ((chain | homing) >> a & 1u) != 0; }
    /// Returns true if the drive has ended while nINPOS is enabled and still inactive.
    bool waits_for_position(int a) const;
    /// Returns true while the axis drives, searches its home or waits for nINPOS.
    bool busy(int a) const { return driving(a) || waits_for_position(a); }
    /// Returns the axis whose registers the bus shows: the first selected one.
    int first_selected() const;
    /// Returns the axes, one bit each, that generator `a` steps in the present segment.
    std::uint32_t moved_by(int a) const { return axis[a].gen.drive == Drive::path ? path.command.mask() : 1u << a; }
    /// Returns true if each basic pulse of generator `a` needs a request.
    bool by_steps(int a) const { return axis[a].gen.drive == Drive::path && path.command.steps != 0; }
    /// Returns true if generator `a` waits for the request of a step.
    bool halted(int a) const { return by_steps(a) && !steps.in_progress; }
};

static_assert(std::has_unique_object_representations_v<State>, "equal chips have equal bytes: no padding");

/// Input pins of an axis: eight in the bit order of RR4 and RR5, then the limit switches.
enum class Pin : std::uint8_t { in0, in1, in2, in3, exp_plus, exp_minus, in_position, alarm, limit_plus, limit_minus };

/// Returns the last tick at or before `t`.
constexpr std::int64_t tick_of(Instant t) {
    return t.count() / rules::tick_100ps;
}

/// Calls f(axis) for every axis in `mask`, X first.
template <class F>
void for_each_axis(std::uint32_t mask, F&& f) {
    for (; mask != 0; mask &= mask - 1) f(std::countr_zero(mask));
}

/// Returns a / b for a >= 0, b > 0; faster than `/` if both are below 2^32, as most values are.
constexpr std::int64_t quick_div(std::int64_t a, std::int64_t b) {
    if ((static_cast<std::uint64_t>(a | b) >> 32) != 0) return a / b;
    return static_cast<std::int64_t>(static_cast<std::uint32_t>(a) / static_cast<std::uint32_t>(b));
}

constexpr bool bit(unsigned value, int n) {
    return (value >> n & 1u) != 0;
}
constexpr unsigned external_mode(std::uint16_t wr3) {
    return wr3::EXOP.get(wr3);
}
inline constexpr unsigned external_continuous = 1, external_fixed = 2, external_wheel = 3;
constexpr bool drives_by_wire(std::uint16_t wr3) {
    return external_mode(wr3) == external_continuous || external_mode(wr3) == external_fixed;
}
constexpr unsigned pin_mask(Pin pin) {
    return 1u << static_cast<int>(pin);
}
constexpr bool level(const Axis& axis, Pin pin) {
    return bit(axis.levels, static_cast<int>(pin));
}

// Meaning of an axis' input levels, by its mode registers.

/// Returns true if WR1 enables stop input IN0 .. IN3 (`i`); the fields are adjacent: IN0L, IN0E, IN1L, IN1E, ..
constexpr bool stop_input_enabled(const Axis& axis, int i) {
    return (axis.wr1 & wr1::IN0E.mask << 2 * i) != 0;
}
constexpr bool input_active(const Axis& axis, int i) {
    return bit(axis.levels, i) == ((axis.wr1 & wr1::IN0L.mask << 2 * i) != 0);
}
/// Returns true if the limit switch of the direction (+1, -1) is active.
constexpr bool limit_active(const Axis& axis, int direction) {
    if (direction > 0) return level(axis, Pin::limit_plus) == wr2::HLMTP.test(axis.wr2);
    return level(axis, Pin::limit_minus) == wr2::HLMTM.test(axis.wr2);
}
constexpr bool alarm_active(const Axis& axis) {
    return wr2::ALME.test(axis.wr2) && level(axis, Pin::alarm) == wr2::ALML.test(axis.wr2);
}
/// Returns true if nINPOS is active or disabled.
constexpr bool in_position(const Axis& axis) {
    return !wr2::INPE.test(axis.wr2) || level(axis, Pin::in_position) == wr2::INPL.test(axis.wr2);
}

inline bool State::waits_for_position(int a) const {
    return bit(in_place, a) && !in_position(axis[a]);
}
inline int State::first_selected() const {
    int a = 0;
    while (a < axes_of_chip - 1 && !(bus.selected >> a & 1u)) ++a;
    return a;
}

/// Requests interrupts: sets those of `causes` (bits of RR3) that WR1 enables.
constexpr void request_interrupt(Axis& axis, unsigned causes) {
    axis.flags = static_cast<std::uint16_t>(axis.flags | (axis.wr1 >> enable_shift & causes));
}

/// Sets bit `pin` (0 .. 15) of `levels` to the level.
constexpr void set_level(std::uint16_t& levels, int pin, bool high) {
    levels = static_cast<std::uint16_t>(high ? levels | 1u << pin : levels & ~(1u << pin));
}

/// Returns LP or EP (`counter`) after `steps`, signed: it wraps at 32 bits, or after COMP+ in ring mode.
constexpr std::int32_t stepped(const Axis& axis, std::int32_t counter, std::int64_t steps) {
    if (!axis.ring)
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(counter) + static_cast<std::uint32_t>(steps));
    const std::int64_t size = std::int64_t{static_cast<std::uint32_t>(axis.comp_plus)} + 1;
    const std::int64_t place = (static_cast<std::uint32_t>(counter) + steps) % size;
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(place < 0 ? place + size : place));
}

}  // namespace motionrack::mcx314
