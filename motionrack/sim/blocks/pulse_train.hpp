// Pulses from a divided clock, in closed form: the programmable divider at the output of a card.
//
//   start      reload          a new divisor takes effect at the end of the running period
//   |<-first->|<-then->|<-then->|
//   __________|~~~~|___|~~~~|___      a pulse at each period's end, high for half of such a period
//
// A pulse keeps its length if the divider stops within it. If the divider restarts at once, the pulse ends at the
// latest at half of the first period.
//
// Single pulses cost no time. The owner (a device) asks next(), calls act() then, and delivers edges at its sync.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/sim/listeners.hpp>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::sim {

/// Trivially copyable; part of the owner's state.
struct PulseTrainState {
    std::int64_t count = 0;  ///< number of pulses at `origin`, signed by direction
    Instant origin{};        ///< the running period's start, or one before it with the same `then`
    Instant handed{};        ///< edges up to here have been delivered
    std::int64_t first = 0;  ///< length of the period that starts at origin, clocks; 0: no pulses
    std::int64_t then = 0;   ///< length of the following periods
    std::int32_t direction = 1;
    std::int32_t reserved = 0;
    Instant falls{};  ///< the line is high until here, after the last pulse at or before the origin
    Listeners::Watches watches{};
};

class PulseTrain final : public PositionFunction {
  public:
    /// `clock`: one period of the divided clock.
    PulseTrain(PulseTrainState& state, Duration clock) : state_(state), clock_(clock) {}

    // ---- for the owner
    /// Runs with `divisor` clocks per period (> 0) in `direction` (+1, -1); begins a whole period after a standstill or
    /// a reversal.
    void run(std::int64_t divisor, int direction, Instant now);
    void stop(Instant now);
    bool running() const { return state_.first != 0; }
    int direction() const { return state_.direction; }
    /// The next instant after `now` at which a watched count is left; at once if it is left already.
    Instant next(Instant now) const;
    /// Notifies the listeners whose range is left at `now`.
    void act(Instant now);
    /// The line's level, and the instant after `now` of its next change (never: constant).
    int level(Instant now) const;
    Instant next_edge(Instant now) const;
    void hand_over(Instant now);

    // ---- PositionFunction
    std::int64_t count(Instant t) const override;
    double rate(Instant t) const override;
    void watch(int slot, std::int64_t below, std::int64_t above) override;
    int add_listener(PositionListener& listener) override;
    void set_edge_listener(EdgeListener* listener) override;
    void deliver_edges() override;

    /// Called when a watch is set, so the owner can schedule; and the present instant, for edges.
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
    /// End of the high level after the n-th pulse; 0: the pulse before the origin.
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
