// The motion cards of the twin and its time loop; its lines and decoders are in twin_lines.cpp.
#include <algorithm>
#include <motionrack/cards/grating_bus/test/twin.hpp>

namespace motionrack::grating_bus::twin {

namespace {

void count_up(std::uint32_t& counter, std::int64_t by = 1) {
    counter = static_cast<std::uint32_t>(std::min<std::int64_t>(0xFFFF, counter + by));
}

}  // namespace

Twin::Twin(std::vector<CardSettings> cards, std::vector<DecoderSettings> decoders, bool every_tick)
    : every_tick_(every_tick) {
    for (CardSettings& settings : cards) {
        Card card;
        card.settings = std::move(settings);
        card.states.push_back({0, 0});
        cards_.push_back(std::move(card));
    }
    for (DecoderSettings& settings : decoders) {
        Decoder decoder;
        decoder.settings = std::move(settings);
        decoder.taken.resize(static_cast<std::size_t>(decoder.settings.scales));
        decoders_.push_back(std::move(decoder));
    }
}

// ---- time

void Twin::run_to(Ticks until) {
    while (now_ < until) {
        const Ticks next = now_ < 0 ? 0 : every_tick_ ? now_ + 1 : next_instant();
        if (next > until) break;
        now_ = next;
        instant();
    }
    now_ = std::max(now_, until);
}

Ticks Twin::next_instant() const {
    Ticks next = nothing_due;
    const auto may_be = [&](Ticks at) {
        if (at > now_) next = std::min(next, at);
    };
    for (const Card& card : cards_) {
        if (card.settings.host) may_be(card.settings.offset + card.next_period * card.settings.period);
        may_be(card.pulse_at);
        may_be(card.clock_falls);
        may_be(card.start_at);
        may_be(card.leaves_at);
        if (card.last_time != none) may_be(card.last_time + 2 * card.settings.period);
    }
    for (const Decoder& decoder : decoders_) may_be(ready_at(decoder));
    return next;
}

void Twin::instant() {
    before_ = levels_;
    for (Card& card : cards_) {
        card.own_clock_before = card.own_clock;
        while (card.leaves_at == now_) leave(card);
        if (card.settings.host) own_clock(card);
        if (card.start_at == now_) start(card);
    }
    settle();
    for (Card& card : cards_) look_at_age(card);
}

/// Sets the levels of the lines and lets edges act; repeats this while it changes driven lines.
void Twin::settle() {
    for (bool again = true; again;) {
        const Levels old = levels_;
        for (const Line line : {clk, hold, read_n, addr}) take_levels(line);
        again = levels_ != old;
        for (Card& card : cards_) {
            if (!card.asks) continue;
            card.asks = false;
            if (levels_[read_n] == 0) card.address_pin = card.settings.address(card.word);
            again = true;
        }
        if (old[clk] == 0 && levels_[clk] == 1)
            for (Card& card : cards_)
                if (!card.settings.host) edge(card);
    }
    for (Decoder& decoder : decoders_) decode(decoder);
    take_levels(data);
    for (int line = 0; line < line_count; ++line) note_conflicts(static_cast<Line>(line));
}

// ---- the host's clock, the slave's edges

void Twin::own_clock(Card& card) {
    const CardSettings& s = card.settings;
    if (card.clock_falls == now_) {
        card.own_clock = false;
        card.clock_falls = nothing_due;
    }
    if (now_ == s.offset + card.next_period * s.period) {
        card.pulse_at = now_ + (card.jitter_most > 0 ? s.jitter(card.next_period, card.jitter_most) : 0);
        ++card.next_period;
    }
    if (card.pulse_at == now_) {
        card.pulse_at = nothing_due;
        if (!card.off) pulse(card);
    }
}

void Twin::pulse(Card& card) {
    card.own_clock = true;
    card.clock_falls = now_ + card.settings.period / 2;
    card.silent = false;
    if (card.seen_one) ++card.sequence;
    card.seen_one = true;
    if (card.state == 0)
        start(card);
    else
        count_up(card.counters.overrun);
}

void Twin::edge(Card& card) {
    if (card.off) return;
    if (card.miss_edges > 0) {
        --card.miss_edges;
        return;
    }
    card.silent = false;
    if (card.seen_one) {
        const Ticks elapsed = now_ - card.last_edge, period = card.settings.period;
        const std::int64_t d = std::max<std::int64_t>(1, (elapsed + period / 2) / period);
        card.sequence += static_cast<std::uint32_t>(d);
        count_up(card.counters.missed_edges, d - 1);
    }
    card.seen_one = true;
    card.last_edge = now_;
    if (card.state != 0 || card.start_at != nothing_due) {
        count_up(card.counters.overrun);
    } else if (card.late > 0) {
        card.start_at = now_ + card.late;
    } else {
        start(card);
    }
}

// ---- one frame

void Twin::start(Card& card) {
    card.start_at = nothing_due;
    card.frame_time = now_;
    card.frame_sequence = card.sequence;
    card.word = 0;
    card.frame_bad = false;
    card.taken.clear();
    if (card.claimed != none)
        card.filling = 1 - card.claimed;
    else
        card.filling = card.published == none ? 0 : 1 - card.published;
    enter(card, 1);
}

Ticks Twin::duration(const Card& card) const {
    const CardSettings& s = card.settings;
    switch (card.state) {
        case 1:
        case 7:
            return s.t1;
        case 2:
        case 8:
            return s.t2;
        case 3:
        case 9:
            return s.t3;
        default:
            return s.clock;
    }
}

/// Handles the end of a state.
void Twin::leave(Card& card) {
    switch (card.state) {
        case 4:
            return enter(card, 5);
        case 5:
            return enter(card, card.word == card.settings.words ? 11 : 6);
        case 10:
            return enter(card, 5);
        case 12:
            return enter(card, 0);
        default:
            return enter(card, card.state + 1);
    }
}

void Twin::enter(Card& card, int state) {
    card.state = state;
    card.states.push_back({now_, state});
    card.leaves_at = state == 0 ? nothing_due : now_ + duration(card);
    const bool drives = card.settings.host;
    switch (state) {
        case 0:
            if (drives) card.hold_pin = 0, card.address_pin = rest[addr];
            break;
        case 1:
            if (drives) card.hold_pin = 1;
            break;
        case 2:
        case 8:
            if (drives) card.read_pin = 0, card.asks = true;
            break;
        case 3:
        case 9:
            sample(card);
            break;
        case 4:
        case 10:
            if (drives) card.read_pin = 1;
            break;
        case 5:
            check_read_ended(card);
            ++card.word;
            break;
        case 12:
            finish(card);
            break;
        default:
            break;
    }
}

void Twin::bad_word(Card& card, std::uint32_t& counter) {
    if (!card.word_bad) count_up(counter);
    card.word_bad = card.frame_bad = true;
}

void Twin::sample(Card& card) {
    card.word_bad = false;
    Frame& frame = card.buffer[static_cast<std::size_t>(card.filling)];
    const auto word = static_cast<std::size_t>(card.word);
    if (before_[read_n] == 0) {
        frame.counts[word] = before_[data];
        frame.addresses[word] = static_cast<std::uint8_t>(before_[addr]);
    }
    if (!card.settings.verify_lines) return;
    if (before_[read_n] != 0) return bad_word(card, card.counters.missed_words);
    const bool wanted = before_[addr] == card.settings.address(card.word);
    const bool takes = card.settings.host ? wanted : card.taken.insert(before_[addr]).second;
    if (!takes) return bad_word(card, card.counters.alien);
    if (before_[hold] != 1 || (card.settings.host && before_[clk] != (card.own_clock_before ? 1u : 0u)))
        bad_word(card, card.counters.lines);
    if (!wanted) count_up(card.counters.alien);
}

void Twin::check_read_ended(Card& card) {
    if (!card.settings.verify_lines) return;
    if (before_[read_n] != 1 || (card.settings.host && before_[clk] != (card.own_clock_before ? 1u : 0u)))
        bad_word(card, card.counters.lines);
}

void Twin::finish(Card& card) {
    if (card.frame_bad) {
        count_up(card.counters.broken);
        if (!card.row_bad) card.broken_rows.push_back(now_);
        card.row_bad = true;
        abandon(card);
    } else {
        card.row_bad = false;
        Frame& frame = card.buffer[static_cast<std::size_t>(card.filling)];
        frame.sequence = card.frame_sequence;
        frame.time = card.frame_time;
        frame.words = static_cast<std::uint32_t>(card.settings.words);
        frame.crc = crc_of(frame);
        card.published = card.filling;
        card.filling = none;
        card.last_time = card.frame_time;
        card.fresh = true;
        card.frames.push_back({now_, frame});
        ++card.counters.frames;
    }
}

/// Abandons the buffer being filled. If it held the frame published last, the older claimed frame becomes that one.
void Twin::abandon(Card& card) {
    if (card.filling != none && card.filling == card.published) card.published = card.claimed;
    card.filling = none;
}

void Twin::look_at_age(Card& card) {
    const bool stale = card.last_time == none || now_ >= card.last_time + 2 * card.settings.period;
    if (stale == card.stale) return;
    card.stale = stale;
    card.stale_changes.push_back({now_, stale});
}

// ---- from outside

void Twin::reset(int number) {
    if (cards_[number].off) return;
    begin_anew(cards_[number]);
    settle();
}

void Twin::begin_anew(Card& card) {
    if (card.state != 0) card.states.push_back({now_, 0});
    card.state = 0;
    card.leaves_at = card.start_at = card.clock_falls = nothing_due;
    card.own_clock = card.own_clock_before = card.asks = false;
    card.hold_pin = 0, card.read_pin = 1, card.address_pin = rest[addr];
    abandon(card);
    card.silent = true;
    card.seen_one = card.row_bad = false;
    card.sequence = 0;
    card.counters = {};
}

void Twin::set_off(int number, bool off) {
    Card& card = cards_[number];
    if (off == card.off) return;
    card.off = off;
    begin_anew(card);
    settle();
}

void Twin::claim(int number) {
    Card& card = cards_[number];
    card.fresh = false;
    if (card.published != none && card.published != card.filling) card.claimed = card.published;
}

Frame Twin::claimed_frame(int number) const {
    const Card& card = cards_[number];
    return card.claimed == none ? Frame{} : card.buffer[static_cast<std::size_t>(card.claimed)];
}

void Twin::clear_errors(int number) {
    Counters& counters = cards_[number].counters;
    const std::uint32_t frames = counters.frames;
    counters = {};
    counters.frames = frames;
}

void Twin::force(Line line, int bit, std::uint32_t level) {
    forced_[{line, bit}] = level;
    settle();
}

void Twin::release(Line line, int bit) {
    forced_.erase({line, bit});
    settle();
}

}  // namespace motionrack::grating_bus::twin
