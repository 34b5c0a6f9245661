// Constraints of junctions and short moves on the chip.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/cards/mcx314/axes/path_rule.hpp>
#include <motionrack/cards/mcx314/axes/segmenter.hpp>

namespace motionrack::mcx314 {

/// At a junction the generator's rate is continuous, but the path length of a basic pulse changes. The velocity of
/// every axis changes by the difference, which its velocity step must allow. The first chord of an arc deviates
/// slightly from its tangent.
double PathRule::max_junction_velocity(const control::Geometry& before, const control::Geometry& after) const {
    // An auxiliary axis must stop before it is interpolated, and the reverse: its registers hold one drive only.
    const int steered = drawing_of(map_, before).auxiliary;
    if (steered != drawing_of(map_, after).auxiliary) return 0;
    // It must also stop before it reverses: its drive ends, and a new one begins.
    for (std::size_t i = 0; steered >= 0 && i < map_.channel.size(); ++i)
        if (map_.channel[i] == steered && before.tangent_out[i] * after.tangent_in[i] <= 0) return 0;
    const double a = basic_pulses_along(map_, drawing_of(map_, before), before.tangent_out);
    const double b = basic_pulses_along(map_, drawing_of(map_, after), after.tangent_in);
    constexpr double reserve = 0.95;  // for whole speed units
    const double turn_before = turn_of_first_chord(map_, before), turn_after = turn_of_first_chord(map_, after);
    double speed = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < map_.channel.size(); ++i) {
        double jump = std::fabs(before.tangent_out[i] / a - after.tangent_in[i] / b) * std::min(a, b);
        if (i == before.first || i == before.second) jump += turn_before;
        if (i == after.first || i == after.second) jump += turn_after;
        if (map_.channel[i] >= 0 && jump > 1e-9)
            speed = std::min(speed, reserve * map_.limits[i].max_velocity_step / jump);
    }
    return speed;
}

double PathRule::velocity_ratio(const control::Geometry& before, const control::Geometry& after) const {
    return rate_along(before, before.tangent_out) / rate_along(after, after.tangent_in);
}

/// Returns the basic pulses per mm; on an arc that the chip draws itself the least of all directions, by which its
/// speeds are written.
double PathRule::rate_along(const control::Geometry& path, const control::Point& tangent) const {
    const DriveMotion drawing = drawing_of(map_, path);
    if (path.shape == control::PathShape::arc && drawing.constant_vector)
        return map_.limits[path.first].pulses_per_unit;
    return basic_pulses_along(map_, drawing, tangent);
}

/// The speed changes at whole pulses, and the host writes it slightly after the junction; on an arc drawn with chords,
/// at every chord. Along such an arc the path length of a basic pulse changes from chord to chord, so part of the
/// chip's acceleration maintains the path velocity.
double PathRule::constant_velocity_length(const control::Geometry& path) const {
    constexpr double pulses = 2, of_chords = 0.06;
    const DriveMotion drawing = drawing_of(map_, path);
    const double in = basic_pulses_along(map_, drawing, path.tangent_in),
                 out = basic_pulses_along(map_, drawing, path.tangent_out);
    double spent = pulses / std::min(in, out);
    if (turn_of_first_chord(map_, path) > 0) {
        const double middle = basic_pulses_along(map_, drawing, control::tangent_at(path, path.length / 2));
        const double mean = (in * in + 4 * middle * middle + out * out) / 6, max_square = std::max(in * in, out * out);
        spent += path.length * (of_chords + std::max(0.0, 1 - mean / max_square));
    }
    return std::min(path.length, spent);
}

double PathRule::min_seconds() const {
    return Segmenter::min_seconds(host_);
}

/// A move of a few pulses may have fewer of them: its ends are rounded, and an arc before it may end beside its target.
double PathRule::max_velocity(const control::Geometry& path) const {
    constexpr double lost = 1 + both_axes_extra, beside = 1;  // pulses
    const double pulses = path.length * basic_pulses_along(map_, drawing_of(map_, path), path.tangent_in);
    const double kept = std::max(1.0, pulses - lost - beside);
    const double counted = path.length * kept / pulses / Segmenter::min_counted_seconds(host_);
    return std::min(DriveConstraints::max_velocity(path), counted);
}

}  // namespace motionrack::mcx314
