// Positioning: the registers that commands set, the move to the target, lock.
//
//   G ──► move ──► rate by Rate and slope table ──► position reached
//          ▲                                             │
//          └────── lock: deviation > window ◄────────────┘
//
// Positioner::MoveSteps in the .cpp file is the table of the states of a move.
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/condition_reporter.hpp>
#include <motionrack/cards/databoard4002/model/event_register.hpp>
#include <motionrack/cards/databoard4002/model/pass_schedule.hpp>
#include <motionrack/cards/databoard4002/model/pins.hpp>
#include <motionrack/cards/databoard4002/model/position_counter.hpp>
#include <motionrack/cards/databoard4002/model/state.hpp>

namespace motionrack::databoard4002 {

class Positioner {
  public:
    /// `state` is part of the card's state and must outlive this.
    Positioner(PositionerState& state, const ConditionReporter& conditions, PassSchedule& passes, const Pins& pins,
               PositionCounter& counter, EventRegister& events);

    bool moving() const { return state_.move.on != 0; }
    bool locked() const { return state_.lock != 0; }
    /// Direction of the last move, +1 or -1.
    int direction() const { return state_.move.direction; }
    /// The register Rate.
    int rate() const { return state_.rate; }
    const SlopeTable& table() const { return state_.table; }
    /// Deviation from the requested position, counts.
    std::int64_t deviation(Instant now) const { return signed24(counter_.value(now) - state_.requested); }

    // ---- commands
    /// Starts the move that P or N specifies, and switches lock off (command G).
    void go(Instant now);
    /// Sets the present position to 0 (command A).
    void home(Instant now);
    /// Switches lock on (command L): the card goes back to the requested position whenever it deviates by more than D.
    void lock();
    /// Switches slope mode and lock off (command M).
    void select_manual();
    /// Switches slope mode on and sets Rate to its maximum (command O).
    void select_slope() {
        state_.sloped = 1;
        state_.rate = max_rate;
    }
    /// Ends the move and lock (command Q); `zeroes`: also zeroes the values set by P and N.
    void quit(bool zeroes);
    void set_window(std::int64_t counts) { state_.window = counts; }
    void set_number(std::int64_t counts);
    void set_target(std::int64_t position);
    void set_rate(std::int32_t rate) { state_.rate = rate; }
    void set_table_byte(int i, std::uint8_t value) { state_.table.set_byte(i, value); }

    /// Sets the present position to 0; the distance travelled in a move is kept.
    void zero(Instant now);

    // ---- a pass
    /// Aborts the move and lock: the emergency stop is active.
    void abort(Instant now);
    /// Ends a move that has reached its target, or begins the move back of lock.
    void check_position(Instant now);
    /// Rate of the output, 0 at standstill.
    int output_rate(Instant now) const;
    /// Watches the counter for the next position at which a pass has an effect.
    void aim(Instant now);

  private:
    struct MoveSteps;

    void begin_move(std::int64_t target, Instant now);
    void report_flaw();

    PositionerState& state_;
    const ConditionReporter& conditions_;
    PassSchedule& passes_;
    const Pins& pins_;
    PositionCounter& counter_;
    EventRegister& events_;
};

}  // namespace motionrack::databoard4002
