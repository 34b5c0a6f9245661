// External starts: immediate, or after a distance on the conveyor.
#include <algorithm>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

void Engine::take_move_starts() {
    Starts& s = state_.starts;
    const auto asked = s.asked_count;
    s.asked_count = 0;
    for (std::int64_t i = 0; i < asked; ++i) {
        const Start start = s.asked[static_cast<std::size_t>(i)];
        enqueue(static_cast<std::int32_t>(start.delay), static_cast<int>(start.encoder));
    }
    s.asked = {};
    const auto triggers = s.triggers;
    s.triggers = 0;
    for (std::int64_t i = 0; i < triggers; ++i)
        enqueue(static_cast<std::int32_t>(s.delay), static_cast<int>(s.encoder));
    while (s.waiting > 0 && due(s.queue[0], encoders_.counter(static_cast<std::size_t>(s.queue[0].encoder)).travel)) {
        const Start start = s.queue[0];
        std::copy(s.queue.begin() + 1, s.queue.end(), s.queue.begin());
        s.queue.back() = {};
        --s.waiting;
        begin_start();
        s.last[static_cast<std::size_t>(start.encoder)] = start.target;
    }
}

void Engine::enqueue(std::int32_t delay, int encoder) {
    Starts& s = state_.starts;
    if (!(state_.control_mode & control_ext_start)) return;
    if (delay == 0) return begin_start();
    if (s.waiting == start_queue) {
        flags_.raise_startstop(startstop_bit("START_LOST"));
        return report_start(StartFate::too_many);
    }
    std::int64_t from = encoders_.counter(static_cast<std::size_t>(encoder)).travel;
    if (state_.control_mode & control_equidistant) {
        const Start* const before = s.waiting > 0 ? &s.queue[static_cast<std::size_t>(s.waiting - 1)] : nullptr;
        if (before != nullptr && before->encoder == encoder)
            from = before->target;
        else if (s.has_last)
            from = s.last[static_cast<std::size_t>(encoder)];
    }
    s.queue[static_cast<std::size_t>(s.waiting++)] = {from + delay, delay, encoder};
}

void Engine::begin_start() {
    Starts& s = state_.starts;
    for (std::size_t e = 0; e < encoder_count; ++e) s.last[e] = encoders_.counter(e).travel;
    s.has_last = 1;
    if (list_.is_busy()) {
        flags_.raise(marking_bit("TRIGGER_ERROR"), state_.tick);
        flags_.raise_startstop(startstop_bit("START_LOST"));
        return report_start(StartFate::busy);
    }
    encoders_.take_start();
    list_.begin(s.position, startstop_bit("EXTERNAL_START"));
    report_start(StartFate::begun);
}

void Engine::report_start(StartFate fate) {
    if (connections_.listener != nullptr) connections_.listener->started(state_.tick, fate);
}

/// Ticks from the present one to that of the first waiting start, at most `limit`.
std::int64_t Engine::ticks_to_start(std::int64_t limit) {
    const Start& start = state_.starts.queue[0];
    const BeltCounter& e = encoders_.counter(static_cast<std::size_t>(start.encoder));
    if (e.simulated) {
        if (start.delay < 0) return limit;
        return std::clamp<std::int64_t>((start.target - e.travel + simulated_counts - 1) / simulated_counts, 1, limit);
    }
    if (connections_.inputs == nullptr) return limit;
    if (!not_due_.holds(start, state_.tick, e.travel)) {
        encoders_.load_counts(static_cast<std::size_t>(start.encoder), block);
        not_due_.update(start, state_.tick, e.travel, buffers_->counts[start.encoder]);
    }
    return std::min(limit, not_due_.until() - state_.tick);
}

}  // namespace motionrack::rtc5
