// Remaining path of a queue of moves after the axes were stopped on it.
#include <limits>
#include <motionrack/control/move_queue.hpp>

namespace motionrack::control {

namespace {

/// Largest distance in pulses between a position and the straight line on which it lies.
constexpr double beside_pulses = 1.5;

/// Returns true if the path reverses by more than a right angle at the junction.
bool turns_back(const Geometry& before, const Geometry& after, const PulsesPerUnit& pulses) {
    double cosine = 0;
    for (std::size_t i = 0; i < pulses.size(); ++i)
        cosine += before.tangent_out[i] * after.tangent_in[i] * pulses[i] * pulses[i];
    return cosine < 0;
}

}  // namespace

/// Returns the index of the submitted move on which a position lies, of the first `moves`.
std::size_t MoveQueue::nearest_move(const Point& position, const PulsesPerUnit& pulses, std::int64_t moves) const {
    std::size_t nearest = 0;
    double min_distance = std::numeric_limits<double>::infinity();
    Geometry path;  // the nearest path
    for (std::size_t i = 0; i < submitted_ && moves > 0; ++i) {
        if (!entries_[i].is_move()) continue;
        --moves;
        const Geometry here = geometry_of(entries_[i].step.move, entries_[i].start);
        const double off = nearest_point(here, position, pulses).distance;
        // A return stroke is as near as the outward one, of which nothing may be skipped.
        if (off >= (turns_back(path, here, pulses) ? min_distance - beside_pulses : min_distance)) continue;
        min_distance = off;
        nearest = i;
        path = here;
    }
    return nearest;
}

void MoveQueue::keep_rest(const Point& position, std::int64_t moves, double seconds) {
    while (!entries_.empty() && !entries_.front().is_move()) pop();
    if (submitted_ > 0 && entries_.front().step.move.kind == MoveKind::dwell) {
        // Its place does not tell a dwell from the moves beside it.
        entries_.front().step.move.seconds -= seconds;
        if (entries_.front().step.move.seconds > 0) {
            entries_.front().start = position;
            planned_ = submitted_ = 0;
            return;
        }
        --moves;
        pop();
        while (submitted_ > 0 && !entries_.front().is_move()) pop();
    }
    PulsesPerUnit pulses;
    for (std::size_t i = 0; i < pulses.size(); ++i) pulses[i] = settings_.limits[i].pulses_per_unit;
    for (std::size_t nearest = nearest_move(position, pulses, moves); nearest > 0; --nearest) pop();
    if (!entries_.empty() && submitted_ > 0) {
        QueueEntry& entry = entries_.front();
        entry.step.move = remaining_move(entry.step.move, geometry_of(entry.step.move, entry.start), position, pulses);
        entry.start = position;
        if (entry.step.move.kind != MoveKind::dwell &&
            geometry_of(entry.step.move, position).shape == PathShape::nothing)
            pop();
    }
    planned_ = submitted_ = 0;
}

}  // namespace motionrack::control
