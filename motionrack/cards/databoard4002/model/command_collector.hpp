// Commands of C2 with their arguments and answers on DATA, and the enables of C4.
//
//   idle ──D, P, R──► either ──OUT DATA──► collecting ──last byte──► idle
//     │                 └──────INP DATA──► answering ──last byte──► idle
//     └──N, S──► collecting, V ──► answering
//
// CommandCollector::CollectorSteps in the .cpp file is the table of these states.
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/condition_reporter.hpp>
#include <motionrack/cards/databoard4002/model/event_register.hpp>
#include <motionrack/cards/databoard4002/model/output_stage.hpp>
#include <motionrack/cards/databoard4002/model/position_counter.hpp>
#include <motionrack/cards/databoard4002/model/positioner.hpp>
#include <motionrack/cards/databoard4002/model/settings.hpp>
#include <motionrack/cards/databoard4002/model/state.hpp>

namespace motionrack::databoard4002 {

class CommandCollector {
  public:
    /// `state` and `latch` are parts of the card's state; `settings` must outlive the collector.
    CommandCollector(CollectorState& state, std::uint8_t& latch, const Settings& settings,
                     const ConditionReporter& conditions, const PositionCounter& counter, EventRegister& events,
                     Positioner& positioner, const OutputStage& outputs);

    /// The byte that INP DATA returns.
    std::uint8_t latch() const { return latch_; }

    void take_command(std::uint8_t code, Instant now);
    void take_argument(std::uint8_t value);
    /// Moves the next byte of an answer into the latch.
    void next_answer();
    void enable_events(std::uint8_t value);

  private:
    struct CollectorSteps;

    /// Begins the answer `value` of that many bytes; the first byte enters the latch at once.
    void open_answer(std::int64_t value, int bytes);
    void arguments_complete(std::uint8_t code);
    void report_during_move(std::uint8_t code);

    CollectorState& state_;
    std::uint8_t& latch_;
    const Settings& settings_;
    const ConditionReporter& conditions_;
    const PositionCounter& counter_;
    EventRegister& events_;
    Positioner& positioner_;
    const OutputStage& outputs_;
};

}  // namespace motionrack::databoard4002
