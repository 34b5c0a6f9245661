// Queues external starts and begins their lists.
#include <algorithm>
#include <motionrack/cards/rtc5/model/external_starts.hpp>

namespace motionrack::rtc5 {

void ExternalStarts::take() {
    Starts& s = starts_;
    if (s.asked_count == 0 && s.triggers == 0 && s.waiting == 0) return;
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
        begin();
        s.last[static_cast<std::size_t>(start.encoder)] = start.target;
    }
}

void ExternalStarts::enqueue(std::int32_t delay, int encoder) {
    Starts& s = starts_;
    if (!(control_mode_ & control_ext_start)) return;
    if (delay == 0) return begin();
    if (s.waiting == start_queue) {
        flags_.raise_startstop(startstop_bit("START_LOST"));
        return report(StartFate::too_many);
    }
    std::int64_t from = encoders_.counter(static_cast<std::size_t>(encoder)).travel;
    if (control_mode_ & control_equidistant) {
        const Start* const before = s.waiting > 0 ? &s.queue[static_cast<std::size_t>(s.waiting - 1)] : nullptr;
        if (before != nullptr && before->encoder == encoder)
            from = before->target;
        else if (s.has_last)
            from = s.last[static_cast<std::size_t>(encoder)];
    }
    s.queue[static_cast<std::size_t>(s.waiting++)] = {from + delay, delay, encoder};
}

void ExternalStarts::begin() {
    Starts& s = starts_;
    for (std::size_t e = 0; e < encoder_count; ++e) s.last[e] = encoders_.counter(e).travel;
    s.has_last = 1;
    if (list_.is_busy()) {
        flags_.raise(marking_bit("TRIGGER_ERROR"), tick_);
        flags_.raise_startstop(startstop_bit("START_LOST"));
        return report(StartFate::busy);
    }
    encoders_.take_start();
    list_.begin(s.position, startstop_bit("EXTERNAL_START"));
    report(StartFate::begun);
}

void ExternalStarts::report(StartFate fate) {
    if (connections_.listener != nullptr) connections_.listener->started(tick_, fate);
}

std::int64_t ExternalStarts::ticks_to_start(std::int64_t limit) {
    const Start& start = starts_.queue[0];
    const BeltCounter& e = encoders_.counter(static_cast<std::size_t>(start.encoder));
    if (e.simulated) {
        if (start.delay < 0) return limit;
        return std::clamp<std::int64_t>((start.target - e.travel + simulated_counts - 1) / simulated_counts, 1, limit);
    }
    if (connections_.inputs == nullptr) return limit;
    if (!not_due_.holds(start, tick_, e.travel)) {
        encoders_.load_counts(static_cast<std::size_t>(start.encoder), kernels::block);
        not_due_.update(start, tick_, e.travel, buffers_.counts[start.encoder]);
    }
    return std::min(limit, not_due_.until() - tick_);
}

void ExternalStarts::ask(std::int64_t delay, std::int64_t encoder) {
    if (starts_.asked_count < start_queue)
        starts_.asked[static_cast<std::size_t>(starts_.asked_count++)] = {0, delay, encoder};
    else
        flags_.raise_startstop(startstop_bit("START_LOST"));
}

void ExternalStarts::stop() {
    starts_.waiting = starts_.triggers = starts_.asked_count = 0;
    starts_.queue = starts_.asked = {};
}

}  // namespace motionrack::rtc5
