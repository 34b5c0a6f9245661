// The twin of the RTC5: transforms, McBSP settings, subroutines, wobbel, recording.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/test/twin.hpp>

namespace motionrack::rtc5::twin {

template <class F>
void Twin::transforms(int head, int at_once, F f) {
    Matrix* const all[3] = {&heads[0], &heads[1], &global};
    for (int i = 0; i < 3; ++i) {
        if (i == 2 ? head != 4 : head == 4 || !(head >> i & 1)) continue;
        Matrix changed = later[i] ? *later[i] : *all[i];
        f(changed);
        later[i].reset();
        if (at_once == 2)
            later[i] = changed;
        else
            *all[i] = changed;
    }
}
void Twin::set_matrix(int head, int at_once, const double m[4]) {
    transforms(head, at_once, [&](Matrix& t) { std::copy_n(m, 4, t.m); });
}
void Twin::set_offset(int head, int at_once, Xy offset) {
    transforms(head, at_once, [&](Matrix& t) { t.offset = offset; });
}
void Twin::set_angle(int head, int at_once, double degrees) {
    transforms(head, at_once, [&](Matrix& t) { t.angle = degrees; });
}
void Twin::set_scale(int head, int at_once, double scale) {
    transforms(head, at_once, [&](Matrix& t) { t.scale = scale; });
}
void Twin::transform_command(const Command& c) {
    const double* v = c.p.data();
    if (c.op == Op::set_matrix_list)
        transforms(c.head, static_cast<int>(v[3]) & 3,
                   [&](Matrix& t) { t.m[static_cast<int>(v[0]) * 2 + static_cast<int>(v[1])] = v[2]; });
    if (c.op == Op::set_offset_list) set_offset(c.head, static_cast<int>(v[2]) & 3, {v[0], v[1]});
    if (c.op == Op::set_angle_list) set_angle(c.head, static_cast<int>(v[1]) & 3, v[0]);
    if (c.op == Op::set_scale_list) set_scale(c.head, static_cast<int>(v[1]) & 3, v[0]);
}

void Twin::set_mcbsp_in(int mode, double scale) {
    multi = online[0] = online[1] = online[2] = online_matrix = false;
    in_mode = mode;
    to_zero = to_zero || mode != 0;
    fly = {};
    if (mode == 0 || scale == 0) return;
    fly.kind = Kind::mcbsp;
    fly.x = mode & 1, fly.y = mode & 2;
    fly.sx = fly.sy = scale;
}

void Twin::set_multi() {
    multi = true;
    online[0] = online[1] = online[2] = online_matrix = false;
    in_mode = round = 0;
    for (auto& t : typed) t = 0;
    for (auto& l : locations) l = 0;
    fly = {};
    fly.kind = Kind::multi;
    fly.x = fly.y = true;
    fly.sx = fly.sy = 1;
}

void Twin::set_online(double x, double y, double rot) {
    online[0] = x != 0, online[1] = y != 0, online[2] = std::abs(rot) >= 100;
    online_scale[0] = x, online_scale[1] = y, online_scale[2] = rot;
    online_matrix = false;
    if (!online[0] && !online[1] && !online[2]) return;
    in_mode = 0;
    multi = false;
    if (fly.kind == Kind::mcbsp || fly.kind == Kind::mcbsp_turn || fly.kind == Kind::multi) fly = {};
}

void Twin::set_one_online(int which, double value) {
    double all[3] = {};
    for (int i = 0; i < 3; ++i)
        if (online[i] && !online_matrix) all[i] = online_scale[i];
    all[which] = value;
    set_online(all[0], all[1], all[2]);
}

void Twin::set_online_matrix() {
    set_online(1, 0, 0);
    online_matrix = true;
}

void Twin::apply_online(int head, int at_once) {
    const auto bits = [](std::int64_t v, int n) {  // the n low bits, signed
        const std::int64_t range = std::int64_t{1} << n, low = ((v % range) + range) % range;
        return static_cast<double>(low >= range / 2 ? low - range : low);
    };
    const std::int64_t w = locations[1].value_or(0), rot = static_cast<std::uint32_t>(locations[2].value_or(0));
    if (online_matrix) {
        const std::int64_t cell = w & 3;
        transforms(head, at_once, [&](Matrix& t) { t.m[cell] = bits((w - cell) / 4, 30) / 16777216; });
        return;
    }
    const int half = online[2] ? 15 : 16, full = online[2] ? 31 : 32;
    const bool two = online[0] && online[1];
    const double x = bits(w, two ? half : full), y = two ? bits(w >> half, half) : x;
    const double turns = online[2] ? static_cast<double>(rot % (std::int64_t{1} << 31)) / online_scale[2] : 0;
    transforms(head, at_once, [&](Matrix& t) {
        if (online[0]) t.offset.x = x * online_scale[0];
        if (online[1]) t.offset.y = y * online_scale[1];
        if (online[2]) t.angle = std::fmod(turns, 1.0) * 360;
    });
}

void Twin::call(std::int64_t position) {
    if (position < 0 || position == current || returns.size() == 63) return hold(1);
    calls = called_at == now ? calls + 1 : 1;
    called_at = now;
    if (calls > 64) {
        next = current;
        return hold(1);
    }
    returns.push_back(next);
    next = position;
}

void Twin::wobbel() {
    wobbel_offset = {};
    if (paused_list || !marking_line || wobbel_turns == 0 || (across == 0 && along == 0)) return;
    Xy d = doing.direction;
    if (doing.what == Doing::arc) {
        const Xy r{p.x - doing.to.x, p.y - doing.to.y};
        d = doing.step.x < 0 ? Xy{r.y, -r.x} : Xy{-r.y, r.x};
    }
    if (doing.what == Doing::line || doing.what == Doing::arc) {
        const double length = std::sqrt(d.x * d.x + d.y * d.y);
        wobbel_direction = length > 0 ? Xy{d.x / length, d.y / length} : Xy{1, 0};
    }
    const double t = static_cast<double>(++wobbel_step) * wobbel_turns;
    const SinCos angle = sin_cos(2 * pi * (t - std::floor(t)));
    const double l = along * angle.cos, a = across * angle.sin;
    wobbel_offset = {l * wobbel_direction.x - a * wobbel_direction.y, l * wobbel_direction.y + a * wobbel_direction.x};
}

void Twin::set_trigger(const Command& c) {
    period = static_cast<std::int64_t>(c.p[0]);
    if (period == 0) return;
    first_record = now;
    rows.clear();
    recorded_signals = {static_cast<int>(c.p[1]), static_cast<int>(c.p[2])};
    if (c.op == Op::set_trigger4) {
        recorded_signals.push_back(static_cast<int>(c.p[3]));
        recorded_signals.push_back(c.head);
    }
}

/// Records the signals of a tick. `q`: position after the fly correction.
void Twin::record(const Sample& out, Xy q) {
    const auto rounded = [](double v) {
        return static_cast<std::int32_t>(std::nearbyint(std::clamp(v, -2147483648.0, 2147483647.0)));
    };
    const double q_z = fly.kind == Kind::multi ? z + typed[2] : fly.z ? z + fly.sz * ahead(fly.ez) : z;
    const std::int32_t plain[4] = {out.x, out.y, out.x_b, out.y_b};
    std::vector<std::int32_t> row;
    for (const int signal : recorded_signals) {
        std::int32_t v = 0;
        const bool y = signal % 2 == 0;  // of 7, 8
        if (signal == 0) v = laser;
        if (signal == 1 || signal == 2) v = plain[signal - 1];
        if (signal == 4 || signal == 5) v = plain[signal - 2];
        if (signal == 7 || signal == 8) v = rounded(y ? q.y : q.x);
        if (signal == 9 || signal == 12 || signal == 15) v = rounded(std::clamp(q_z, -32768.0, 32767.0));
        if (signal >= 16 && signal <= 19) v = laser ? plain[signal - 16] : -524288;
        if (signal >= 20 && signal <= 23) v = plain[signal - 20];
        const int head = signal == 13 || signal == 14 || signal == 28 || signal == 29 ? 1 : 0;
        if ((signal == 10 || signal == 11 || signal == 13 || signal == 14) && (head == 0 || second_head)) {
            const Xy r = through_table(head, heads[head].of(q));
            v = rounded(std::clamp(std::nearbyint(signal == 10 || signal == 13 ? r.x : r.y), -524288.0, 524287.0));
        }
        if ((signal == 25 || signal == 26 || signal == 28 || signal == 29) && (head == 0 || second_head)) {
            const Xy r = heads[head].of(q);
            v = rounded(signal == 25 || signal == 28 ? r.x : r.y);
        }
        if (signal == 35) v = static_cast<std::int32_t>(io);
        if (signal == 43 || signal == 44) v = encoders[signal - 43].count();
        if (signal == 45) v = rounded(mark_speed);
        row.push_back(v);
    }
    rows.push_back(row);
}

}  // namespace motionrack::rtc5::twin
