// Conversion of millimetres to pulses of one card: the channel of each axis, and integer lines and arcs.
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

/// R of the second axis divided by R of the first, minus one, which gives two axes a constant vector speed.
inline constexpr double both_axes_extra = 0.41421356237309503;

/// Limits of rules:: as doubles.
inline constexpr double max_units = static_cast<double>(rules::max_units),
                        speed_carry = static_cast<double>(rules::speed_carry);

/// Returns the whole pulse or count nearest to a position.
inline std::int64_t nearest_pulse(double place, double pulses_per_unit) {
    return static_cast<std::int64_t>(std::floor(place * pulses_per_unit + 0.5));
}

/// Channel of each machine axis, and its pulse size.
struct AxisMap {
    std::array<int, control::axis_count> channel = {-1, -1, -1, -1, -1, -1};  ///< 0..3, -1: not on this card
    control::MachineLimits limits = {};
    double arc_tolerance_mm = 0.002;  ///< maximum deviation of chords from an arc that the chip cannot draw itself

    /// Returns the whole pulse nearest to a position, for each channel.
    Pulses4 pulses(const control::Point& position) const;
};

/// The axes that move on a path, as the chip draws them.
struct DriveMotion {
    bool constant_vector = false;
    int auxiliary = -1;         ///< channel
    std::uint8_t channels = 0;  ///< the moving channels, one bit each
};
/// Returns which axes move on `path`, and how. `axes`: the machine axes that may move, one bit each; 0: those that
/// `path` moves.
DriveMotion drawing_of(const AxisMap& map, const control::Geometry& path, std::uint8_t axes = 0);
/// Returns the basic pulses of the chip per mm (degree) along `tangent` of the path. The fastest of the interpolated
/// axes determines them; with constant vector speed, a pulse of two axes counts 1.414.
double basic_pulses_along(const AxisMap& map, const DriveMotion& drawing, const control::Point& tangent);

/// Returns the maximum angle between an arc's tangent at its ends and its first or last chord, radians; 0 if the path
/// is not drawn with chords.
double turn_of_first_chord(const AxisMap& map, const control::Geometry& path);

/// A requested arc of less than a turn: absolute pulses of two axes with equal pulse size.
struct ArcRequest {
    std::array<std::int64_t, 2> start = {};
    std::array<std::int64_t, 2> end = {};
    std::array<double, 2> centre = {};  ///< the true centre, not whole
    double radius = 0;                  ///< the true radius, pulses
    double length = 0;                  ///< along the arc, pulses
    bool clockwise = false;
};

/// An arc as the chip can draw it, relative to its start.
struct ChipArc {
    std::array<std::int32_t, 2> centre = {};
    std::array<std::int32_t, 2> finish = {};  ///< finish point to be written
    std::array<std::int32_t, 2> end = {};     ///< true end of the chip's arc
    std::int64_t basic_pulses = 0;
    double deviation_pulses =
        0;  ///< maximum distance of its circle from the true one, excluding the chip's own half pulse
};

/// Returns, of the integer centres near the true one, the centre whose arc ends exactly at `end` with the least
/// deviation; if there is none, the one with the least deviation. Empty if no centre gives an arc of about that length
/// (an arc of a few pulses).
std::optional<ChipArc> fit_arc(const ArcRequest& wanted);

}  // namespace motionrack::mcx314
