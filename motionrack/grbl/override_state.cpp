#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/grbl/override_state.hpp>

namespace motionrack::grbl {

namespace {

struct OverrideStep {
    Realtime what;
    int Overrides::*which;
    bool absolute;
    int percent;
};
constexpr std::array<OverrideStep, 13> override_steps = {{
    {Realtime::feed_100, &Overrides::feed, true, 100},
    {Realtime::feed_plus_10, &Overrides::feed, false, 10},
    {Realtime::feed_minus_10, &Overrides::feed, false, -10},
    {Realtime::feed_plus_1, &Overrides::feed, false, 1},
    {Realtime::feed_minus_1, &Overrides::feed, false, -1},
    {Realtime::rapid_100, &Overrides::rapid, true, 100},
    {Realtime::rapid_50, &Overrides::rapid, true, 50},
    {Realtime::rapid_25, &Overrides::rapid, true, 25},
    {Realtime::spindle_100, &Overrides::spindle, true, 100},
    {Realtime::spindle_plus_10, &Overrides::spindle, false, 10},
    {Realtime::spindle_minus_10, &Overrides::spindle, false, -10},
    {Realtime::spindle_plus_1, &Overrides::spindle, false, 1},
    {Realtime::spindle_minus_1, &Overrides::spindle, false, -1},
}};
constexpr int min_override = 10, max_override = 200;

const OverrideStep* override_step(Realtime what) {
    for (const OverrideStep& one : override_steps)
        if (one.what == what) return &one;
    return nullptr;
}

}  // namespace

bool is_override(Realtime what) {
    return override_step(what) != nullptr;
}

Overrides OverrideState::now() const {
    return {static_cast<int>(std::lround(machine_.programs().feed_override() * 100)),
            static_cast<int>(std::lround(machine_.programs().rapid_override() * 100)), spindle_};
}

void OverrideState::change(Realtime what) {
    const OverrideStep& step = *override_step(what);
    Overrides next = now();
    int& value = next.*step.which;
    value = std::clamp(step.absolute ? step.percent : value + step.percent, min_override, max_override);
    spindle_ = next.spindle;
    machine_.programs().set_overrides(next.feed / 100.0, next.rapid / 100.0);
}

void OverrideState::end_program() {
    spindle_ = 100;
    machine_.programs().set_overrides(1, 1);
}

void OverrideState::reset_spindle() {
    spindle_stopped_ = false;
    spindle_ = 100;
}

}  // namespace motionrack::grbl
