// Value and source of the counter, its rate limit, its lines.
#include <algorithm>
#include <motionrack/cards/databoard4002/model/position_counter.hpp>

namespace motionrack::databoard4002 {

namespace {

constexpr std::int64_t half_turn = std::int64_t{1} << 23, whole_turn = std::int64_t{1} << 24;

std::int64_t turn_of(std::int64_t counter) {
    return (counter + half_turn) >> 24;
}

}  // namespace

PositionCounter::PositionCounter(const sim::Kernel& kernel, CounterState& state, std::int64_t& turn,
                                 const Settings& settings, const ConditionReporter& conditions, PassSchedule& passes,
                                 Pins& pins)
    : kernel_(kernel),
      state_(state),
      turn_(turn),
      settings_(settings),
      conditions_(conditions),
      passes_(passes),
      pins_(pins) {
    state_.closed = settings.counting == Counting::quadrature
                        ? sim::ClosedFormCounter(settings.folding, false, settings.first_pair)
                        : sim::ClosedFormCounter();
}

void PositionCounter::connect(sim::PositionFunction& counts, sim::PositionListener& card) {
    MOTIONRACK_ASSERT(encoder_ == nullptr);
    encoder_ = &counts;
    encoder_slot_ = counts.add_listener(card);
}

void PositionCounter::begin() {
    for (const Pin pin : {o1_pin, o2_pin}) {
        pins_.subscribe(pin, !connected());
        OutputLine& line = state_.lines[static_cast<std::size_t>(pin)];
        line.raw = line.taken = pins_.level(pin) != 0;
    }
}

std::int64_t PositionCounter::value(Instant t) const {
    if (!connected() || state_.frozen) return state_.count;
    return state_.closed.value(*encoder_, t);
}

void PositionCounter::zero(Instant now) {
    state_.count = 0;
    if (encoder_) state_.closed.set(0, *encoder_, now);
    turn_ = 0;
}

void PositionCounter::watch(sim::Range range) {
    if (!encoder_) return;
    if (state_.frozen || state_.cut)
        clear_watch();
    else
        state_.closed.watch(*encoder_, encoder_slot_, range.below, range.above);
}

void PositionCounter::take(bool taken, Instant now) {
    const std::int64_t count = encoder_->count(now), present = value(now);
    // With up and down pulses, both lines are idle between two pulses.
    const unsigned levels = settings_.counting == Counting::quadrature ? sim::lines_of(count) : 0;
    state_.count = present;
    state_.frozen = 0;
    state_.cut = taken;
    for (const Pin pin : {o1_pin, o2_pin}) {
        const auto i = static_cast<std::size_t>(pin);
        const bool level = (levels >> i & 1) != 0;
        state_.lines[i] = {};
        state_.lines[i].raw = state_.lines[i].taken = level;
        pins_.subscribe(pin, taken);
        if (taken)
            pins_.force(pin, level);
        else
            pins_.release(pin);
    }
    if (!taken) state_.closed.set(present, *encoder_, now);
}

// ---- the interval of 2^24 counts

sim::Range PositionCounter::turn_range() const {
    return {turn_ * whole_turn - half_turn - 1, (turn_ + 1) * whole_turn - half_turn};
}

void PositionCounter::note_turn(Instant now) {
    const std::int64_t u = value(now), turn = turn_of(u);
    if (turn == turn_) return;
    turn_ = turn;
    conditions_.report(CardCondition::position_wrapped, u);
}

// ---- the rate limit of a motion

bool PositionCounter::too_quick(double rate) const {
    const double counts = rate < 0 ? -rate : rate;
    return (settings_.counting == Counting::quadrature ? counts / 4 : counts) > limit_hz();
}

bool PositionCounter::rate_changed(double rate, Instant now) {
    CounterState& c = state_;
    const bool quick = too_quick(rate);
    if (c.cut || quick == (c.frozen != 0)) return false;
    const std::int64_t count = encoder_->count(now);
    if (quick) {
        c.count = value(now);
        c.frozen_from = count;
        c.frozen = 1;
        conditions_.report(CardCondition::rate_exceeded, static_cast<std::int64_t>((rate < 0 ? -rate : rate) + 0.5));
    } else {
        c.frozen = 0;
        conditions_.report(CardCondition::counts_lost,
                           c.closed.from_motion(count) - c.closed.from_motion(c.frozen_from));
        c.closed.set(c.count, *encoder_, now);
    }
    return true;
}

// ---- lines driven as wires

void PositionCounter::line_changed(int line, int level, Instant now) {
    OutputLine& l = state_.lines[static_cast<std::size_t>(line)];
    if (connected() || l.raw == (level != 0)) return;
    if (l.changes > 0 && l.free_at <= now) look_at_lines(now);
    l.raw = level != 0;
    if (now < l.free_at)
        ++l.changes;
    else
        take_line(line, now);
}

void PositionCounter::look_at_lines(Instant now) {
    for (int i = 0; i < 2; ++i) {
        OutputLine& l = state_.lines[static_cast<std::size_t>(i)];
        if (l.changes == 0 || l.free_at > now) continue;
        if (l.changes > 1) conditions_.report(CardCondition::line_too_quick, i + 1);
        l.changes = 0;
        if (l.raw != l.taken) take_line(i, l.free_at);
    }
}

Instant PositionCounter::next() const {
    Instant out = never;
    for (const OutputLine& line : state_.lines)
        if (line.changes > 0) out = std::min(out, line.free_at);
    return out;
}

/// Counts the level of the line; for half a period of the rate limit, the line is then ignored.
void PositionCounter::take_line(int line, Instant at) {
    auto& lines = state_.lines;
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
    state_.count += change;
    if (change != 0) passes_.request(kernel_.now());
}

}  // namespace motionrack::databoard4002
