// The twin of the RTC5: inputs, starts, correction, output, laser.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/test/twin.hpp>

namespace motionrack::rtc5::twin {

void Matrix::product(double out[4]) const {
    const SinCos t = sin_cos(angle * (pi / 180));
    const double c = scale * t.cos, s = scale * t.sin;
    out[0] = c * m[0] - s * m[2], out[1] = c * m[1] - s * m[3];
    out[2] = s * m[0] + c * m[2], out[3] = s * m[1] + c * m[3];
}
bool Matrix::neutral() const {
    double q[4];
    product(q);
    return q[0] == 1 && q[1] == 0 && q[2] == 0 && q[3] == 1 && offset.x == 0 && offset.y == 0;
}
Xy Matrix::of(Xy v) const {
    if (neutral()) return v;
    double q[4];
    product(q);
    return {q[0] * v.x + q[1] * v.y + offset.x, q[2] * v.x + q[3] * v.y + offset.y};
}

Twin::Twin(std::int64_t size, std::int64_t list1, std::int64_t list2)
    : memory(static_cast<std::size_t>(size)), begins{0, list1, list1 + list2, size} {}

Sample Twin::tick() {
    inputs();
    starts();
    if (!paused_list) list();
    wobbel();
    const Xy q = corrected(global.of({p.x + wobbel_offset.x, p.y + wobbel_offset.y}), false);
    Sample out;
    if (fly.kind != Kind::off) {
        flags(q);
        out.outside =
            (q.x < -524288 ? 1u : 0) | (q.x > 524287 ? 2u : 0) | (q.y < -524288 ? 4u : 0) | (q.y > 524287 ? 8u : 0);
    }
    for (int h = 0; h < (second_head ? 2 : 1); ++h) {
        const Xy r = heads[h].of(q);
        const Xy corrected_out = through_table(h, r);
        const double v[2] = {corrected_out.x, corrected_out.y};
        std::int32_t bits[2];
        for (int i = 0; i < 2; ++i)
            bits[i] = static_cast<std::int32_t>(
                std::clamp(std::nearbyint(gain[h][i] * v[i] + gain_offset[h][i]), -524288.0, 524287.0));
        if (h == 0)
            out.x = bits[0], out.y = bits[1];
        else
            out.x_b = bits[0], out.y_b = bits[1];
    }
    out.laser = laser_of_tick();
    if (period > 0 && running && !paused_list && (now - first_record) % period == 0) record(out, q);
    ++now;
    return out;
}

/// Clips `r` to the field and corrects it by the head's table.
Xy Twin::through_table(int h, Xy r) const {
    const Xy v{std::clamp(r.x, -524288.0, 524287.0), std::clamp(r.y, -524288.0, 524287.0)};
    if (tables[h] == nullptr) return v;
    const double u = (v.x + 524288) / 4096, w = (v.y + 524288) / 4096;
    const int column = static_cast<int>(std::floor(u)), row = static_cast<int>(std::floor(w));
    const auto between = [&](const std::vector<std::int32_t>& plane) {
        const auto node = [&](int c, int r2) {
            return static_cast<double>(plane[static_cast<std::size_t>(r2 * 257 + c)] - 524288);
        };
        const double fx = u - column, fy = w - row;
        const double low = node(column, row) + (node(column + 1, row) - node(column, row)) * fx;
        const double high = node(column, row + 1) + (node(column + 1, row + 1) - node(column, row + 1)) * fx;
        return low + (high - low) * fy;
    };
    return {between(tables[h]->x), between(tables[h]->y)};
}

void Twin::inputs() {
    for (Counter& e : encoders) {
        e.before = e.count();
        e.travel +=
            e.simulated
                ? 10
                : static_cast<std::int32_t>(static_cast<std::uint32_t>(e.input) - static_cast<std::uint32_t>(e.raw));
        e.raw = e.input;
        if (!watch_speed) continue;
        const double speed = 100.0 * static_cast<std::int32_t>(static_cast<std::uint32_t>(e.count()) -
                                                               static_cast<std::uint32_t>(e.before));
        e.slow1 += (speed - e.slow1) * (1 - smooth);
        e.slow2 += (e.slow1 - e.slow2) * (1 - smooth);
    }
    word_before = word;
    for (; !words.empty(); words.pop_front(), heard = true) {
        word = words.front();
        if (!multi) continue;
        typed[word & 7] = static_cast<std::int32_t>(word) >> 3;
        locations[round] = static_cast<std::int32_t>(word);
        round = (round + 1) % 4;
    }
    const auto whole = static_cast<std::int32_t>(word);
    if (heard && (online[0] || online[1] || online[2])) {
        locations[online[2] && whole < 0 ? 2 : 1] = whole;
    } else if (heard && !multi) {
        if (to_zero) locations[0] = whole;
        if (in_mode == 1 || in_mode == 2) locations[in_mode] = whole;
        if (in_mode == 3)
            locations[1] = static_cast<std::int16_t>(word), locations[2] = static_cast<std::int16_t>(word >> 16),
            locations[3] = whole;
    }
}

void Twin::receive(std::uint32_t w) {
    words.push_back(w);
    if (words.size() > 4) words.pop_front();
}

void Twin::starts() {
    const std::vector<Pending> by_list = std::move(asked);
    asked.clear();
    for (const Pending& a : by_list) ask_start(a.delay, a.encoder);
    for (; triggers > 0; --triggers) ask_start(start_delay, start_encoder);
    while (!waiting.empty()) {
        const Pending first = waiting.front();
        const std::int64_t travel = encoders[first.encoder].travel;
        if (first.delay > 0 ? travel < first.target : travel > first.target) break;
        waiting.pop_front();
        start_now();
        last_start[first.encoder] = first.target;
    }
}

void Twin::ask_start(std::int64_t delay, int encoder) {
    if (!(control & 1)) return;
    if (delay == 0) return start_now();
    if (waiting.size() == 8) {
        startstop |= 1u << 11;
        return;
    }
    std::int64_t from = encoders[encoder].travel;
    if (control & 1024) {
        if (!waiting.empty() && waiting.back().encoder == encoder)
            from = waiting.back().target;
        else if (started_once)
            from = last_start[encoder];
    }
    waiting.push_back({from + delay, delay, encoder});
}

void Twin::start_now() {
    started_once = true;
    for (int e = 0; e < 2; ++e) last_start[e] = encoders[e].travel;
    if (running || alone) {
        set_flag(8);
        startstop |= 1u << 11;
        return;
    }
    for (Counter& e : encoders) {
        if (e.reset_at_start) e.zero = e.travel;
        e.reset_at_start = false;
    }
    running = true;
    returns.clear();
    next = current = start_position;
    startstop |= 2;
}

double Twin::ahead(int e) const {
    const Counter& c = encoders[e];
    return c.count() + static_cast<double>(static_cast<std::int32_t>(static_cast<std::uint32_t>(c.count()) -
                                                                     static_cast<std::uint32_t>(c.before))) *
                           tracking[e];
}

std::int32_t Twin::axis(std::uint32_t w, bool y) const {
    if (fly.kind != Kind::mcbsp || !fly.x || !fly.y) return static_cast<std::int32_t>(w);
    return static_cast<std::int16_t>(y ? w >> 16 : w);
}

Xy Twin::corrected(Xy g, bool backwards) const {
    double a = 0, b = 0;
    switch (fly.kind) {
        case Kind::off:
            return g;
        case Kind::encoder:
        case Kind::turn:
            a = ahead(0), b = ahead(1);
            break;
        case Kind::two_d: {
            a = ahead(0) + offset_2d.x, b = ahead(1) + offset_2d.y;
            if (table_2d == nullptr) break;
            const auto shift = table_2d->at(a, b);
            a += shift.x, b += shift.y;
            break;
        }
        case Kind::mcbsp:
        case Kind::mcbsp_turn:
            a = axis(word, false), b = axis(word, true);
            break;
        case Kind::multi:
            a = typed[0], b = typed[1];
            break;
    }
    if (fly.kind == Kind::turn || fly.kind == Kind::mcbsp_turn) {
        const SinCos t = sin_cos(2 * pi * (a / fly.resolution - std::floor(a / fly.resolution)));
        const double s = backwards ? -t.sin : t.sin, dx = g.x - centre.x, dy = g.y - centre.y;
        return {centre.x + (t.cos * dx - s * dy), centre.y + (s * dx + t.cos * dy)};
    }
    if (fly.x) g.x = backwards ? g.x - fly.sx * a : g.x + fly.sx * a;
    if (fly.y) g.y = backwards ? g.y - fly.sy * b : g.y + fly.sy * b;
    return g;
}

void Twin::set_flag(int bit) {
    if (!(marking >> bit & 1)) flag_tick[bit] = now;
    marking |= 1u << bit;
}

void Twin::flags(Xy q) {
    const auto see = [&](bool seen, int bit) {
        if (seen) set_flag(bit);
    };
    see(q.x < -524288, 0), see(q.x > 524287, 1), see(q.y < -524288, 2), see(q.y > 524287, 3);
    see(q.x < static_cast<double>(limits[0]), 4), see(q.x > static_cast<double>(limits[1]), 5);
    see(q.y < static_cast<double>(limits[2]), 6), see(q.y > static_cast<double>(limits[3]), 7);
    if (!fly.z && fly.kind != Kind::multi) return;
    const double q_z = fly.kind == Kind::multi ? z + typed[2] : z + fly.sz * ahead(fly.ez);
    see(q_z < -32768, 22), see(q_z > 32767, 23);
    see(q_z < static_cast<double>(limits[4]), 24), see(q_z > static_cast<double>(limits[5]), 25);
}

std::uint32_t Twin::take_marking_info() {
    const std::uint32_t out = marking;
    marking &= 0x30000F0;
    return out;
}

void Twin::change_laser(std::int64_t at, bool on) {
    if (on && laser_disabled) return;
    at = std::max(at, now * 20);
    while (!changes.empty() && changes.back().first >= at) changes.pop_back();
    const bool level = changes.empty() ? laser : changes.back().second;
    if (level != on && changes.size() < 16) changes.emplace_back(at, on);
}

int Twin::laser_of_tick() {
    int gate = 0;
    for (std::int64_t half = now * 20; half < now * 20 + 20; ++half) {
        for (; !changes.empty() && changes.front().first <= half; changes.pop_front()) laser = changes.front().second;
        gate += laser;
    }
    return gate;
}

void Twin::stop() {
    running = paused_list = skip = again = marking_line = alone = auto_change = loop = false;
    doing = {};
    returns.clear();
    leave();
    waiting.clear();
    asked.clear();
    triggers = 0;
    changes.clear();
    change_laser(now * 20, false);
    period = 0;
    startstop |= 4;
}

void Twin::pause() {
    if (!running || paused_list) return;
    paused_list = true;
    laser_in_pause = marking_line;
    if (marking_line) change_laser(now * 20, false);
}

void Twin::disable_laser() {
    changes.clear();
    change_laser(now * 20, false);
    laser_disabled = true;
}

void Twin::restart() {
    if (!paused_list) return;
    paused_list = false;
    if (laser_in_pause) change_laser(now * 20, true);
}

void Twin::execute(std::int64_t position) {
    if (running || alone) return;
    running = true;
    returns.clear();
    next = current = position;
    startstop |= 1;
}

void Twin::jump_alone(Xy to) {
    if (running || doing.what != Doing::nothing) return;
    jump(to);
    alone = true;
}

void Twin::jump(Xy to) {
    for (int i = 0; i < 3; ++i) {
        if (!later[i]) continue;
        (i == 2 ? global : heads[i]) = *later[i];
        later[i].reset();
    }
    line_to(to, jump_speed, 'j');
}

}  // namespace motionrack::rtc5::twin
