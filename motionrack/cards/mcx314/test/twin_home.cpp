// The twin's automatic home search, state by state as in RULES.md.
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

namespace {
constexpr int step_1 = 3, step_2 = 8, step_2_back = 12, step_2_again = 15, step_3 = 20, step_4 = 25;
}  // namespace

bool Twin::at_limit(const Axis& axis, int direction) const {
    if (direction > 0) return axis.level(Pin::limit_plus) == ((axis.wr2 >> 3 & 1) != 0);
    return axis.level(Pin::limit_minus) == ((axis.wr2 >> 4 & 1) != 0);
}

// Returns true if the event that this step waits for has occurred.
bool Twin::home_input(const Axis& axis, int step) const {
    const bool in0 = axis.level(Pin::in0) == ((axis.wr1 >> 0 & 1) != 0);
    const bool in1 = axis.level(Pin::in1) == ((axis.wr1 >> 2 & 1) != 0);
    const bool in2 = axis.level(Pin::in2) == ((axis.wr1 >> 4 & 1) != 0);
    if (step == 3) return (axis.as.em7 & 0x0200) ? in1 && in2 : in2;
    if (axis.as.em7 & 0x0400) return at_limit(axis, axis.as.direction(step));
    return step == 1 ? in0 : in1;
}

// Returns true if the search stops its drive in this tick.
bool Twin::home_stops(Axis& axis) {
    Extension& as = axis.as;
    if (as.hmst == 0 || as.hmst == step_4) return false;
    const bool there = home_input(axis, as.step());
    bool stops = there;
    if (as.hmst == step_2_back) {
        if (there) as.seen = true;
        stops = as.seen && !there;
    }
    if (stops) as.found = true;
    return stops;
}

void Twin::start_home(int a) {
    if (driving(a)) {
        ++conditions_;
        return;
    }
    Extension& as = axes_[a].as;
    as.found = as.seen = as.cancelled = as.cleared = as.error = false;
    begin_home_step(a, 1);
}

// Continues with the first enabled step from this one on.
void Twin::begin_home_step(int a, int step) {
    Axis& axis = axes_[a];
    Extension& as = axis.as;
    for (; step <= 4; ++step) {
        if (!as.enabled(step)) continue;
        const bool there = step < 4 && home_input(axis, step);
        if (step == 1 && there) continue;
        if (step == 2) {
            as.seen = there;
            return go_home(a, there || at_limit(axis, as.direction(2)) ? step_2_back : step_2);
        }
        if (step == 3 && there) {
            as.error = true;
            return end_home(a);
        }
        return go_home(a, step == 1 ? step_1 : step == 3 ? step_3 : step_4);
    }
    finish_home(a);
}

void Twin::go_home(int a, int hmst) {
    Extension& as = axes_[a].as;
    as.hmst = hmst;
    as.found = false;
    const int direction = hmst == step_2_back ? -as.direction(2) : as.direction(as.step());
    start_drive(a, (hmst == step_4 ? 0x20 : 0x22) + (direction > 0 ? 0 : 1));
}

// Advances the search at the end of a tick.
void Twin::look_at_home(int a) {
    Axis& axis = axes_[a];
    Extension& as = axis.as;
    if (as.hmst == 0 || axis.gen.kind != Generator::Kind::idle) return;
    if (as.cancelled) return end_home(a);
    if (axis.waits_position || (as.cleared && now_ < as.clear_until)) return;

    const int step = as.step();
    const bool limit_is_home = (as.em7 & 0x0400) != 0;
    const unsigned errors = axis.finished & 0xF000u, limit = as.direction(step) > 0 ? 0x1000u : 0x2000u;
    if (as.hmst == step_1 && errors == limit && as.enabled(2)) return begin_home_step(a, 2);
    if (as.hmst == step_2 && errors == limit && !limit_is_home) {
        as.seen = home_input(axis, 2);
        return go_home(a, step_2_back);
    }
    const bool limit_is_fine = limit_is_home && (as.hmst == step_1 || as.hmst == step_2 || as.hmst == step_2_again);
    if (errors != 0 && !(limit_is_fine && errors == limit)) return end_home(a);
    if (as.hmst == step_4 ? axis.gen.n < axis.reg.pulses : !as.found) return end_home(a);
    if (as.hmst == step_2_back) return go_home(a, step_2_again);
    if (as.hmst == step_3 && !as.cleared) {
        as.cleared = true;
        ask_clear(axis);
        if (now_ < as.clear_until) return;
    }
    begin_home_step(a, step + 1);
}

// Ends the search after its last step.
void Twin::finish_home(int a) {
    Axis& axis = axes_[a];
    if (!axis.as.enabled(3)) ask_clear(axis);
    if (axis.as.em7 & 0x0100) {
        axis.lp = axis.ep = 0;
        compare(a);
    }
    end_home(a);
}

void Twin::end_home(int a) {
    Axis& axis = axes_[a];
    axis.as.hmst = 0;
    if (axis.as.em6 & 0x20) axis.flags |= 1u << 8;
}

}  // namespace motionrack::mcx314::twin
