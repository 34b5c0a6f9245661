// Advance of ticks: in blocks with a sink, from vector to vector without.
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
    pipeline_.evaluate();
    connections_.sink = nullptr;
}

bool Engine::at_rest() const {
    const Lists& l = state_.lists;
    return l.running == 0 && state_.activity.kind == ActivityKind::none && starts_.at_rest() && state_.laser.count == 0;
}

bool Engine::run_to_rest(std::int64_t ticks, Sink* sink) {
    const std::int64_t end = state_.tick + ticks;
    connections_.sink = sink;
    until_rest_ = true;
    while (state_.tick < end && !at_rest()) piece(end, sink);
    until_rest_ = false;
    pipeline_.evaluate();
    connections_.sink = nullptr;
    return at_rest();
}

void Engine::begin_tick() {
    if (state_.sampled == state_.tick) return;
    state_.sampled = state_.tick;
    laser_.begin_tick();
    encoders_.sample();
    mcbsp_.sample();
    starts_.take();
}

/// At least a tick, at most to `end`.
void Engine::piece(std::int64_t end, Sink* sink) {
    begin_tick();
    std::int64_t limit = end - state_.tick;
    if (starts_.waiting()) limit = starts_.ticks_to_start(limit);
    limit = std::min(limit, std::max<std::int64_t>(1, recorder_.ticks_to_sample()));
    if (sink == nullptr && recorder_.ticks_to_sample() > 0 && skip(limit)) return;
    const std::size_t n = produce(static_cast<std::size_t>(std::min<std::int64_t>(limit, block)));
    laser_.run_until(state_.tick + static_cast<std::int64_t>(n));
    pipeline_.run(n, sink);
    advance(static_cast<std::int64_t>(n));
}

/// Computes the positions of the next ticks: up to `capacity`, or to a command of the pipeline.
std::size_t Engine::produce(std::size_t capacity) {
    std::size_t n = 0;
    while (n < capacity) {
        n = interpreter_.micro_vectors(n, capacity);
        if (n == capacity) break;
        if (state_.lists.paused) {
            path_.stay(n, capacity);
            return capacity;
        }
        if (!interpreter_.next_step(n)) break;
        if (n == 0 && (starts_.asked() || recorder_.samples_now())) capacity = 1;
        // The last tick is executed even without observers.
        if (state_.activity.kind == ActivityKind::none && until_rest_) capacity = n + 1;
        n = path_.fill(n, capacity);
    }
    return n;
}

/// Without a sink, advances over all ticks of the present activity at once if its flags are known without evaluating
/// each tick. Returns false if only commands were taken.
bool Engine::skip(std::int64_t limit) {
    State& s = state_;
    if (!s.lists.paused) interpreter_.next_step(0);
    if (encoders_.speed_watched() || mcbsp_.words_have_types() || recorder_.samples_now() || wobbel_.active())
        return false;
    if (starts_.asked()) limit = 1;
    Activity& a = s.activity;
    const bool still = s.lists.paused || a.kind == ActivityKind::none || a.kind == ActivityKind::hold;
    const bool moves = !s.lists.paused && (a.kind == ActivityKind::line || a.kind == ActivityKind::arc);
    if (connections_.inputs != nullptr) {
        if (fly_.on() || (!still && !moves)) return false;
        limit = std::min<std::int64_t>(limit, 1 << 20);
    }
    std::int64_t n = limit;
    bool over = false;
    if (!s.lists.paused && a.kind == ActivityKind::none && until_rest_) n = 1;
    if (moves || (a.kind == ActivityKind::hold && !s.lists.paused)) n = std::min(limit, a.steps - a.done);
    if (!still && !moves) {
        n = wait_.steady_ticks(over);
        if (n < 0) return false;
        if (n > limit) n = limit, over = false;
    }
    PlanExtent extent;
    if (fly_.on()) {
        const bool known = heads_.global().neutral && connections_.inputs == nullptr;
        const bool line = a.kind == ActivityKind::line && !s.lists.paused;
        const auto steady = known ? fly_.steady_extent(a, line, s.p, n) : std::nullopt;
        if (!steady) return false;
        extent = *steady;
    }
    laser_.run_until(s.tick + n);
    wobbel_.clear_offset();
    if (moves) s.p = a.position(a.done + n, s.p);
    if (moves || (a.kind == ActivityKind::hold && !s.lists.paused)) a.done += n;
    if (over) a.done = a.steps;
    pipeline_.skip(extent);
    advance(n);
    return true;
}

/// Advances the state by n ticks.
void Engine::advance(std::int64_t n) {
    encoders_.advance(n);
    mcbsp_.advance(n);
    state_.tick += n;
    state_.sampled = state_.tick - 1;
}

void Engine::copy_beside_state(const Engine& other) {
    heads_.copy_tables(other.heads_);
    fly_.copy_table(other.fly_);
    recorder_.copy_samples(other.recorder_);
}

}  // namespace motionrack::rtc5
