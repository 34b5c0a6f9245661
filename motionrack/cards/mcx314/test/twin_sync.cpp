// The twin's synchronous actions.
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

// Notes that a condition, a bit of SM6, has occurred.
void Twin::note(int a, unsigned condition) {
    if (axes_[a].as.sm6 & condition) axes_[a].as.acts = true;
}

// Executes the actions of all axes at the end of a tick or a write.
void Twin::act_together() {
    static constexpr int others[axis_count][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
    unsigned acting = 0;
    for (int a = 0; a < axis_count; ++a) {
        Extension& as = axes_[a].as;
        if (!as.acts) continue;
        as.acts = false;
        acting |= 1u << a;
        for (int i = 0; i < 3; ++i)
            if (as.sm6 >> (13 + i) & 1) acting |= 1u << others[a][i];
    }
    for (int a = 0; a < axis_count; ++a)
        if (acting >> a & 1) act_alone(a);
}

void Twin::act_alone(int a) {
    Axis& axis = axes_[a];
    const unsigned actions = axis.as.sm7;
    const std::uint32_t value = std::uint32_t{wr7_} << 16 | wr6_;
    if (actions & 0x0040) axis.as.buffer = static_cast<std::uint32_t>(axis.lp);
    if (actions & 0x0080) axis.as.buffer = static_cast<std::uint32_t>(axis.ep);
    if (actions & 0x0100) set_lp(axis, value), compare(a);
    if (actions & 0x0200) set_ep(axis, value), compare(a);
    if (actions & 0x0400) {
        axis.reg.pulses = value;
        if (axis.gen.kind == Generator::Kind::fixed) check_final(a);
    }
    if (actions & 0x0800) axis.reg.speed = wr6_;
    if (actions & 0x0010) ask_stop(1u << a, false);
    if (actions & 0x0020) ask_stop(1u << a, true);
    for (int i = 0; i < 4; ++i)
        if (actions >> i & 1) drive_command(0x20 + i, 1u << a);
    if (actions & 0x4000) ask_clear(axis);
    if (actions & 0x8000) axis.flags |= 1u << 9;
}

}  // namespace motionrack::mcx314::twin
