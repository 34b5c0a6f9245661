// The four speed generators and the interpolator, tick by tick (RULES.md, "One generator an axis"): inputs, pulse,
// speed, and the consequences of a pulse.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/mcx314/chip/action_conditions.hpp>
#include <motionrack/cards/mcx314/chip/comparators.hpp>
#include <motionrack/cards/mcx314/chip/edge_stream.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/fast_forward.hpp>
#include <motionrack/cards/mcx314/chip/motion_law.hpp>
#include <motionrack/cards/mcx314/chip/options.hpp>
#include <motionrack/cards/mcx314/chip/pattern_stack.hpp>
#include <motionrack/cards/mcx314/chip/pulse_listeners.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class Generators {
  public:
    /// Components that a pulse changes or notifies.
    struct Surroundings {
        EventRequests& requests;
        const PulseListeners& listeners;
        const MotionLaw& law;
        EdgeStream& edges;
        ActionConditions& conditions;
        Comparators& comparators;
        PatternStack& patterns;
        FastForward& forward;
    };
    Generators(State& state, const ChipOptions& options, const Surroundings& around)
        : state_(state),
          options_(options),
          extended_(options.extended()),
          requests_(around.requests),
          listeners_(around.listeners),
          law_(around.law),
          edges_(around.edges),
          conditions_(around.conditions),
          comparators_(around.comparators),
          patterns_(around.patterns),
          forward_(around.forward) {}

    /// Executes one tick of generator `a`.
    void work(int a);
    /// Executes only step 3 of the tick, the speed, of generator `a`; returns true if the drive ended.
    bool speed_step(int a);
    /// Begins a segment of the running interpolation.
    void begin_segment(const PathCommand& command);
    /// Begins the final deceleration of generator `a` if it is due.
    void check_final(int a);
    /// Begins a single step requested by wire or by command (`by`, a bit of PathCommand::steps). Returns false if the
    /// running interpolation does not accept it.
    bool ask_step(std::uint32_t by);
    /// Sets V to `v`. The drive goes to HV in a slow drive of a home search, at most to the cap, and, by option, at
    /// least to SV.
    void set_drive_speed(int a, std::uint16_t v);
    void set_drive_speed(int a) { set_drive_speed(a, state_.extension[a].v); }

  private:
    bool inputs(int a);
    std::uint16_t active_inputs(const Axis& axis, bool& decelerating, bool& immediate) const;
    bool stop(int a, bool decelerating, bool immediate);
    void end(int a);
    bool pulse(int a);
    int step_axes(int a);
    void move(int a, int direction, std::int64_t tick);
    bool segment_end(int a);
    int step_pattern();
    void next_pattern_word();
    void look_ahead_in_pattern();
    void end_step(int a);
    void avoid_triangle(int a);

    State& state_;
    const ChipOptions& options_;
    const bool extended_;
    EventRequests& requests_;
    const PulseListeners& listeners_;
    const MotionLaw& law_;
    EdgeStream& edges_;
    ActionConditions& conditions_;
    Comparators& comparators_;
    PatternStack& patterns_;
    FastForward& forward_;
    unsigned moved_last_ = 0;               // axes (one bit each) that stepped in the present basic pulse
    std::array<int, axes_of_chip> went_{};  // direction of each axis' step: -1, 0, +1
};

}  // namespace motionrack::mcx314
