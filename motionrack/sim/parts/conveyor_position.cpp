// Instants at which the count of a conveyor leaves a range.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/conveyor_position.hpp>

namespace motionrack::parts {

namespace {

constexpr double track_ticks_per_s = 1e10;
constexpr double endless_s = static_cast<double>(never.count()) / track_ticks_per_s;

}  // namespace

ConveyorPosition::ConveyorPosition(sim::Kernel& kernel, const std::string& name, const Conveyor& track,
                                   double counts_per_unit)
    : kernel_(kernel), track_(track), per_unit_(counts_per_unit), id_(kernel.add(*this, sim::Phase::parts, name)) {
    MOTIONRACK_ASSERT(counts_per_unit != 0);
}

std::int64_t ConveyorPosition::count(Instant t) const {
    return static_cast<std::int64_t>(std::floor(track_.travel(to_seconds(t)) * per_unit_));
}

double ConveyorPosition::rate(Instant t) const {
    return track_.velocity(to_seconds(t)) * per_unit_;
}

/// The first instant at or after `from` at which the count is out of the range; at `from` it is within.
Instant ConveyorPosition::leaves(const Range& range, Instant from) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low = range.below == sim::unwatched_below ? -infinity : static_cast<double>(range.below + 1) / per_unit_;
    double high = range.above == sim::unwatched_above ? infinity : static_cast<double>(range.above) / per_unit_;
    if (per_unit_ < 0) {
        low = range.above == sim::unwatched_above ? -infinity : static_cast<double>(range.above) / per_unit_;
        high = range.below == sim::unwatched_below ? infinity : static_cast<double>(range.below + 1) / per_unit_;
    }
    const double at_s = track_.leaves(to_seconds(from), low, high);
    if (!(at_s < endless_s / 2)) return never;
    // Searches near the solution for the first tick at which the count itself is out of the range.
    const Instant first = from + Duration{1};
    Instant at = std::max(first, Instant{static_cast<std::int64_t>(at_s * track_ticks_per_s)});
    Duration step{1};
    while (!range.left(count(at)) && step.count() < 1'000'000) at += step, step *= 2;
    while (at > first && range.left(count(at - Duration{1}))) at -= Duration{1};
    return at;
}

void ConveyorPosition::schedule(Instant now) {
    const Range quiet = sim::Listeners::unwatched_range(state_.watches);
    kernel_.schedule(id_, quiet.left(count(now)) ? now : leaves(quiet, now));
}

void ConveyorPosition::on_scheduled(Instant now) {
    listeners_.notify_crossed(state_.watches, count(now), now);
    schedule(now);
}

void ConveyorPosition::changed(double velocity_before) {
    const Instant now = kernel_.now();
    listeners_.notify_rate(velocity_before * per_unit_, rate(now), now);
    schedule(now);
}

void ConveyorPosition::watch(int slot, std::int64_t below, std::int64_t above) {
    state_.watches[static_cast<std::size_t>(slot)] = {below, above};
    schedule(kernel_.now());
}

int ConveyorPosition::add_listener(sim::PositionListener& listener) {
    return listeners_.add(listener);
}

void ConveyorPosition::set_edge_listener(sim::EdgeListener* listener) {
    state_.handed = kernel_.now();
    state_.handed_count = count(state_.handed);
    edges_ = listener;
}

/// Delivers the edges since the last delivery, each computed separately.
void ConveyorPosition::hand_over(Instant now) {
    Instant at = state_.handed;
    state_.handed = now;
    if (edges_ == nullptr) return;
    std::int64_t& here = state_.handed_count;
    for (;;) {
        const Range stay{here - 1, here + 1};
        const Instant next = leaves(stay, at);
        if (next <= now && !stay.left(count(next))) {
            at = next;
            continue;
        }
        if (next > now) return row_.hand_over(*edges_);
        const int step = count(next) > here ? 1 : -1;
        here += step;
        row_.add(*edges_, next, here, step);
        at = next;
    }
}

}  // namespace motionrack::parts
