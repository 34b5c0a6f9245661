// Closed forms of a divided clock.
#include <algorithm>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/pulse_train.hpp>

namespace motionrack::sim {

std::int64_t PulseTrain::pulses(Instant t) const {
    if (!running()) return 0;
    const Duration after_first = t - state_.origin - clock_ * state_.first;
    return after_first < Duration{0} ? 0 : 1 + after_first / (clock_ * state_.then);
}

Instant PulseTrain::pulse_instant(std::int64_t n) const {
    return state_.origin + clock_ * (state_.first + (n - 1) * state_.then);
}

/// Moves the origin to the last pulse.
void PulseTrain::bring_to(Instant now) {
    const std::int64_t n = pulses(now);
    if (n == 0) return;
    state_.falls = fall(n);
    state_.count += n * state_.direction;
    state_.origin = pulse_instant(n);
    state_.first = state_.then;
}

void PulseTrain::notify_rate(double before, Instant now) {
    const double after = rate(now);
    if (after != before) listeners_.notify_rate(before, after, now);
}

void PulseTrain::run(std::int64_t divisor, int direction, Instant now) {
    MOTIONRACK_ASSERT(divisor > 0);
    if (running() && direction == state_.direction && divisor == state_.then) return;
    hand_over(now);
    const double before = rate(now);
    bring_to(now);
    if (!running() || direction != state_.direction) {
        state_.origin = now;
        state_.first = divisor;
        state_.falls = std::min(state_.falls, now + half(divisor));
    }
    state_.direction = direction;
    state_.then = divisor;
    notify_rate(before, now);
}

void PulseTrain::stop(Instant now) {
    if (!running()) return;
    hand_over(now);
    const double before = rate(now);
    bring_to(now);
    state_.first = state_.then = 0;
    notify_rate(before, now);
}

// ---- PositionFunction

std::int64_t PulseTrain::count(Instant t) const {
    return state_.count + pulses(t) * state_.direction;
}

double PulseTrain::rate(Instant) const {
    if (!running()) return 0;
    return static_cast<double>(state_.direction) * 1e10 / static_cast<double>((clock_ * state_.then).count());
}

void PulseTrain::watch(int slot, std::int64_t below, std::int64_t above) {
    state_.watches[static_cast<std::size_t>(slot)] = {below, above};
    if (owner_) owner_->train_watched();
}

int PulseTrain::add_listener(PositionListener& listener) {
    return listeners_.add(listener);
}

Instant PulseTrain::next(Instant now) const {
    const Range quiet = Listeners::unwatched_range(state_.watches);
    if (quiet.left(count(now))) return now;
    const bool up = state_.direction > 0;
    if (!running() || (up ? quiet.above == unwatched_above : quiet.below == unwatched_below)) return never;
    const std::int64_t n = up ? quiet.above - state_.count : state_.count - quiet.below;
    return n < 1'000'000'000 ? pulse_instant(n) : never;
}

void PulseTrain::act(Instant now) {
    listeners_.notify_crossed(state_.watches, count(now), now);
}

// ---- the line and its edges

Instant PulseTrain::fall(std::int64_t n) const {
    return n == 0 ? state_.falls : pulse_instant(n) + half(state_.then);
}

int PulseTrain::level(Instant now) const {
    return now < fall(pulses(now));
}

Instant PulseTrain::next_edge(Instant now) const {
    const std::int64_t n = pulses(now);
    const Instant falls = fall(n);
    if (now < falls) return falls;
    return running() ? pulse_instant(n + 1) : never;
}

void PulseTrain::set_edge_listener(EdgeListener* listener) {
    if (owner_) state_.handed = owner_->train_now();
    edges_ = listener;
}

void PulseTrain::deliver_edges() {
    if (owner_) hand_over(owner_->train_now());
}

void PulseTrain::hand_over(Instant now) {
    const Instant from = state_.handed;
    state_.handed = now;
    if (!edges_ || !running()) return;
    const std::int64_t last = pulses(now);
    std::int64_t n = from < state_.origin ? 0 : pulses(from);
    while (n < last) {
        batch_.origin = pulse_instant(n + 1);
        // Edge i of the batch is i periods after the first edge. The first period may differ, so it is a batch of its
        // own.
        const std::int64_t max_edges = n == 0 && state_.first != state_.then ? 1 : std::int64_t{EdgeBatch::capacity};
        batch_.tick = clock_ * state_.then;
        batch_.step = state_.direction;
        batch_.first_count = state_.count + (n + 1) * state_.direction;
        batch_.size = static_cast<std::uint32_t>(std::min(last - n, max_edges));
        for (std::uint32_t i = 0; i < batch_.size; ++i) batch_.at[i] = i;
        n += batch_.size;
        edges_->edges(batch_);
    }
}

}  // namespace motionrack::sim
