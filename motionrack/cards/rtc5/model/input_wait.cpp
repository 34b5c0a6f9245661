// Evaluates the conditions of waits, in a tick and in blocks.
#include <algorithm>
#include <motionrack/cards/rtc5/model/input_wait.hpp>

namespace motionrack::rtc5 {

/// Returns true if a wait ends in a tick with the encoder or McBSP value `present` after a tick with `before`.
bool InputWait::met(std::int64_t before, std::int64_t present) const {
    const std::int64_t value = activity_.value[0], mode = activity_.value[2];
    if (mode > 0) return present >= value;
    if (mode < 0) return present <= value;
    const std::int32_t change = wrapped(present - before);
    if (value > 0) return change > 0 && (wrapped(before - value) < 0) != (wrapped(present - value) < 0);
    return change < 0 && (wrapped(value - before) < 0) != (wrapped(value - present) < 0);
}

/// Returns true if the wait ends in tick `i` of the block, whose counts or words are loaded.
bool InputWait::met_at(std::size_t i) const {
    const Activity& a = activity_;
    if (i == 0) return met_now();
    if (a.kind == ActivityKind::wait_encoder) {
        const auto& counts = buffers_.counts[a.value[1]];
        return met(counts[i - 1], counts[i]);
    }
    if (a.kind == ActivityKind::wait_range) {
        const std::int32_t x = buffers_.counts[0][i], y = buffers_.counts[1][i];
        return x >= a.value[0] && x <= a.value[1] && y >= a.value[2] && y <= a.value[3];
    }
    const bool y = a.value[1] != 0;
    return met(mcbsp_.axis_value(buffers_.words[i - 1], y), mcbsp_.axis_value(buffers_.words[i], y));
}

bool InputWait::met_now() const {
    const Activity& a = activity_;
    if (a.kind == ActivityKind::wait_encoder) {
        const BeltCounter& e = encoders_.counter(static_cast<std::size_t>(a.value[1]));
        return met(e.previous, e.count());
    }
    if (a.kind == ActivityKind::wait_range) {
        const std::int32_t x = encoders_.count(0), y = encoders_.count(1);
        return x >= a.value[0] && x <= a.value[1] && y >= a.value[2] && y <= a.value[3];
    }
    const bool y = a.value[1] != 0;
    return met(mcbsp_.axis_value(mcbsp_.previous(), y), mcbsp_.axis_value(mcbsp_.word(), y));
}

std::int64_t InputWait::ticks(std::int64_t limit, bool& over) {
    const auto n = static_cast<std::size_t>(limit);
    if (activity_.kind == ActivityKind::wait_mcbsp) {
        if (!mcbsp_.load_words(n)) std::fill_n(buffers_.words.begin(), n, mcbsp_.word());
    } else {
        for (std::size_t e = 0; e < encoder_count; ++e) encoders_.load_counts(e, n);
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (!met_at(i)) continue;
        over = true;
        return static_cast<std::int64_t>(i) + 1;
    }
    return limit;
}

std::int64_t InputWait::steady_ticks(bool& over) const {
    constexpr std::int64_t endless = std::int64_t{1} << 60, half = std::int64_t{1} << 31;
    const Activity& a = activity_;
    over = met_now();
    if (over) return 1;
    if (a.kind == ActivityKind::wait_mcbsp) return endless;
    const bool one = a.kind == ActivityKind::wait_encoder;
    if (!one) return encoders_.counter(0).simulated || encoders_.counter(1).simulated ? -1 : endless;
    const BeltCounter& e = encoders_.counter(static_cast<std::size_t>(a.value[1]));
    if (!e.simulated) return endless;
    const std::int64_t value = a.value[0], mode = a.value[2], count = e.count();
    const auto ticks_for = [](std::int64_t counts) { return (counts + simulated_counts - 1) / simulated_counts; };
    if (mode == 0 && value <= 0) return endless;
    over = true;
    if (mode == 0) {
        const std::int64_t past = wrapped(count - value);
        return 1 + ticks_for(past < 0 ? -past : half - past);
    }
    const std::int64_t ticks = ticks_for(mode > 0 ? value - count : half - count),
                       then = wrapped(count + ticks * simulated_counts);
    return met(then, then) ? 1 + ticks : -1;
}

}  // namespace motionrack::rtc5
