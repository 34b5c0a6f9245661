// The MCX314As part of the twin: its commands, the filters of the inputs, counters in rings, its decelerations, the
// deviation counter clear pulse.
#include <algorithm>
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

bool Twin::extended_command(int code, unsigned axes) {
    if (code == 0x14) {
        const std::uint32_t value = axes_[selected()].as.buffer;
        if (axes != 0) rr6_ = static_cast<std::uint16_t>(value), rr7_ = static_cast<std::uint16_t>(value >> 16);
        return true;
    }
    if (code != 0x0E && (code < 0x60 || code > 0x65)) return false;
    for (int a = 0; a < axis_count; ++a)
        if (axes >> a & 1) extended_write(code, a);
    return true;
}

void Twin::extended_write(int code, int a) {
    Axis& axis = axes_[a];
    switch (code) {
        case 0x0E:
            axis.reg.decel_jerk = wr6_;
            break;
        case 0x60: {
            const Extension before = axis.as;
            axis.as.em6 = wr6_, axis.as.em7 = wr7_;
            for (int i = 0; i < pin_count; ++i)
                if (!before.filters(static_cast<Pin>(i))) axis.as.filter[i] = {axis.pin[i], 0};
            if (a == 0 && !(before.em6 & 0x0100)) emergency_filter_ = {emgn_, 0};
            if (a == 0 && !(before.em6 & 0x0800)) step_filter_ = {expls_, 0};
            set_lp(axis, static_cast<std::uint32_t>(axis.lp));
            set_ep(axis, static_cast<std::uint32_t>(axis.ep));
            compare(a);
            break;
        }
        case 0x61:
            axis.as.hv = wr6_;
            break;
        case 0x62:
            start_home(a);
            break;
        case 0x63:
            ask_clear(axis);
            break;
        case 0x64:
            axis.as.sm6 = wr6_, axis.as.sm7 = wr7_;
            break;
        default:
            note(a, 0x0200);
            break;
    }
    if (code != 0x60 && code != 0x64) return;
    axis.as.in2_before = axis.level(Pin::in2);
    axis.as.in3_before = axis.level(Pin::in3);
}

// Executes the first part of a tick: samples the filtered inputs.
void Twin::sample() {
    emergency_filter_.sample(emgn_, axes_[0].as.delay());
    step_filter_.sample(expls_, axes_[0].as.delay());
    for (int a = 0; a < axis_count; ++a) {
        Axis& axis = axes_[a];
        Extension& as = axis.as;
        for (int i = 0; i < pin_count; ++i) as.filter[i].sample(axis.pin[i], as.delay());
        const bool in2 = axis.level(Pin::in2), in3 = axis.level(Pin::in3);
        if (in2 != as.in2_before && (as.em6 & 1) && in2 == ((axis.wr1 >> 4 & 1) != 0)) {
            axis.ep = 0;
            compare(a);
        }
        if (in3 != as.in3_before) note(a, in3 ? 0x0040 : 0x0080);
        as.in2_before = in2;
        as.in3_before = in3;
    }
}

// Returns LP or EP after a step of +1 or -1.
std::int32_t Twin::next_count(const Axis& axis, std::int32_t counter, int direction) const {
    const auto from = static_cast<std::uint32_t>(counter), end = static_cast<std::uint32_t>(axis.comp_plus);
    if (axis.as.ring() && from == (direction > 0 ? end : 0)) return static_cast<std::int32_t>(direction > 0 ? 0 : end);
    return static_cast<std::int32_t>(from + static_cast<std::uint32_t>(direction));
}

// Sets LP; in a ring it is 0 .. COMP+.
void Twin::set_lp(Axis& axis, std::uint32_t value) {
    const std::uint64_t size = std::uint64_t{static_cast<std::uint32_t>(axis.comp_plus)} + 1;
    axis.lp = static_cast<std::int32_t>(static_cast<std::uint32_t>(axis.as.ring() ? value % size : value));
}

void Twin::set_ep(Axis& axis, std::uint32_t value) {
    const std::uint64_t size = std::uint64_t{static_cast<std::uint32_t>(axis.comp_plus)} + 1;
    axis.ep = static_cast<std::int32_t>(static_cast<std::uint32_t>(axis.as.ring() ? value % size : value));
}

// ---- drives

// Returns true if the automatic deceleration uses D.
bool Twin::weighs(const Axis& axis) const {
    return extended_ && axis.gen.own_decel && !axis.gen.s_curve;
}

// Returns the estimated pulses of a deceleration.
std::int64_t Twin::final_pulses(const Axis& axis) const {
    const std::int64_t pulses = axis.gen.accel_pulses;
    if (!weighs(axis)) return pulses;
    const std::int64_t d = used_decel(axis.reg);
    return (pulses * used_accel(axis.reg) + d - 1) / d;
}

void Twin::avoid_triangle(Axis& axis) {
    Generator& gen = axis.gen;
    if (!gen.no_triangle || gen.final || gen.ramp <= 0) return;
    if (2 * (gen.accel_pulses + final_pulses(axis)) < std::int64_t{axis.reg.pulses}) return;
    gen.no_triangle = false;
    axis.as.cap = gen.speed;
}

// ---- the pin nDRIVE

void Twin::ask_clear(Axis& axis) {
    static constexpr std::int64_t widths[] = {80, 160, 800, 1'600, 8'000, 16'000, 80'000, 160'000};
    if (axis.as.em7 & 0x0800) axis.as.clear_until = now_ + widths[axis.as.em7 >> 13];
}

bool Twin::drive_output(int a) const {
    const Extension& as = axes_[a].as;
    if ((as.em7 & 0x0800) == 0) return busy(a);
    return (now_ < as.clear_until) != ((as.em7 & 0x1000) != 0);
}

}  // namespace motionrack::mcx314::twin
