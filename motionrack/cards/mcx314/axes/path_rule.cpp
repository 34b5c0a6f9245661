// What joints and short moves cost the chip.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/cards/mcx314/axes/path_rule.hpp>
#include <motionrack/cards/mcx314/axes/segmenter.hpp>

namespace motionrack::mcx314 {

/// At a joint the generator's rate goes on, but a basic pulse is another length of path on each side: the speed of
/// every axis jumps by the difference, which its start speed must allow. The first chord of an arc points a little
/// beside the arc.
double PathRule::max_junction_velocity(const control::Geometry& before, const control::Geometry& after) const {
    // An axis that is steered stands before it is interpolated, or the other way round: its registers are those of one
    // drive only.
    const int steered = drawing_of(map_, before).auxiliary;
    if (steered != drawing_of(map_, after).auxiliary) return 0;
    // And before it turns round: its drive ends, and a new one begins.
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

double PathRule::speed_ratio(const control::Geometry& before, const control::Geometry& after) const {
    return basic_pulses_along(map_, drawing_of(map_, before), before.tangent_out) /
           basic_pulses_along(map_, drawing_of(map_, after), after.tangent_in);
}

/// The speed changes at whole pulses, and the host writes it a little after the joint; of an arc that is drawn with
/// chords, at each of them. Along such an arc a basic pulse is another length of path from chord to chord, so that part
/// of the chip's acceleration goes into keeping the path's speed.
double PathRule::constant_velocity_length(const control::Geometry& path) const {
    constexpr double pulses = 2, of_chords = 0.06;
    const Drawing drawing = drawing_of(map_, path);
    const double in = basic_pulses_along(map_, drawing, path.tangent_in),
                 out = basic_pulses_along(map_, drawing, path.tangent_out);
    double spent = pulses / std::min(in, out);
    if (turn_of_first_chord(map_, path) > 0) {
        const double middle = basic_pulses_along(map_, drawing, control::tangent_at(path, path.length / 2));
        const double mean = (in * in + 4 * middle * middle + out * out) / 6, most = std::max(in * in, out * out);
        spent += path.length * (of_chords + std::max(0.0, 1 - mean / most));
    }
    return std::min(path.length, spent);
}

double PathRule::min_seconds() const {
    return Segmenter::min_seconds(host_);
}

}  // namespace motionrack::mcx314
