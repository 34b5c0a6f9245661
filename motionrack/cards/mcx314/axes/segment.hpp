// One queued interpolation (or pause) of the chip, with its drive speed.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>

namespace motionrack::mcx314 {

inline constexpr int channel_count = 4;
using Pulses4 = std::array<std::int64_t, channel_count>;

enum class SegmentKind : std::uint8_t { line, arc_cw, arc_ccw, pause };

/// Timing of a card's host.
struct HostTimes {
    Duration access{};   ///< duration of one register access
    Duration latency{};  ///< from an interrupt to the host's first access
};

/// All values in register units. `axes[0]` is AX1; finish and centre are relative to the segment's start.
struct Segment {
    SegmentKind kind = SegmentKind::line;
    std::uint8_t axis_count = 0;              ///< 2 or 3 for lines, 2 for arcs
    bool constant_vector = false;             ///< LSPD = 01: two axes stepping together take R of AX2
    bool starts_chain = false;                ///< begins from standstill
    bool ends_chain = false;                  ///< stops at its end
    bool s_curve = false;                     ///< alone in its chain, S-curve with automatic deceleration
    bool even = false;                        ///< its speed changes linearly from the previous speed to its own
    std::array<std::uint8_t, 3> axes = {};    ///< channels 0..3
    std::array<std::int32_t, 3> finish = {};  ///< pulses
    std::array<std::int32_t, 2> centre = {};  ///< pulses, arcs only
    std::array<std::int32_t, 3> moves = {};   ///< true end on the chip: an arc may end beside its finish point
    std::int32_t initial_speed = 1;           ///< SV, V units; used at the start of a chain
    std::int32_t speed = 1;                   ///< V from the segment's start on
    std::int32_t rest_speed = 1;              ///< V from which it may stop at once
    std::int32_t acceleration = 1;            ///< A, for both ramps
    std::int32_t braking = 1;                 ///< A for a requested stop: the limit of the axes
    std::int32_t jerk = 65'535;               ///< K, s_curve only
    std::int32_t offset = 0;                  ///< AO, s_curve only: extra pulses of the deceleration
    std::int32_t auxiliary_pulses = 0;        ///< pulses of the fourth axis in this segment, signed
    std::int32_t auxiliary_channel = -1;      ///< its channel, -1: none
    double auxiliary_speed = 0;               ///< pulses/s at the end; only if `even`
    std::int32_t block = 0;                   ///< number of the planned move, from 0
    std::int32_t line = 0;                    ///< line of the part program
    double seconds = 0;                       ///< pause only
};

/// Returns the length of the segment: the time integral of V (V units x s) at range `range`; 0 for a pause.
double segment_length(const Segment& segment, std::int32_t range);
/// Returns the approximate duration of the segment, s: from the velocity `from` (V units) to its own V, then constant.
double segment_seconds(const Segment& segment, double from, std::int32_t range);

}  // namespace motionrack::mcx314
