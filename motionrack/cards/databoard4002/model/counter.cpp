// The counter: in closed form for a connected motion, edge by edge for the wires o1 and o2.
#include <motionrack/cards/databoard4002/model/card.hpp>

namespace motionrack::databoard4002 {

void Card::connect_encoder(sim::PositionFunction& counts) {
    MOTIONRACK_ASSERT(encoder_ == nullptr && !state_.begun);
    encoder_ = &counts;
    encoder_slot_ = counts.add_listener(*this);
}

std::int64_t Card::counter(Instant t) const {
    if (!connected() || state_.counter.frozen) return state_.counter.count;
    return state_.counter.closed.value(*encoder_, t);
}

void Card::set_counter(std::int64_t value, Instant now) {
    state_.counter.count = value;
    if (encoder_) state_.counter.closed.set(value, *encoder_, now);
}

void Card::watch_counter(std::int64_t below, std::int64_t above) {
    if (!encoder_) return;  // every counted edge requests a pass
    if (state_.counter.frozen || state_.counter.cut)
        encoder_->watch(encoder_slot_, sim::unwatched_below, sim::unwatched_above);
    else
        state_.counter.closed.watch(*encoder_, encoder_slot_, below, above);
}

void Card::crossed(Instant now) {
    encoder_->watch(encoder_slot_, sim::unwatched_below, sim::unwatched_above);
    passes_.request(now);
    reschedule();
}

void Card::take_encoder(bool taken) {
    CounterState& c = state_.counter;
    if (!encoder_ || taken == (c.cut != 0)) return;
    begin();
    const Instant now = kernel_.now();
    const std::int64_t count = encoder_->count(now), value = counter(now);
    // With up and down pulses, both lines are idle between two pulses.
    const unsigned levels = settings_.counting == Counting::quadrature ? sim::lines_of(count) : 0;
    c.count = value;
    c.frozen = 0;
    c.cut = taken;
    for (std::size_t i = 0; i < 2; ++i) {
        const bool level = (levels >> i & 1) != 0;
        c.lines[i] = {};
        c.lines[i].raw = c.lines[i].taken = level;
        const Pin pin = i == 0 ? o1_pin : o2_pin;
        pins_.subscribe(pin, taken);
        if (taken)
            pins_.force(pin, level);
        else
            pins_.release(pin);
    }
    if (!taken) {
        c.closed.set(value, *encoder_, now);
        rate_changed(0, encoder_->rate(now), now);
    }
    passes_.request(now);
    reschedule();
}

// ---- the rate limit of a motion

bool Card::too_quick(double rate) const {
    const double counts = rate < 0 ? -rate : rate;
    return (settings_.counting == Counting::quadrature ? counts / 4 : counts) > limit_hz();
}

void Card::rate_changed(double, double rate, Instant now) {
    CounterState& c = state_.counter;
    const bool quick = too_quick(rate);
    if (c.cut || quick == (c.frozen != 0)) return;
    const std::int64_t count = encoder_->count(now);
    if (quick) {
        c.count = counter(now);
        c.frozen_from = count;
        c.frozen = 1;
        conditions_.report(CardCondition::rate_exceeded, static_cast<std::int64_t>((rate < 0 ? -rate : rate) + 0.5));
    } else {
        c.frozen = 0;
        conditions_.report(CardCondition::counts_lost,
                           c.closed.from_motion(count) - c.closed.from_motion(c.frozen_from));
        c.closed.set(c.count, *encoder_, now);
    }
    passes_.request(now);
    reschedule();
}

// ---- lines driven as wires

void Card::line_changed(int line, int level, Instant now) {
    OutputLine& l = state_.counter.lines[static_cast<std::size_t>(line)];
    if (connected() || l.raw == (level != 0)) return;
    if (l.changes > 0 && l.free_at <= now) look_at_lines(now);
    l.raw = level != 0;
    if (now < l.free_at)
        ++l.changes;
    else
        take_line(line, now);
}

void Card::look_at_lines(Instant now) {
    for (int i = 0; i < 2; ++i) {
        OutputLine& l = state_.counter.lines[static_cast<std::size_t>(i)];
        if (l.changes == 0 || l.free_at > now) continue;
        if (l.changes > 1) conditions_.report(CardCondition::line_too_quick, i + 1);
        l.changes = 0;
        if (l.raw != l.taken) take_line(i, l.free_at);
    }
}

/// Counts the level of the line; for half a period of the rate limit, the line is then ignored.
void Card::take_line(int line, Instant at) {
    auto& lines = state_.counter.lines;
    const auto before = static_cast<std::uint8_t>(lines[0].taken | lines[1].taken << 1);
    OutputLine& l = lines[static_cast<std::size_t>(line)];
    l.taken = l.raw;
    l.free_at = at + half_period();
    int change = 0;
    if (settings_.counting == Counting::up_down) {
        if (l.taken) change = line == o2_pin ? 1 : -1;
    } else {
        sim::QuadratureDecoder decoder(settings_.folding, before, settings_.first_pair);
        change = decoder.lines(static_cast<std::uint8_t>(lines[0].taken | lines[1].taken << 1));
    }
    state_.counter.count += change;
    if (change != 0) passes_.request(kernel_.now());
}

}  // namespace motionrack::databoard4002
