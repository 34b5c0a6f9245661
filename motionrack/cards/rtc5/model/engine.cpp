// Advances ticks: in blocks if a sink receives samples, else from vector to vector.
#include <algorithm>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

Engine::Engine(const Settings& settings) : settings_(settings) {
    MOTIONRACK_ASSERT(check(settings).has_value());
    state_.lists.reset(settings);
}

void Engine::run_until(std::int64_t tick, Sink* sink) {
    connections_.sink = sink;
    while (state_.tick < tick) piece(tick, sink);
    parts_.pipeline.evaluate();
    connections_.sink = nullptr;
}

bool Engine::at_rest() const {
    const Lists& l = state_.lists;
    return l.running == 0 && state_.activity.kind == ActivityKind::none && parts_.starts.at_rest() &&
           state_.laser.count == 0;
}

bool Engine::run_to_rest(std::int64_t ticks, Sink* sink) {
    const std::int64_t end = state_.tick + ticks;
    connections_.sink = sink;
    until_rest_ = true;
    while (state_.tick < end && !at_rest()) piece(end, sink);
    until_rest_ = false;
    parts_.pipeline.evaluate();
    connections_.sink = nullptr;
    return at_rest();
}

void Engine::begin_tick() {
    if (state_.sampled == state_.tick) return;
    state_.sampled = state_.tick;
    parts_.laser.begin_tick();
    parts_.encoders.sample();
    parts_.mcbsp.sample();
    parts_.starts.take();
}

/// Executes at least one tick, and at most the ticks before `end`.
void Engine::piece(std::int64_t end, Sink* sink) {
    begin_tick();
    std::int64_t limit = end - state_.tick;
    if (parts_.starts.waiting()) limit = parts_.starts.ticks_to_start(limit);
    limit = std::min(limit, std::max<std::int64_t>(1, parts_.recorder.ticks_to_sample()));
    if (sink == nullptr && parts_.recorder.ticks_to_sample() > 0 && skip(limit)) return;
    const std::size_t n = produce(static_cast<std::size_t>(std::min<std::int64_t>(limit, block)));
    parts_.laser.run_until(state_.tick + static_cast<std::int64_t>(n));
    parts_.pipeline.run(n, sink);
    advance(static_cast<std::int64_t>(n));
}

/// Computes the positions of the next ticks: up to `capacity`, or up to a command of the pipeline. Returns their
/// number.
std::size_t Engine::produce(std::size_t capacity) {
    std::size_t n = 0;
    while (n < capacity) {
        n = interpreter_.micro_vectors(n, capacity);
        if (n == capacity) break;
        if (state_.lists.paused) {
            parts_.path.stay(n, capacity);
            return capacity;
        }
        if (!interpreter_.next_step(n)) break;
        if (n == 0 && (parts_.starts.asked() || parts_.recorder.samples_now())) capacity = 1;
        // The last tick is executed even without observers.
        if (state_.activity.kind == ActivityKind::none && until_rest_) capacity = n + 1;
        n = parts_.path.fill(n, capacity);
    }
    return n;
}

/// Advances over all ticks of the present activity at once, if no sink takes samples and the flags are known without
/// evaluating each tick. Returns false if it advanced no tick; list commands may have been executed then.
bool Engine::skip(std::int64_t limit) {
    State& s = state_;
    if (!s.lists.paused) interpreter_.next_step(0);
    if (parts_.encoders.speed_watched() || parts_.mcbsp.words_have_types() || parts_.recorder.samples_now() ||
        parts_.wobbel.active())
        return false;
    if (parts_.starts.asked()) limit = 1;
    Activity& a = s.activity;
    const bool still = s.lists.paused || a.kind == ActivityKind::none || a.kind == ActivityKind::hold;
    const bool moves = !s.lists.paused && (a.kind == ActivityKind::line || a.kind == ActivityKind::arc);
    if (connections_.inputs != nullptr) {
        if (parts_.fly.on() || (!still && !moves)) return false;
        limit = std::min<std::int64_t>(limit, 1 << 20);
    }
    std::int64_t n = limit;
    bool over = false;
    if (!s.lists.paused && a.kind == ActivityKind::none && until_rest_) n = 1;
    if (moves || (a.kind == ActivityKind::hold && !s.lists.paused)) n = std::min(limit, a.steps - a.done);
    if (!still && !moves) {
        n = parts_.wait.steady_ticks(over);
        if (n < 0) return false;
        if (n > limit) n = limit, over = false;
    }
    PlanExtent extent;
    if (parts_.fly.on()) {
        const bool known = parts_.heads.global().neutral && connections_.inputs == nullptr;
        const bool line = a.kind == ActivityKind::line && !s.lists.paused;
        const auto steady = known ? parts_.fly.steady_extent(a, line, s.p, n) : std::nullopt;
        if (!steady) return false;
        extent = *steady;
    }
    parts_.laser.run_until(s.tick + n);
    parts_.wobbel.clear_offset();
    if (moves) s.p = a.position(a.done + n, s.p);
    if (moves || (a.kind == ActivityKind::hold && !s.lists.paused)) a.done += n;
    if (over) a.done = a.steps;
    parts_.pipeline.skip(extent);
    advance(n);
    return true;
}

/// Advances the state by n ticks.
void Engine::advance(std::int64_t n) {
    parts_.encoders.advance(n);
    parts_.mcbsp.advance(n);
    state_.tick += n;
    state_.sampled = state_.tick - 1;
}

void Engine::copy_beside_state(const Engine& other) {
    parts_.heads.copy_tables(other.parts_.heads);
    parts_.fly.copy_table(other.parts_.fly);
    parts_.recorder.copy_samples(other.parts_.recorder);
}

}  // namespace motionrack::rtc5
