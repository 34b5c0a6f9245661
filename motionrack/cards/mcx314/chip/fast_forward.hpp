// Computes in closed form the tick of a generator's next event, and advances it over plain ticks in one step.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/comparators.hpp>
#include <motionrack/cards/mcx314/chip/edge_stream.hpp>
#include <motionrack/cards/mcx314/chip/motion_law.hpp>
#include <motionrack/cards/mcx314/chip/pulse_listeners.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class FastForward {
  public:
    FastForward(State& state, const MotionLaw& law, const PulseListeners& listeners, EdgeStream& edges,
                Comparators& comparators)
        : state_(state), law_(law), listeners_(listeners), edges_(edges), comparators_(comparators) {}

    /// Finds the next tick at which generator `a` does more than accumulate, and whether that is only a step of its
    /// speed.
    void find_next_tick(int a);
    /// Advances generator `a`, which has no event up to `tick`, to that tick.
    void bring_up(int a, std::int64_t tick);
    /// Advances generator `a` to `tick` within its combined speed steps, at most to their end. A generator that waits
    /// for a step request changes only its time.
    void bring_along(int a, std::int64_t tick);
    /// Executes step 2 of a tick, the pulses, for the next `ticks`. Only the last pulse may do more than step its axes.
    void skip_phase(int a, std::int64_t ticks);
    /// Updates the wires of the generator's axes after a basic pulse: `stepped` have a new pulse, the last pulse of the
    /// others has ended.
    void mark_pulse(int a, unsigned stepped, const PulseMoment& at);
    /// Requests full execution of the present `tick` by all generators.
    void work_in_full(std::int64_t tick);

  private:
    std::int64_t pulses_to_special(int a) const;
    std::int64_t steps_to_threshold(int a, int direction) const;
    void skip_pulses(int a, std::int64_t pulses, const PulseMoment& last);
    bool some_unheard() const { return (listeners_.heard | state_.following) != (1u << axes_of_chip) - 1; }
    bool may_walk(int a) const;
    void walk_ahead(int a, std::int64_t phase_limit);

    State& state_;
    const MotionLaw& law_;
    const PulseListeners& listeners_;
    EdgeStream& edges_;
    Comparators& comparators_;
};

}  // namespace motionrack::mcx314
