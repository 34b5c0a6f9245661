// Receives words over McBSP.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/model/mcbsp_receiver.hpp>

namespace motionrack::rtc5 {

void McBspReceiver::sample() {
    state_.previous = state_.word;
    take_words();
    store_word();
}

void McBspReceiver::receive(std::uint32_t word) {
    McBsp& m = state_;
    if (m.pending_count == static_cast<std::int64_t>(m.pending.size())) {
        for (std::size_t i = 1; i < m.pending.size(); ++i) m.pending[i - 1] = m.pending[i];
        --m.pending_count;
    }
    m.pending[static_cast<std::size_t>(m.pending_count++)] = word;
}

void McBspReceiver::take_words() {
    McBsp& m = state_;
    std::uint32_t word = 0;
    if (connections_.inputs != nullptr && connections_.inputs->words(tick_, {&word, 1})) {
        take_word(word);
    } else {
        for (std::size_t i = 0; i < static_cast<std::size_t>(m.pending_count); ++i) take_word(m.pending[i]);
    }
    m.pending_count = 0;
    m.pending = {};
}

void McBspReceiver::take_word(std::uint32_t word) {
    McBsp& m = state_;
    m.word = word, m.received = 1;
    if (!m.multi) return;
    m.typed[word & 7] = static_cast<std::int32_t>(word) >> 3;
    m.put(m.round, static_cast<std::int32_t>(word));
    m.round = (m.round + 1) & 3;
}

std::int32_t McBspReceiver::axis_value(std::uint32_t word, bool y) const {
    const Fly& f = fly_;
    const bool both = f.kind == FlyKind::mcbsp && f.x && f.y;
    if (!both) return static_cast<std::int32_t>(word);
    return static_cast<std::int16_t>(y ? word >> 16 : word & 0xFFFF);
}

/// Stores the present word in the memory locations that receive it.
void McBspReceiver::store_word() {
    McBsp& m = state_;
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

bool McBspReceiver::load_words(std::size_t n) {
    return connections_.inputs != nullptr && connections_.inputs->words(tick_, {buffers_.words.data(), n});
}

Point McBspReceiver::now() const {
    const McBsp& m = state_;
    if (fly_.kind == FlyKind::multi) return {static_cast<double>(m.typed[0]), static_cast<double>(m.typed[1])};
    const auto word = static_cast<std::uint32_t>(m.word);
    return {static_cast<double>(axis_value(word, false)), static_cast<double>(axis_value(word, true))};
}

void McBspReceiver::load_values(std::size_t n) {
    const Point now = this->now();
    const bool many = n > 1 && load_words(n), multi = fly_.kind == FlyKind::multi;
    double *const x = buffers_.effective[0].data(), *const y = buffers_.effective[1].data();
    kernels::hold(x, y, n, now);
    if (!many) return;
    Point p = now;
    for (std::size_t i = 1; i < n; ++i) {
        const std::uint32_t word = buffers_.words[i];
        if (!multi) {
            x[i] = axis_value(word, false), y[i] = axis_value(word, true);
            continue;
        }
        if ((word & 7) == 0) p.x = static_cast<std::int32_t>(word) >> 3;
        if ((word & 7) == 1) p.y = static_cast<std::int32_t>(word) >> 3;
        x[i] = p.x, y[i] = p.y;
    }
}

void McBspReceiver::advance(std::int64_t n) {
    if (n == 1) return;
    McBsp& m = state_;
    std::uint32_t last[2] = {static_cast<std::uint32_t>(m.word), static_cast<std::uint32_t>(m.word)};
    if (connections_.inputs != nullptr && m.multi) {
        const bool come = load_words(static_cast<std::size_t>(n));
        for (std::size_t i = 1; come && i + 1 < static_cast<std::size_t>(n); ++i) take_word(buffers_.words[i]);
    }
    const bool come = connections_.inputs != nullptr && connections_.inputs->words(tick_ + n - 2, last);
    m.previous = last[0];
    if (m.online_rot && come) {
        // Both memory locations keep the last word of their kind, so every tick is evaluated.
        for (std::int64_t i = 1; i < n; ++i) {
            std::uint32_t word = 0;
            connections_.inputs->words(tick_ + i, {&word, 1});
            m.word = word;
            store_word();
        }
    }
    if (come) take_word(last[1]);
    store_word();
}

Result<std::int32_t> McBspReceiver::store_now() {
    McBsp& m = state_;
    if (!m.received) return fail(ErrorKind::refused, fmt::format("get_mcbsp: {}", no_word_yet));
    m.put(0, static_cast<std::int32_t>(static_cast<std::uint32_t>(m.word)));
    return m.memory[0];
}

std::int64_t McBspReceiver::power() const {
    const McBsp& m = state_;
    if (m.power_mode == 0) return m.typed[3];
    return m.power_factor * m.typed[3] / 16384;
}

void McBspReceiver::begin_correction() {
    state_.to_zero = 1;
    state_.in_mode = state_.multi = 0;
    end_positioning();
}

void McBspReceiver::begin_axis_correction(int mode) {
    state_.multi = 0;
    state_.in_mode = mode;
    if (mode != 0) state_.to_zero = 1;
    end_positioning();
}

void McBspReceiver::begin_typed_words(std::int64_t port, std::int64_t factor, std::int64_t mode) {
    McBsp& m = state_;
    m.power_port = port, m.power_factor = factor, m.power_mode = mode;
    end_positioning();
    m.multi = 1;
    m.in_mode = 0;
    m.round = 0;
    m.typed = {};
    m.memory = {}, m.filled = 15;
}

/// Ends online positioning; it and a correction by McBSP words exclude each other.
void McBspReceiver::end_positioning() {
    McBsp& m = state_;
    m.online_x = m.online_y = m.online_rot = m.online_matrix = 0;
}

bool McBspReceiver::begin_positioning(double scale_x, double scale_y, double resolution) {
    McBsp& m = state_;
    m.online_x = scale_x != 0, m.online_y = scale_y != 0, m.online_rot = std::abs(resolution) >= min_resolution;
    m.online_scale_x = scale_x, m.online_scale_y = scale_y, m.online_resolution = resolution;
    m.online_matrix = 0;
    if (!m.online()) return false;
    m.in_mode = m.multi = 0;
    return true;
}

std::array<double, 3> McBspReceiver::positioning_scales() const {
    const McBsp& m = state_;
    if (m.online_matrix) return {};
    return {m.online_x ? m.online_scale_x : 0, m.online_y ? m.online_scale_y : 0,
            m.online_rot ? m.online_resolution : 0};
}

void McBspReceiver::apply_positioning(Transform& t) const {
    const McBsp& m = state_;
    if (m.online_matrix) {
        const std::int32_t coefficient = m.memory[1];
        t.matrix[static_cast<std::size_t>(coefficient & 3)] = static_cast<double>(coefficient >> 2) / 16777216;
        return;
    }
    // With rotation, bit 31 distinguishes the two kinds of words: 31 bits of offset or angle, or 15 bits each of x and
    // y (low, high).
    const auto word = static_cast<std::uint32_t>(m.memory[1]);
    const bool both = m.online_x && m.online_y;
    const auto sign_extended = [](std::uint32_t v, int bits) {
        return static_cast<double>(static_cast<std::int32_t>(v << (32 - bits)) >> (32 - bits));
    };
    double x = 0, y = 0;
    if (both)
        x = m.online_rot ? sign_extended(word, 15) : sign_extended(word, 16),
        y = m.online_rot ? sign_extended(word >> 15, 15) : sign_extended(word >> 16, 16);
    else
        x = y = m.online_rot ? sign_extended(word, 31) : sign_extended(word, 32);
    const double turn =
        m.online_rot
            ? std::fmod(static_cast<double>(static_cast<std::uint32_t>(m.memory[2]) & 0x7FFFFFFF) / m.online_resolution,
                        1.0) *
                  360
            : 0;
    if (m.online_x) t.offset.x = x * m.online_scale_x;
    if (m.online_y) t.offset.y = y * m.online_scale_y;
    if (m.online_rot) t.angle_deg = turn;
}

}  // namespace motionrack::rtc5
