// Encoder counts and McBSP words: in a tick, in blocks, and over intervals.
#include <cmath>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

void Engine::sample_inputs() {
    encoders_.sample();
    state_.mcbsp.previous = state_.mcbsp.word;
    take_words();
    store_word();
}

void Engine::receive(std::uint32_t word) {
    McBsp& m = state_.mcbsp;
    if (m.pending_count == static_cast<std::int64_t>(m.pending.size())) {
        for (std::size_t i = 1; i < m.pending.size(); ++i) m.pending[i - 1] = m.pending[i];
        --m.pending_count;
    }
    m.pending[static_cast<std::size_t>(m.pending_count++)] = word;
}

void Engine::take_words() {
    McBsp& m = state_.mcbsp;
    std::uint32_t word = 0;
    if (connections_.inputs != nullptr && connections_.inputs->words(state_.tick, {&word, 1})) {
        take_word(word);
    } else {
        for (std::size_t i = 0; i < static_cast<std::size_t>(m.pending_count); ++i) take_word(m.pending[i]);
    }
    m.pending_count = 0;
    m.pending = {};
}

void Engine::take_word(std::uint32_t word) {
    McBsp& m = state_.mcbsp;
    m.word = word, m.received = 1;
    if (!m.multi) return;
    m.typed[word & 7] = static_cast<std::int32_t>(word) >> 3;
    m.put(m.round, static_cast<std::int32_t>(word));
    m.round = (m.round + 1) & 3;
}

std::int32_t Engine::axis_value(std::uint32_t word, bool y) const {
    const Fly& f = state_.fly;
    const bool both = f.kind == FlyKind::mcbsp && f.x && f.y;
    if (!both) return static_cast<std::int32_t>(word);
    return static_cast<std::int16_t>(y ? word >> 16 : word & 0xFFFF);
}

/// Memory locations of this tick.
void Engine::store_word() {
    McBsp& m = state_.mcbsp;
    const auto word = static_cast<std::uint32_t>(m.word);
    if (m.multi || !m.received) return;
    if (m.online()) return m.put(m.online_rot && word >> 31 ? 2 : 1, static_cast<std::int32_t>(word));
    if (m.to_zero) m.put(0, static_cast<std::int32_t>(word));
    if (m.in_mode == 1 || m.in_mode == 2) m.put(m.in_mode, static_cast<std::int32_t>(word));
    if (m.in_mode != 3) return;
    m.put(1, static_cast<std::int16_t>(word & 0xFFFF));
    m.put(2, static_cast<std::int16_t>(word >> 16));
    m.put(3, static_cast<std::int32_t>(word));
}

bool Engine::load_words(std::size_t n) {
    return connections_.inputs != nullptr && connections_.inputs->words(state_.tick, {buffers_->words.data(), n});
}

Point Engine::mcbsp_now() const {
    const McBsp& m = state_.mcbsp;
    if (state_.fly.kind == FlyKind::multi) return {static_cast<double>(m.typed[0]), static_cast<double>(m.typed[1])};
    const auto word = static_cast<std::uint32_t>(m.word);
    return {static_cast<double>(axis_value(word, false)), static_cast<double>(axis_value(word, true))};
}

/// McBSP values of x and y in n ticks from now on.
void Engine::mcbsp_values(std::size_t n) {
    const Point now = mcbsp_now();
    const bool many = n > 1 && load_words(n), multi = state_.fly.kind == FlyKind::multi;
    double *const x = buffers_->effective[0].data(), *const y = buffers_->effective[1].data();
    kernels::hold(x, y, n, now);
    if (!many) return;
    Point p = now;
    for (std::size_t i = 1; i < n; ++i) {
        const std::uint32_t word = buffers_->words[i];
        if (!multi) {
            x[i] = axis_value(word, false), y[i] = axis_value(word, true);
            continue;
        }
        if ((word & 7) == 0) p.x = static_cast<std::int32_t>(word) >> 3;
        if ((word & 7) == 1) p.y = static_cast<std::int32_t>(word) >> 3;
        x[i] = p.x, y[i] = p.y;
    }
}

/// True if a wait for an encoder or McBSP value ends in a tick with `present`, after a tick with `before`.
bool Engine::met(std::int64_t before, std::int64_t present) const {
    const std::int64_t value = state_.activity.value[0], mode = state_.activity.value[2];
    if (mode > 0) return present >= value;
    if (mode < 0) return present <= value;
    const std::int32_t change = wrapped(present - before);
    if (value > 0) return change > 0 && (wrapped(before - value) < 0) != (wrapped(present - value) < 0);
    return change < 0 && (wrapped(value - before) < 0) != (wrapped(value - present) < 0);
}

/// The same in tick i of the block, whose counts or words are loaded.
bool Engine::met_at(std::size_t i) const {
    const Activity& a = state_.activity;
    if (i == 0) return met_now();
    if (a.kind == ActivityKind::wait_encoder) {
        const auto& counts = buffers_->counts[a.value[1]];
        return met(counts[i - 1], counts[i]);
    }
    if (a.kind == ActivityKind::wait_range) {
        const std::int32_t x = buffers_->counts[0][i], y = buffers_->counts[1][i];
        return x >= a.value[0] && x <= a.value[1] && y >= a.value[2] && y <= a.value[3];
    }
    const bool y = a.value[1] != 0;
    return met(axis_value(buffers_->words[i - 1], y), axis_value(buffers_->words[i], y));
}

bool Engine::met_now() const {
    const Activity& a = state_.activity;
    if (a.kind == ActivityKind::wait_encoder) {
        const BeltCounter& e = encoders_.counter(static_cast<std::size_t>(a.value[1]));
        return met(e.previous, e.count());
    }
    if (a.kind == ActivityKind::wait_range) {
        const std::int32_t x = encoder(0), y = encoder(1);
        return x >= a.value[0] && x <= a.value[1] && y >= a.value[2] && y <= a.value[3];
    }
    const bool y = a.value[1] != 0;
    return met(axis_value(static_cast<std::uint32_t>(state_.mcbsp.previous), y),
               axis_value(static_cast<std::uint32_t>(state_.mcbsp.word), y));
}

/// Number of ticks of the wait among the next `limit`, including the one that ends it.
std::int64_t Engine::wait_ticks(std::int64_t limit, bool& over) {
    const auto n = static_cast<std::size_t>(limit);
    if (state_.activity.kind == ActivityKind::wait_mcbsp) {
        if (!load_words(n)) std::fill_n(buffers_->words.begin(), n, static_cast<std::uint32_t>(state_.mcbsp.word));
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

/// The same without evaluating each tick, if the counts are constant or simulated; -1: each tick must be evaluated.
std::int64_t Engine::simple_wait(bool& over) const {
    constexpr std::int64_t endless = std::int64_t{1} << 60, half = std::int64_t{1} << 31;
    const Activity& a = state_.activity;
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

void Engine::advance_words(std::int64_t n) {
    if (n == 1) return;
    McBsp& m = state_.mcbsp;
    std::uint32_t last[2] = {static_cast<std::uint32_t>(m.word), static_cast<std::uint32_t>(m.word)};
    if (connections_.inputs != nullptr && m.multi) {
        const bool come = load_words(static_cast<std::size_t>(n));
        for (std::size_t i = 1; come && i + 1 < static_cast<std::size_t>(n); ++i) take_word(buffers_->words[i]);
    }
    const bool come = connections_.inputs != nullptr && connections_.inputs->words(state_.tick + n - 2, last);
    m.previous = last[0];
    if (m.online_rot && come) {
        // Both locations keep the last word of their kind, so each tick is evaluated.
        for (std::int64_t i = 1; i < n; ++i) {
            std::uint32_t word = 0;
            connections_.inputs->words(state_.tick + i, {&word, 1});
            m.word = word;
            store_word();
        }
    }
    if (come) take_word(last[1]);
    store_word();
}

}  // namespace motionrack::rtc5
