// The outputs: divider, voltage, relay, gate, sign, the pulse of a reset.
//
//   rate ─► divider ─► fout            sign: direction of the last move
//        └► volts ─┬► vdirect          gate: closed while an end stop in this direction is active
//                  └► relay ─► vout
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/pins.hpp>
#include <motionrack/cards/databoard4002/model/positioner.hpp>
#include <motionrack/cards/databoard4002/model/settings.hpp>
#include <motionrack/cards/databoard4002/model/state.hpp>
#include <motionrack/sim/blocks/pulse_train.hpp>

namespace motionrack::databoard4002 {

class OutputStage {
  public:
    /// Refers to its parts of the card's `state`; `settings` must outlive it.
    OutputStage(State& state, const Settings& settings, const Positioner& positioner, Pins& pins);

    sim::PulseTrain& train() { return train_; }
    /// Rate at the output, negative backwards; 0 at standstill.
    int signed_rate() const { return rate_ * positioner_.direction(); }
    /// FOUT in Hz, 0 without pulses.
    double fout_hz() const { return train_.running() ? hz_of(rate_) : 0; }
    int fout_level(Instant t) const { return train_.level(t); }

    /// Sets the rate of a pass; update() puts it out.
    void set_rate(int rate) { rate_ = rate; }
    /// Sets all outputs by rate, direction and inputs.
    void update(Instant now);

    void begin_reset_pulse(Instant now);
    void end_reset_pulse(Instant now);

    /// Notifies the listeners whose watched range the pulse count has left.
    void act(Instant now) { train_.act(now); }
    /// Delivers the edges of the pulses.
    void sync(Instant now) { train_.hand_over(now); }
    /// Begins or ends the updates of the wire fout at each of its edges.
    void follow_fout(bool wanted, Instant now);
    /// Sets the wire fout while a listener follows it.
    void show_fout(Instant now);
    /// The next instant at which an output is due.
    Instant next(Instant now) const;

  private:
    bool gate_open() const;

    const Settings& settings_;
    const Positioner& positioner_;
    Pins& pins_;
    sim::PulseTrain train_;
    std::int32_t& rate_;
    Instant& reset_pulse_end_;
    Instant& fout_at_;
    std::uint8_t& fout_wanted_;
};

}  // namespace motionrack::databoard4002
