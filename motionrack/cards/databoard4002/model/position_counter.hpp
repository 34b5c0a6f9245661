// The counter of the encoder's position: in closed form for a connected motion, edge by edge for the wires o1 and o2.
//
//   PositionFunction ──► closed form ──┐
//                                      ├──► value: all bits; the host sees the lowest 24
//   o1, o2 ──► strap field ──► edges ──┘
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/condition_reporter.hpp>
#include <motionrack/cards/databoard4002/model/pass_schedule.hpp>
#include <motionrack/cards/databoard4002/model/pins.hpp>
#include <motionrack/cards/databoard4002/model/settings.hpp>
#include <motionrack/cards/databoard4002/model/state.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/sim/range.hpp>

namespace motionrack::databoard4002 {

class PositionCounter {
  public:
    /// `state` and `turn` are parts of the card's state; `settings` must outlive the counter.
    PositionCounter(const sim::Kernel& kernel, CounterState& state, std::int64_t& turn, const Settings& settings,
                    const ConditionReporter& conditions, PassSchedule& passes, Pins& pins);

    /// Connects the source of the counts, before the kernel starts; `card` forwards its notifications.
    void connect(sim::PositionFunction& counts, sim::PositionListener& card);
    bool has_encoder() const { return encoder_ != nullptr; }
    /// Rate of the source, counts/s.
    double encoder_rate(Instant t) const { return encoder_->rate(t); }
    /// Takes the levels of the lines at power-up.
    void begin();
    /// True if take() would change the source.
    bool can_take(bool taken) const { return encoder_ != nullptr && taken != (state_.cut != 0); }
    /// Disconnects the source and forces the lines to its present levels (`taken`), or releases them and reconnects it.
    void take(bool taken, Instant now);

    std::int64_t value(Instant t) const;
    void zero(Instant now);
    /// Requests a notification when the value leaves the range. Without a source every counted edge requests a pass.
    void watch(sim::Range range);
    /// Ends the watch after the value has left its range.
    void clear_watch() { encoder_->watch(encoder_slot_, sim::unwatched_below, sim::unwatched_above); }

    /// Range of the present interval of 2^24 counts.
    sim::Range turn_range() const;
    /// Reports that the value has left the interval.
    void note_turn(Instant now);

    /// Freezes the value while the source is above the rate limit; returns whether that changed.
    bool rate_changed(double rate, Instant now);
    void line_changed(int line, int level, Instant now);
    /// Counts the lines whose dead time has ended.
    void look_at_lines(Instant now);
    /// End of the next dead time in which a line has changed.
    Instant next() const;

  private:
    bool connected() const { return encoder_ != nullptr && !state_.cut; }
    void take_line(int line, Instant at);
    double limit_hz() const { return settings_.single_ended ? 50'000 : 100'000; }
    Duration half_period() const { return microseconds(settings_.single_ended ? 10 : 5); }
    bool too_quick(double rate) const;

    const sim::Kernel& kernel_;
    CounterState& state_;
    std::int64_t& turn_;
    const Settings& settings_;
    const ConditionReporter& conditions_;
    PassSchedule& passes_;
    Pins& pins_;
    sim::PositionFunction* encoder_ = nullptr;
    int encoder_slot_ = 0;
};

}  // namespace motionrack::databoard4002
