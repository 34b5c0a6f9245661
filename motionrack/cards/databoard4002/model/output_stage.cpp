// Levels of the outputs, and the instants at which they change.
#include <algorithm>
#include <motionrack/cards/databoard4002/model/output_stage.hpp>

namespace motionrack::databoard4002 {

OutputStage::OutputStage(State& state, const Settings& settings, const Positioner& positioner, Pins& pins)
    : settings_(settings),
      positioner_(positioner),
      pins_(pins),
      train_(state.train, tick),
      rate_(state.firmware.out_rate),
      reset_pulse_end_(state.reset_pulse_end),
      fout_at_(state.fout_at),
      fout_wanted_(state.fout_wanted) {}

bool OutputStage::gate_open() const {
    return positioner_.direction() > 0 ? !pins_.input(esr_pin, stat::ESR) : !pins_.input(esl_pin, stat::ESL);
}

void OutputStage::update(Instant now) {
    show_fout(now);  // a pulse at this very instant keeps the old sign
    const int rate = rate_, direction = positioner_.direction();
    const bool driven = rate > 0 && gate_open();
    const bool relay = positioner_.rate() != 0 && !pins_.input(ems_pin, stat::EMS);
    pins_.set(sign_pin, direction > 0);
    pins_.set(relay_pin, relay);
    const int microvolts = driven ? direction * microvolts_of(rate, settings_.trim) : 0;
    pins_.set(direct_pin, microvolts);
    pins_.set(vout_pin, relay ? microvolts : 0);
    if (driven)
        train_.run(divisor_of(rate), direction, now);
    else
        train_.stop(now);
    if (fout_wanted_) fout_at_ = now;
}

void OutputStage::begin_reset_pulse(Instant now) {
    reset_pulse_end_ = now + reset_pulse;
    pins_.set(rst_pin, 1);
}

void OutputStage::end_reset_pulse(Instant now) {
    if (reset_pulse_end_ > now) return;
    reset_pulse_end_ = never;
    pins_.set(rst_pin, 0);
}

void OutputStage::follow_fout(bool wanted, Instant now) {
    fout_wanted_ = wanted;
    fout_at_ = now;
}

void OutputStage::show_fout(Instant now) {
    if (!fout_wanted_ || fout_at_ > now) return;
    pins_.set(fout_pin, train_.level(now));
    fout_at_ = train_.next_edge(now);
}

Instant OutputStage::next(Instant now) const {
    const Instant out = std::min(reset_pulse_end_, train_.next(now));
    return fout_wanted_ ? std::min(out, fout_at_) : out;
}

}  // namespace motionrack::databoard4002
