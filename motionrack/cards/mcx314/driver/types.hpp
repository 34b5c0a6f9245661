// Arguments and results of the function library: axis masks, interpolation data, kinds of stops and signals.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/cards/mcx314/map.hpp>
#include <string>

namespace motionrack::mcx314 {

/// Axis masks: X 1, Y 2, Z 4, U 8, and their sums. Functions for one axis take its channel, 0 X .. 3 U.
inline constexpr unsigned axis_x = 1, axis_y = 2, axis_z = 4, axis_u = 8, xyzu = 0xF;

/// Returns the names of the axes in a mask, for example "XY" for 3.
std::string axes_text(unsigned axes);

/// An interpolation command's end, in pulses relative to its start.
struct Finish {
    int axis = 0;  ///< channel 0..3
    std::int32_t pulses = 0;
    std::int32_t centre = 0;  ///< arcs only
};

/// The channels of an axis mask, X before Y before Z before U, for a loop: for (const int i : channels_of(axes)).
struct ChannelList {
    std::array<int, 4> channel = {};
    int count = 0;
    const int* begin() const { return channel.data(); }
    const int* end() const { return channel.data() + count; }
};
constexpr ChannelList channels_of(unsigned axes) {
    ChannelList out;
    for (int i = 0; i < 4; ++i)
        if (axes >> i & 1) out.channel[static_cast<std::size_t>(out.count++)] = i;
    return out;
}

/// Returns the pulses or counts between two readings of a 32-bit counter, which may have wrapped.
constexpr std::int64_t pulse_delta(std::int32_t from, std::int32_t to) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(to) - static_cast<std::uint32_t>(from));
}

using FourAxes = std::array<std::int64_t, 4>;

/// A line. Finish points are relative to the present position, for the axes in the mask; all 0: those set by SetFP().
/// The source names the structure without listing it.
struct LINEDATA {
    std::int64_t SV = 0;  ///< initial speed, 1 .. 8,000; not used by Line.._C
    std::int64_t V = 0;   ///< drive speed of the longest axis, 1 .. 8,000
    std::int64_t A = 0;   ///< acceleration, 1 .. 8,000; not used by Line.._C
    std::int64_t D = 0;   ///< deceleration, 1 .. 8,000; 0: as A
    std::int64_t K = 0;   ///< 1 .. 65,535, Line.._S only
    FourAxes P = {};      ///< finish point of X, Y, Z, U, -8,388,608 .. 8,388,607
};

/// An arc of the two axes in the mask; the first of them (X before Y before Z before U) points right, the second up.
struct CIRCLEDATA {
    std::int64_t SV = 0;  ///< initial speed, 1 .. 8,000; not used by Circle.._C
    std::int64_t V = 0;   ///< speed of the axis that steps regularly, 1 .. 8,000
    std::int64_t A = 0;   ///< acceleration, 1 .. 8,000; not used by Circle.._C
    std::int64_t D = 0;   ///< deceleration, 1 .. 8,000; 0: as A
    FourAxes P = {};      ///< finish point relative to the start; 0, 0: a full circle
    FourAxes C = {};      ///< centre relative to the start; 0, 0: centre and finish are those of SetCP() and SetFP()
};

/// A bit-pattern drive: its speeds.
struct BPDATA {
    std::int64_t SV = 0;        ///< initial speed; not used without A
    std::int64_t V = 0;         ///< drive speed, 1 .. 8,000: steps of the pattern per second, times the multiple
    std::int64_t A = 0;         ///< acceleration and deceleration, 1 .. 8,000; 0: constant speed V
    std::int64_t DecPoint = 0;  ///< step of the pattern at which it decelerates; used with A
};

/// Sixteen steps of a pattern, the lowest bit first: a 1 in `plus` steps the axis in + direction, in `minus` in -
/// direction; a 1 in both ends the drive at this step.
struct BPWORD {
    std::array<std::uint16_t, 3> plus = {};
    std::array<std::uint16_t, 3> minus = {};
};

/// The speeds of a continuous interpolation (a chain).
struct CONTDATA {
    std::int64_t SV = 0;  ///< initial and final speed; not used without A
    std::int64_t V = 0;   ///< drive speed, 1 .. 8,000, at most 2,000,000 pulses/s
    std::int64_t A = 0;   ///< acceleration, 1 .. 8,000; 0: constant speed V from the first pulse to the last
    std::int64_t D = 0;   ///< deceleration at the end; 0: as A
};

/// Result of a chain of segments: their number and the speed at the end.
struct ContOutcome {
    std::int64_t segments = 0;
    std::int64_t end_speed =
        0;  ///< planned speed at the last pulse, V units; above SV if the last segment was too short
};

enum class StopKind : std::uint8_t {
    slow,  ///< decelerating to SV; at once if the axis drives at SV or slower
    quick  ///< at once
};

/// Use of a stop input: not used, or stops the axis at this level.
enum class StopInput : std::uint8_t { off, at_low, at_high };

/// Drive that the inputs nEXPP and nEXPM start.
enum class ExternalDrive : std::uint8_t { off, continuous, fixed };

/// Source of the steps of an interpolation.
enum class StepBy : std::uint8_t { generator, command, wire };

/// Causes of interrupts of an axis, as in RR3.
namespace cause {
inline constexpr std::uint16_t pulse = field("RR3", "PULSE").mask;
inline constexpr std::uint16_t at_or_above_minus = field("RR3", "PGECM").mask;
inline constexpr std::uint16_t below_minus = field("RR3", "PLCM").mask;
inline constexpr std::uint16_t below_plus = field("RR3", "PLCP").mask;
inline constexpr std::uint16_t at_or_above_plus = field("RR3", "PGECP").mask;
inline constexpr std::uint16_t constant_end = field("RR3", "CEND").mask;
inline constexpr std::uint16_t constant_start = field("RR3", "CSTA").mask;
inline constexpr std::uint16_t drive_end = field("RR3", "DEND").mask;
inline constexpr std::uint16_t all = 0x00FF;
}  // namespace cause

}  // namespace motionrack::mcx314
