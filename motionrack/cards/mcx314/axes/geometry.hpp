// How millimetres become pulses of one card: which channel each axis has, and integer pieces of lines and arcs.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/axes/segment.hpp>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/planned_move.hpp>
#include <optional>

namespace motionrack::mcx314 {

/// R of the second axis over that of the first, less one, where the speed along the path of two axes is kept.
inline constexpr double both_axes_extra = 0.41421356237309503;

/// As doubles.
inline constexpr double max_units = static_cast<double>(rules::max_units),
                        speed_carry = static_cast<double>(rules::speed_carry);

/// The nearest whole pulse, or count, to a place.
inline std::int64_t nearest_pulse(double place, double pulses_per_unit) {
    return static_cast<std::int64_t>(std::floor(place * pulses_per_unit + 0.5));
}

/// Which card channel moves which axis of the machine, and how far one pulse is.
struct AxisMap {
    std::array<int, control::axis_count> channel = {-1, -1, -1, -1, -1, -1};  ///< 0..3, -1: not on this card
    control::MachineLimits limits = {};
    double arc_tolerance_mm = 0.002;  ///< how far chords may leave an arc that the chip cannot draw itself

    /// The nearest whole pulse to a position, per channel.
    Pulses4 pulses(const control::Point& position) const;
};

/// Basic pulses of the chip for one mm (degree) along `tangent` of a path, of which the axes in `path` move: the long
/// axis gives them, with constant vector speed a pulse of two axes counts 1.414. `auxiliary`: a fourth moving axis that
/// is not interpolated, -1: none.
struct Drawing {
    bool constant_vector = false;
    int auxiliary = -1;         ///< channel
    std::uint8_t channels = 0;  ///< that move, a bit each
};
/// `axes`: those that may move, a bit each; 0: those that do.
Drawing drawing_of(const AxisMap& map, const control::Geometry& path, std::uint8_t axes = 0);
double basic_pulses_along(const AxisMap& map, const Drawing& drawing, const control::Point& tangent);

/// Radians between an arc's tangent at its ends and the first or last of the chords that it is drawn with, at most; 0:
/// not with chords.
double turn_of_first_chord(const AxisMap& map, const control::Geometry& path);

/// An arc of less than a turn, wanted from the chip: absolute pulses of two axes with the same length of a pulse.
struct ArcRequest {
    std::array<std::int64_t, 2> start = {};
    std::array<std::int64_t, 2> end = {};
    std::array<double, 2> centre = {};  ///< the true one, not whole
    double radius = 0;                  ///< the true one, pulses
    double length = 0;                  ///< along the arc, pulses
    bool clockwise = false;
};

/// An arc as the chip can draw it, relative to its start.
struct ChipArc {
    std::array<std::int32_t, 2> centre = {};
    std::array<std::int32_t, 2> finish = {};  ///< what to write
    std::array<std::int32_t, 2> end = {};     ///< where the chip really ends
    std::int64_t basic_pulses = 0;
    double deviation_pulses =
        0;  ///< greatest distance of its circle from the true one, without the chip's own half pulse
};

/// Of the whole centres near the true one the one whose arc ends exactly at `end` with the least deviation; if none
/// does, the one with the least deviation. Nothing if none of them gives an arc of about that length (an arc of a few
/// pulses).
std::optional<ChipArc> fit_arc(const ArcRequest& wanted);

}  // namespace motionrack::mcx314
