// Requests that an event makes for after it: ticks to be executed, the search for the next event, changed laws of
// motion.
#pragma once

#include <algorithm>
#include <cstdint>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <utility>

namespace motionrack::mcx314 {

class EventRequests {
  public:
    explicit EventRequests(State& state) : state_(state) {}

    /// Requests that the inputs are sampled in the next tick.
    void wake() { sample_at(state_.tick + 1); }
    /// Requests that the inputs are sampled at `tick` at the latest.
    void sample_at(std::int64_t tick) {
        state_.sampling.next = std::min(state_.sampling.next, tick);
        make_stale();
    }
    /// Makes every generator execute its next working tick in full; required after a change of inputs, limits or
    /// commands.
    void look_anew() {
        for (Axis& axis : state_.axis) axis.gen.full_tick = true;
    }
    /// Invalidates Generator::next_special (the next pulse that does more than step its axes) of every generator;
    /// required after a change of registers, of interrupt flags, or of listeners for pulses or counts.
    void forget_specials() {
        for (Axis& axis : state_.axis) axis.gen.special_known = false;
    }

    /// Requests that the tick of the next event is found again.
    void make_stale() { stale_ = true; }
    bool stale() const { return stale_; }
    void found_next() { stale_ = false; }

    /// Records that the law of motion of axis `a` has changed in the present event.
    void law_changed(int a) { changed_ |= 1u << a; }
    /// Records a changed law of motion for all axes that the generator moves.
    void law_changed_of(int generator) { changed_ |= state_.moved_by(generator); }
    /// Returns the axes, one bit each, whose law has changed since the last call.
    unsigned take_changed() { return std::exchange(changed_, 0u); }

  private:
    State& state_;
    bool stale_ = false;
    unsigned changed_ = 0;
};

}  // namespace motionrack::mcx314
