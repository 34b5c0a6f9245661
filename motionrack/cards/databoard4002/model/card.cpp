// Card timing, port access and resets.
#include <algorithm>
#include <motionrack/cards/databoard4002/model/card.hpp>

namespace motionrack::databoard4002 {

Card::Card(sim::Kernel& kernel, const std::string& name, const Settings& settings)
    : kernel_(kernel),
      settings_(settings),
      id_(kernel.add(*this, sim::Phase::cards, name)),
      conditions_(kernel, id_),
      passes_(state_.pass_at, settings.firmware_pass_ticks),
      watchdog_(state_.watchdog_at, state_.hung),
      pins_(kernel, id_, name, state_.broken),
      counter_(kernel, state_.counter, state_.firmware.turn, settings_, conditions_, passes_, pins_),
      events_(state_.firmware.events, pins_),
      positioner_(state_.firmware.positioner, conditions_, passes_, pins_, counter_, events_),
      outputs_(state_, settings_, positioner_, pins_),
      commands_(state_.firmware.ports.collector, state_.firmware.ports.latch, settings_, conditions_, counter_, events_,
                positioner_, outputs_),
      ports_(state_.firmware.ports, settings_.byte_time, conditions_, passes_, pins_, events_, commands_) {
    MOTIONRACK_ASSERT(check(settings).has_value());
    outputs_.train().set_owner(this);
    kernel.schedule(id_, Instant{0});
}

// ---- time

void Card::reschedule() {
    if (!state_.begun) return;
    const Instant now = kernel_.now();
    Instant next = std::min({watchdog_.due(), outputs_.next(now), counter_.next()});
    if (!watchdog_.hung()) next = std::min(next, passes_.next());
    kernel_.schedule(id_, next);
}

/// Reads the inputs at power-up.
void Card::begin() {
    if (state_.begun) return;
    const Instant now = kernel_.now();
    state_.begun = 1;
    counter_.begin();
    if (counter_.has_encoder()) rate_changed(0, counter_.encoder_rate(now), now);
    reset();
}

// ---- the encoder

void Card::connect_encoder(sim::PositionFunction& counts) {
    MOTIONRACK_ASSERT(!state_.begun);
    counter_.connect(counts, *this);
}

void Card::take_encoder(bool taken) {
    if (!counter_.can_take(taken)) return;
    begin();
    const Instant now = kernel_.now();
    counter_.take(taken, now);
    if (!taken) rate_changed(0, counter_.encoder_rate(now), now);
    passes_.request(now);
    reschedule();
}

void Card::crossed(Instant now) {
    counter_.clear_watch();
    passes_.request(now);
    reschedule();
}

void Card::rate_changed(double, double rate, Instant now) {
    if (!counter_.rate_changed(rate, now)) return;
    passes_.request(now);
    reschedule();
}

// ---- events of the kernel

void Card::on_scheduled(Instant now) {
    begin();
    if (watchdog_.due() <= now) {
        conditions_.report(CardCondition::watchdog_reset);
        reset();
    }
    outputs_.end_reset_pulse(now);
    counter_.look_at_lines(now);
    outputs_.act(now);
    if (passes_.next() <= now && !watchdog_.hung()) pass(now);
    outputs_.show_fout(now);
    reschedule();
}

void Card::on_wire(int pin, int level, Instant now) {
    begin();
    if (pin == o1_pin || pin == o2_pin) counter_.line_changed(pin, level, now);
    if (pin == zero_pin || pin == ref_pin) look_at_zero(now);
    if (pin == ems_pin || pin == esr_pin || pin == esl_pin) {
        outputs_.update(now);
        passes_.request(now);
    }
    outputs_.show_fout(now);
    reschedule();
}

int Card::level_at(int, Instant now) const {
    return outputs_.fout_level(now);
}

void Card::wanted_changed(int, bool wanted, Instant now) {
    outputs_.follow_fout(wanted, now);
    reschedule();
}

/// Updates the state once, as the loop of the firmware does.
void Card::pass(Instant now) {
    passes_.clear();
    ports_.work(now);
    if (events_.note_stops() & stat::EMS) positioner_.abort(now);
    positioner_.check_position(now);
    counter_.note_turn(now);
    outputs_.set_rate(positioner_.output_rate(now));
    outputs_.update(now);
    ports_.update_interrupt();
    ports_.request_pass();
    positioner_.aim(now);
}

/// Resets the card: at power-up, by C3, INP 7 or the watchdog.
void Card::reset() {
    const Instant now = kernel_.now();
    state_.firmware = Firmware{};
    watchdog_.restart();
    counter_.zero(now);
    events_.take_stops();
    events_.subscribe_zero();
    outputs_.update(now);
    ports_.update_interrupt();
    passes_.restart(now);
    reschedule();
}

void Card::look_at_zero(Instant now) {
    const std::uint8_t seen = events_.take_armed();
    if (seen == 0) return;
    if (settings_.zeroing) positioner_.zero(now);
    events_.raise(seen);
    events_.subscribe_zero();
    ports_.update_interrupt();
    passes_.request(now);
}

// ---- ports

void Card::access(Work kind, std::uint8_t port, std::uint8_t value) {
    if (ports_.access(kind, port, value, kernel_.now())) reschedule();
}

std::uint8_t Card::in(std::uint8_t port) {
    begin();
    const std::uint8_t value = peek(port);
    if (port == ports::DATA) access(Work::in_data, port, 0);
    if (port == ports::RST) reset();
    return value;
}

std::uint8_t Card::peek(std::uint8_t port) const {
    return ports_.value(port);
}

void Card::out(std::uint8_t port, std::uint8_t value) {
    begin();
    switch (port) {
        case ports::DATA:
            return access(Work::out_data, port, value);
        case ports::C2:
            return access(Work::command, port, value);
        case ports::C4:
            return access(Work::enables, port, value);
        case ports::C3:
            outputs_.begin_reset_pulse(kernel_.now());
            return reset();
        default:
            return;
    }
}

// ---- faults

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
    outputs_.update(now);
    passes_.request(now);
    reschedule();
    return true;
}

}  // namespace motionrack::databoard4002
