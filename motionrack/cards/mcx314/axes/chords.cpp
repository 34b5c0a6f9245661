// Chords: moves that the chip cannot draw (helices, moves with a fourth axis) as many short lines, each with its speed.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/mcx314/axes/segmenter.hpp>

namespace motionrack::mcx314 {

namespace {

// Share of the path acceleration for moves with a fourth axis.
constexpr double auxiliary_share = 0.3;
// Share of an axis' velocity step used from chord to chord of an arc, if the chords have that many pulses.
constexpr double junction_share = 0.7, shortest_chord = 16, max_angle = 0.5;

double squared(double x) {
    return x * x;
}

/// The middle of a chord is r (1 - cos(angle / 2)) inside the arc: angle = sqrt(8 tolerance / r).
double tolerated_angle(const AxisMap& map, double radius) {
    return std::min(max_angle, std::sqrt(8 * map.arc_tolerance_mm / radius));
}

double shortest_angle(const AxisMap& map, const control::Geometry& arc) {
    const double scale = std::max(map.limits[arc.first].pulses_per_unit, map.limits[arc.second].pulses_per_unit);
    return std::min(max_angle, shortest_chord / scale / arc.radius);
}

/// Number of lines for a move; each takes at least `min_seconds`.
double chords_of(const AxisMap& map, const control::Geometry& path, double cruise, double min_seconds) {
    if (path.shape == control::PathShape::arc) {
        // From chord to chord the axis velocities change by speed * angle.
        const double jump = junction_share * std::min(map.limits[path.first].max_velocity_step,
                                                      map.limits[path.second].max_velocity_step);
        const double angle = std::min(tolerated_angle(map, path.radius), jump / cruise);
        const double min_angle = std::min(min_seconds * cruise / path.radius, max_angle);
        return std::ceil(std::fabs(path.sweep) / std::max({angle, shortest_angle(map, path), min_angle}));
    }
    const double seconds = path.length / cruise, count = std::clamp(std::ceil(seconds / 0.008), 8.0, 20'000.0);
    return min_seconds > 0 ? std::min(count, std::max(1.0, std::floor(seconds / min_seconds))) : count;
}

}  // namespace

double turn_of_first_chord(const AxisMap& map, const control::Geometry& path) {
    if (path.shape != control::PathShape::arc || drawing_of(map, path).constant_vector) return 0;
    return std::max(tolerated_angle(map, path.radius), shortest_angle(map, path)) / 2;
}

void Segmenter::emit_chords(const PendingMove& work, const MoveSpeeds& speeds) {
    const bool arc = work.path.shape == control::PathShape::arc;
    const double count = chords_of(map_, work.path, work.move.cruise_velocity, min_seconds_);
    const double half = arc ? std::fabs(work.path.sweep) / count / 2 : 0;
    const double deviation = arc ? work.path.radius * (1 - sin_cos(half).cos) : 0;
    if (work.auxiliary >= 0)
        note_split(work,
                   "four axes move together: the chip interpolates three, the fourth axis follows with its own speed "
                   "generator",
                   deviation);
    else
        note_split(work, "the chip has no helix: the arc is approximated by short lines of three axes", deviation);
    const double step = work.path.length / count;
    // An auxiliary receives one speed per segment, so the speeds of the segments change more slowly than its limit.
    const double top_speed = work.move.cruise_velocity,
                 accel = work.auxiliary >= 0 ? auxiliary_share * work.move.accel : work.move.accel;
    // The forward pass applies the limits, the backward pass the chip's deceleration. The basic pulses per mm differ
    // from chord to chord, so the passes use the chip's own pulses and speed units.
    struct Chord {
        double to = 0;
        Pulses4 at = {};
        double v = 0;
        std::int32_t acceleration = 1;
    };
    std::vector<Chord> chords(static_cast<std::size_t>(count));
    double units_before = work.units_in;
    for (std::size_t i = 0; i < chords.size(); ++i) {
        Chord& chord = chords[i];
        const bool last = i + 1 == chords.size();
        chord.to = last ? work.path.length : static_cast<double>(i + 1) * step;
        chord.at = pulses_at(work, chord.to);
        const double units =
            arc ? units_along(work, control::tangent_at(work.path, chord.to - step / 2)) : work.units_in;
        const double next =
            arc && !last ? units_along(work, control::tangent_at(work.path, chord.to + step / 2)) : units;
        const double raised =
            work.auxiliary >= 0 ? std::sqrt(squared(work.move.entry_velocity) + 2 * accel * chord.to) : top_speed;
        chord.v = speed_units(std::min(units, next), std::min(top_speed, raised));
        chord.acceleration = acceleration_units(std::max(units, units_before), work.move.accel);
        units_before = units;
    }
    chords.back().v = std::min<double>(chords.back().v, speeds.exit);
    for (std::size_t i = chords.size() - 1; i > 0; --i) {
        const Chord& after = chords[i];
        const Pulses4 delta = delta_between(work, chords[i - 1].at, after.at);
        const std::int64_t pulses = basic_pulses(delta);
        const double share = work.auxiliary >= 0 ? auxiliary_share : 1;
        // V units squared; less the steps of whole units and the register accesses before the new speed takes effect.
        const double slope = rules::rate_unit * after.acceleration * share,
                     spent = latency_seconds_ + speed_carry / after.acceleration / rules::clock_hz * 2;
        const double free = std::max(0.0, (static_cast<double>(pulses) - 2) / pulses_per_v_ - spent * chords[i - 1].v);
        // It begins with the speed of the previous chord.
        const double max = max_on(delta, work.constant_vector).speed;
        chords[i - 1].v = std::min({chords[i - 1].v, max, std::floor(std::sqrt(squared(after.v) + 2 * slope * free))});
    }
    for (const Chord& chord : chords)
        emit_line(work, chord.at, std::max(static_cast<std::int32_t>(chord.v), std::min(speeds.exit, speeds.top)),
                  chord.acceleration);
    add_rest(work, speeds);
}

/// Assigns the remaining pulses of the auxiliary after the last pulse of the others to their last segment.
void Segmenter::add_rest(const PendingMove& work, const MoveSpeeds& speeds) {
    if (at_ == work.to) return;
    const auto c = static_cast<std::size_t>(std::max(0, work.auxiliary));
    if (work.auxiliary >= 0 && chain_open_ && !ready_.empty() && ready_.back().auxiliary_channel == work.auxiliary) {
        ready_.back().auxiliary_pulses += static_cast<std::int32_t>(work.to[c] - at_[c]);
        at_[c] = work.to[c];
        return;
    }
    PendingMove alone = work;
    alone.auxiliary = -1;
    emit_line(alone, work.to, speeds.exit, speeds.acceleration);
}

}  // namespace motionrack::mcx314
