// Pulses from a divided clock, in closed form: a programmable divider at the output of a card.
//
//   start      reload          a new divisor holds from the end of the running period on
//   |<-first->|<-then->|<-then->|
//   __________|~~~~|___|~~~~|___      a pulse at each period's end, high for half of such a period
//
// A pulse that has begun is as long where the divider stops in it; where it starts again at once, at most until half of
// the first period is over.
//
// Nothing is done for a pulse. The owner (a device) asks next(), calls act() then, and hands over edges at its sync.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/sim/listeners.hpp>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::sim {

/// Trivially copyable; a part of its owner's state.
struct PulseTrainState {
    std::int64_t count = 0;  ///< at `origin`
    Instant origin{};        ///< the running period's start, or one before it with the same `then`
    Instant handed{};        ///< edges up to here have been handed over
    std::int64_t first = 0;  ///< length of the period that starts at origin, clocks; 0: no pulses
    std::int64_t then = 0;   ///< length of those after it
    std::int32_t direction = 1;
    std::int32_t reserved = 0;
    Instant falls{};  ///< until here the line is high after the last pulse before or at the origin
    Listeners::Watches watches{};
};

class PulseTrain final : public PositionFunction {
  public:
    /// `clock`: one period of the clock that is divided.
    PulseTrain(PulseTrainState& state, Duration clock) : state_(state), clock_(clock) {}

    // ---- for the owner
    /// Runs with `divisor` clocks a period (> 0) in `direction` (+1, -1); starts a whole period if it stood or turns.
    void run(std::int64_t divisor, int direction, Instant now);
    void stop(Instant now);
    bool running() const { return state_.first != 0; }
    int direction() const { return state_.direction; }
    /// The next instant after `now` at which a watched count is left; at once if it is left already.
    Instant next(Instant now) const;
    /// Tells the listeners whose range is left at `now`.
    void act(Instant now);
    /// The line's level, and the instant after `now` of its next change (never: it stands).
    int level(Instant now) const;
    Instant next_edge(Instant now) const;
    void hand_over(Instant now);

    // ---- Motion
    std::int64_t count(Instant t) const override;
    double rate(Instant t) const override;
    void watch(int slot, std::int64_t below, std::int64_t above) override;
    int add_listener(PositionListener& listener) override;
    void set_edge_listener(EdgeListener* listener) override;
    void deliver_edges() override;

    /// Called when a watch is set, so that the owner schedules; and the present instant, for edges.
    class Owner {
      public:
        virtual ~Owner() = default;
        virtual void train_watched() = 0;
        virtual Instant train_now() const = 0;
    };
    void set_owner(Owner* owner) { owner_ = owner; }

  private:
    /// Pulses since origin.
    std::int64_t pulses(Instant t) const;
    Instant pulse_instant(std::int64_t n) const;  // n >= 1
    /// Until when the line is high after the n-th pulse; 0: the one before the origin.
    Instant fall(std::int64_t n) const;
    Duration half(std::int64_t divisor) const { return Duration{((clock_ * divisor).count() + 1) / 2}; }
    void bring_to(Instant now);
    void notify_rate(double before, Instant now);

    PulseTrainState& state_;
    Duration clock_;
    Listeners listeners_;
    EdgeListener* edges_ = nullptr;
    EdgeBatch batch_{};
    Owner* owner_ = nullptr;
};

}  // namespace motionrack::sim
