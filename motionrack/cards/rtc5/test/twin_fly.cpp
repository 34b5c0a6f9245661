// The twin of the RTC5: waits, and processing on the fly.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/test/twin.hpp>

namespace motionrack::rtc5::twin {

bool Twin::condition(const Command& c) {
    const int n = static_cast<int>(c.op) - static_cast<int>(Op::if_fly_x_overflow);
    const int lower[3] = {4, 6, 24};
    std::uint32_t bits = 0;
    if (c.p[0] <= 0) bits |= 1u << lower[n % 3];
    if (c.p[0] >= 0) bits |= 2u << lower[n % 3];
    const bool set = marking & bits;
    marking &= ~bits;
    return n < 3 ? set : !set;
}

bool Twin::reached(std::int64_t value, std::int64_t mode, std::int32_t before, std::int32_t present) const {
    if (mode != 0) return mode > 0 ? present >= value : present <= value;
    const auto minus = [](std::int64_t a, std::int64_t b) { return static_cast<std::int32_t>(a - b); };
    if (value > 0) return minus(present, before) > 0 && (minus(before, value) < 0) != (minus(present, value) < 0);
    return minus(present, before) < 0 && (minus(value, before) < 0) != (minus(value, present) < 0);
}

bool Twin::wait_over() const {
    const Command& c = doing.command;
    const double* const v = c.p.data();
    if (c.op == Op::wait_for_encoder_in_range) {
        const double x = encoders[0].count(), y = encoders[1].count();
        return x >= v[0] && x <= v[1] && y >= v[2] && y <= v[3];
    }
    if (c.op == Op::wait_for_mcbsp)
        return reached(whole(v[1]), whole(v[2]), axis(word_before, v[0] != 0), axis(word, v[0] != 0));
    const Counter& e = encoders[whole(v[1])];
    return reached(whole(v[0]), c.op == Op::wait_for_encoder ? 0 : whole(v[2]), e.before, e.count());
}

void Twin::leave() {
    const Xy g = global.of(p), q = corrected(g, false);
    if (fly.kind != Kind::off) p = {clip24(p.x + (q.x - g.x)), clip24(p.y + (q.y - g.y))};
    fly = paused = {};
    parked = false;
}

/// Zeroes encoders. Returns true if, with a tracking error, an empty tick comes first.
bool Twin::zero(std::vector<int> which) {
    if (again) {
        again = false;
        return false;
    }
    bool empty = false;
    for (const int e : which) {
        if (control & 512)
            encoders[e].reset_at_start = true;
        else
            encoders[e].zero = encoders[e].travel;
        empty = empty || tracking[e] != 0;
    }
    if (!empty) return false;
    again = true;
    next = current;
    hold(1);
    return true;
}

void Twin::fly_command(const Command& c) {
    const double* const v = c.p.data();
    const auto be = [&](Kind kind) {
        if (fly.kind != kind) fly = {};
        fly.kind = kind;
    };
    const auto turns = [&](Kind kind) {
        fly = {};
        if (std::abs(v[0]) >= 100) fly.kind = kind, fly.resolution = v[0];
    };
    const auto both = [&](Kind kind) { be(kind), fly.x = v[0] != 0, fly.y = v[1] != 0, fly.sx = v[0], fly.sy = v[1]; };
    switch (c.op) {
        case Op::set_fly_x:
            if (zero({0})) return;
            be(Kind::encoder), fly.x = v[0] != 0, fly.sx = v[0];
            break;
        case Op::set_fly_y:
            if (zero({1})) return;
            be(Kind::encoder), fly.y = v[0] != 0, fly.sy = v[0];
            break;
        case Op::set_fly_z:
            if (zero({static_cast<int>(v[1])})) return;
            be(Kind::encoder), fly.z = v[0] != 0, fly.sz = v[0], fly.ez = static_cast<int>(v[1]);
            break;
        case Op::set_fly_rot:
            if (zero({0})) return;
            turns(Kind::turn);
            break;
        case Op::set_fly_2d:
            if (zero({0, 1})) return;
            both(Kind::two_d);
            break;
        case Op::activate_fly_xy:
            both(Kind::encoder);
            break;
        case Op::activate_fly_2d:
            if (table_2d != nullptr)
                both(Kind::two_d);
            else
                set_flag(9);
            break;
        case Op::set_fly_x_pos:
        case Op::set_fly_y_pos:
        case Op::set_fly_rot_pos:
            to_zero = true, in_mode = 0, multi = false;
            online[0] = online[1] = online[2] = online_matrix = false;
            if (c.op == Op::set_fly_x_pos) be(Kind::mcbsp), fly.x = v[0] != 0, fly.sx = v[0];
            if (c.op == Op::set_fly_y_pos) be(Kind::mcbsp), fly.y = v[0] != 0, fly.sy = v[0];
            if (c.op == Op::set_fly_rot_pos) turns(Kind::mcbsp_turn);
            break;
        case Op::fly_return:
        case Op::fly_return_z:
            leave();
            if (c.op == Op::fly_return_z) z = v[2];
            return jump({v[0], v[1]});
        case Op::park_position: {
            const Correction was = fly;
            park_from = p;
            if (v[0] == 0 && fly.kind != Kind::off) leave(), paused = was, parked = true;
            return jump({v[1], v[2]});
        }
        case Op::park_return:
            if (parked) {
                fly = paused;
                parked = false;
                const Xy g = global.of(p), q = corrected(g, true);
                p = {clip24(p.x + (q.x - g.x)), clip24(p.y + (q.y - g.y))};
            }
            return jump(v[0] == 0 ? park_from : Xy{v[1], v[2]});
        default:
            return;
    }
    const bool turn = fly.kind == Kind::turn || fly.kind == Kind::mcbsp_turn;
    if (!turn && !fly.x && !fly.y && !fly.z) fly = {};
    hold(1);
}

}  // namespace motionrack::rtc5::twin
