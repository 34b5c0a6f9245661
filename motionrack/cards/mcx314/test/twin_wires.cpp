// The twin's request inputs (nEXPP, nEXPM, EXPLSN) and its encoder inputs.
#include <algorithm>
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

namespace {
constexpr bool twin_drives_by_wire(const Axis& axis) {
    return bit(axis.wr3, 3) != bit(axis.wr3, 4);  // EXOP 1 or 2
}
}  // namespace

// Evaluates, at the end of a tick, the inputs that request a drive, then EXPLSN.
void Twin::look_at_wires() {
    for (int a = 0; a < axis_count; ++a)
        if (twin_drives_by_wire(axes_[a]))
            look_at_external(a);
        else if (extended_ && (axes_[a].wr3 & 0x18) == 0x18)
            look_at_wheel(a);
    const bool expls = axes_[0].as.em6 & 0x0800 ? step_filter_.out : expls_;
    expls_low_ = expls ? 0 : std::min(expls_low_ + 1, 3);
    if (expls_low_ == 2) ask_step(Segment::by_wire);
}

void Twin::look_at_external(int a) {
    Axis& axis = axes_[a];
    const bool continuous = bit(axis.wr3, 3);
    for (int way : {0, 1}) {
        const bool high = axis.level(way == 0 ? Pin::exp_plus : Pin::exp_minus);
        const bool rises = high && axis.low[way] > 0;
        axis.low[way] = high ? 0 : std::min(axis.low[way] + 1, 3);
        if (axis.low[way] == 2 && !driving(a) && !axis.hold) {
            start_drive(a, (continuous ? 0x22 : 0x20) + way);
            if (continuous) axis.external = way;
        }
        if (rises && axis.external == way) axis.gen.ask_decelerating = true;
    }
}

// Evaluates nEXPP and nEXPM as lines A and B of a hand wheel.
void Twin::look_at_wheel(int a) {
    Axis& axis = axes_[a];
    const bool high = axis.level(Pin::exp_plus), before = axis.as.wheel_before;
    axis.as.wheel_before = high;
    if (high != before && !axis.level(Pin::exp_minus) && !driving(a) && !axis.hold) start_drive(a, high ? 0x20 : 0x21);
}

void Twin::write_wr3(Axis& axis, std::uint16_t value) {
    const bool changed = ((axis.wr3 ^ value) & 0x18) != 0;
    axis.wr3 = value;
    if (!changed) return;
    axis.as.wheel_before = axis.level(Pin::exp_plus);
    if (!twin_drives_by_wire(axis)) axis.low = {3, 3};
    if (axis.external >= 0 && (value & 0x18) != 0x08) axis.gen.ask_decelerating = true;
}

// Counts the changes of the encoder lines.
void Twin::hear_encoders() {
    for (int a = 0; a < axis_count; ++a) {
        Axis& axis = axes_[a];
        const auto [line_a, line_b] = axis.lines;
        const bool a_changed = line_a != axis.heard[0], b_changed = line_b != axis.heard[1];
        axis.heard = axis.lines;
        int change = 0;
        if (bit(axis.wr2, 9)) {
            change = (a_changed && line_a ? 1 : 0) - (b_changed && line_b ? 1 : 0);
        } else if (a_changed != b_changed) {
            const bool up = a_changed ? line_a != line_b : line_a == line_b;  // A leads B
            const int division = axis.wr2 >> 10 & 3;
            const bool counted = division == 1 ? a_changed : division == 2 ? a_changed && !line_b : true;
            if (counted) change = up ? 1 : -1;
        }
        if (axis.as.em6 & 0x02) change = -change;
        if (change == 0) continue;
        axis.ep = next_count(axis, axis.ep, change);
        compare(a);
    }
}

// Requests a step by 3Ah or by EXPLSN; returns false if no segment waits for it.
bool Twin::ask_step(Segment::Steps by) {
    if (chain_ == 0 || step_under_way_ || (path_.segment().steps & by) == 0) return false;
    step_under_way_ = true;
    return true;
}

bool Twin::by_steps(int a) const {
    return axes_[a].gen.kind == Generator::Kind::path && path_.segment().steps != 0;
}

}  // namespace motionrack::mcx314::twin
