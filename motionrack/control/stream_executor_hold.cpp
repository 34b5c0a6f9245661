// Remaining path of a stream after a feed hold.
#include <limits>
#include <motionrack/control/split_move.hpp>
#include <motionrack/control/stream_executor.hpp>

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

/// Keeps the remaining path. The axes stopped on the last started move, or already on the one queued behind it.
void StreamExecutor::keep_rest_of_path() {
    const Point position = axes_->commanded_position();
    while (!entries_.empty() && !entries_.front().is_move()) pop();
    PulsesPerUnit pulses;
    for (std::size_t i = 0; i < pulses.size(); ++i) pulses[i] = settings_.gcode.limits[i].pulses_per_unit;
    // A planned move may cover several moves.
    std::int64_t known = blocks_.empty() ? 1 : blocks_.front();
    known += blocks_.size() > 1 ? blocks_[1] : 0;
    std::size_t nearest = 0;
    double min_distance = std::numeric_limits<double>::infinity();
    Geometry path;  // the nearest path
    for (std::size_t i = 0; i < handed_ && known > 0; ++i) {
        if (!entries_[i].is_move()) continue;
        --known;
        const Geometry here = geometry_of(entries_[i].step.move, entries_[i].start);
        const double off = nearest_point(here, position, pulses).distance;
        // A return stroke is as near as the outward one, of which nothing may be skipped.
        if (off >= (turns_back(path, here, pulses) ? min_distance - beside_pulses : min_distance)) continue;
        min_distance = off;
        nearest = i;
        path = here;
    }
    for (; nearest > 0; --nearest) pop();
    if (!entries_.empty() && handed_ > 0) {
        QueueEntry& entry = entries_.front();
        entry.step.move = remaining_move(entry.step.move, geometry_of(entry.step.move, entry.start), position, pulses);
        entry.start = position;
        if (entry.step.move.kind != MoveKind::dwell &&
            geometry_of(entry.step.move, position).shape == PathShape::nothing)
            pop();
    }
    planned_ = handed_ = 0;
    new_planner(position);
}

}  // namespace motionrack::control
