// The pins: inputs, events and zeroing, the gate, the outputs.
//
//   rate ─► divider ─► fout            sign: direction of the last move
//        └► volts ─┬► vdirect          gate: closed while an end stop in this direction is active
//                  └► relay ─► vout
#include <motionrack/cards/databoard4002/model/card.hpp>

namespace motionrack::databoard4002 {

void Card::on_wire(int pin, int level, Instant now) {
    begin();
    if (pin == o1_pin || pin == o2_pin) counter_.line_changed(pin, level, now);
    if (pin == zero_pin || pin == ref_pin) look_at_zero(now);
    if (pin == ems_pin || pin == esr_pin || pin == esl_pin) {
        put_out(now);
        passes_.request(now);
    }
    show_fout(now);
    reschedule();
}

std::span<const std::string_view> Card::fault_names() {
    static constexpr std::string_view names[] = {"watchdog.hang", "esl.broken", "esr.broken", "ems.broken",
                                                 "ref.broken"};
    return names;
}

bool Card::fault(std::string_view name, double value, Instant now) {
    begin();
    if (name == "watchdog.hang") {
        if (value != 0)
            watchdog_.hang(passes_.last_until(now));
        else
            watchdog_.restart();
        passes_.restart(now);
        reschedule();
        return true;
    }
    if (!pins_.break_wire(name, value != 0)) return false;
    look_at_zero(now);
    put_out(now);
    passes_.request(now);
    reschedule();
    return true;
}

// ---- events

void Card::look_at_zero(Instant now) {
    const std::uint8_t seen = events_.take_armed();
    if (seen == 0) return;
    if (settings_.zeroing) positioner_.zero(now);
    events_.raise(seen);
    events_.subscribe_zero();
    update_interrupt();
    passes_.request(now);
}

void Card::update_interrupt() {
    events_.update_interrupt(state_.firmware.ready != 0);
}

// ---- outputs

bool Card::gate_open() const {
    return positioner_.direction() > 0 ? !pins_.input(esr_pin, stat::ESR) : !pins_.input(esl_pin, stat::ESL);
}

void Card::put_out(Instant now) {
    show_fout(now);  // a pulse at this very instant keeps the old sign
    const Firmware& f = state_.firmware;
    const int rate = f.out_rate, direction = positioner_.direction();
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
    if (state_.fout_wanted) state_.fout_at = now;
}

int Card::level_at(int, Instant now) const {
    return train_.level(now);
}

void Card::wanted_changed(int, bool wanted, Instant now) {
    state_.fout_wanted = wanted;
    state_.fout_at = now;
    reschedule();
}

/// Sets the wire fout while a listener follows it.
void Card::show_fout(Instant now) {
    if (!state_.fout_wanted || state_.fout_at > now) return;
    pins_.set(fout_pin, train_.level(now));
    state_.fout_at = train_.next_edge(now);
}

}  // namespace motionrack::databoard4002
