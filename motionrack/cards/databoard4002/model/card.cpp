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
      train_(state_.train, tick) {
    MOTIONRACK_ASSERT(check(settings).has_value());
    train_.set_owner(this);
    kernel.schedule(id_, Instant{0});
}

// ---- time

void Card::reschedule() {
    if (!state_.begun) return;
    const Instant now = kernel_.now();
    Instant next = std::min({watchdog_.due(), state_.reset_pulse_end, train_.next(now)});
    if (!watchdog_.hung()) next = std::min(next, passes_.next());
    if (state_.fout_wanted) next = std::min(next, state_.fout_at);
    kernel_.schedule(id_, std::min(next, counter_.next()));
}

/// State of the inputs at power-up.
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
    if (state_.reset_pulse_end <= now) {
        state_.reset_pulse_end = never;
        pins_.set(rst_pin, 0);
    }
    counter_.look_at_lines(now);
    train_.act(now);
    if (passes_.next() <= now && !watchdog_.hung()) pass(now);
    show_fout(now);
    reschedule();
}

/// Updates the state once, as the loop of the firmware does.
void Card::pass(Instant now) {
    Firmware& f = state_.firmware;
    passes_.clear();
    if (f.access_due <= now) work(now);
    if (events_.note_stops() & stat::EMS) positioner_.abort(now);
    positioner_.check_position(now);
    counter_.note_turn(now);
    f.out_rate = positioner_.output_rate(now);
    put_out(now);
    update_interrupt();
    if (f.access != Work::none) passes_.request_at(f.access_due);
    positioner_.aim(now);
}

/// Reset by power-up, C3, INP 7 or the watchdog.
void Card::reset() {
    const Instant now = kernel_.now();
    state_.firmware = Firmware{};
    watchdog_.restart();
    counter_.zero(now);
    events_.take_stops();
    events_.subscribe_zero();
    put_out(now);
    update_interrupt();
    passes_.restart(now);
    reschedule();
}

// ---- ports

void Card::access(Work kind, std::uint8_t port, std::uint8_t value) {
    Firmware& f = state_.firmware;
    if (!f.ready) {
        conditions_.report(CardCondition::access_lost, port, kind == Work::in_data ? -1 : value);
        return;
    }
    f.ready = 0;
    f.access = kind;
    f.access_value = value;
    f.access_due = passes_.first_from(kernel_.now() + settings_.byte_time);
    passes_.request_at(f.access_due);
    update_interrupt();
    reschedule();
}

std::uint8_t Card::in(std::uint8_t port) {
    begin();
    const std::uint8_t value = peek(port);
    if (port == ports::DATA) access(Work::in_data, port, 0);
    if (port == ports::RST) reset();
    return value;
}

std::uint8_t Card::peek(std::uint8_t port) const {
    if (port == ports::DATA) return state_.firmware.latch;
    return port == ports::STAT ? status() : 0xFF;
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
            state_.reset_pulse_end = kernel_.now() + reset_pulse;
            pins_.set(rst_pin, 1);
            return reset();
        default:
            return;
    }
}

std::uint8_t Card::status() const {
    const Firmware& f = state_.firmware;
    unsigned out = pins_.inputs();
    if (f.ready) out |= stat::READY;
    if (events_.pending()) out |= stat::EVENT;
    if (pins_.level(interrupt_pin) != 0) out |= stat::INT;
    return static_cast<std::uint8_t>(out);
}

}  // namespace motionrack::databoard4002
