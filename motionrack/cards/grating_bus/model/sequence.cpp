// The sequence S0 .. S12 of a card, step by step, and the end of a frame.
#include <algorithm>
#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <motionrack/cards/grating_bus/model/card.hpp>

namespace motionrack::grating_bus {

namespace {

void put_word(Frame& frame, int k, std::uint32_t address, std::uint32_t count) {
    frame.counts[static_cast<std::size_t>(k)] = count;
    frame.addresses[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(address);
}

}  // namespace

Instant Card::next() const {
    if (state_.off != 0) return std::min(pulses_.next(), age_.next());
    return std::min(std::min(std::min(state_.state_ends, state_.starts), std::min(pulses_.next(), pulses_.fall())),
                    age_.next());
}

// ---- the order of an instant: sample, advance, clock_rose

void Card::sample(const Lines& lines, Instant now) {
    if (state_.state_ends != now) return;
    const bool takes = state_.fsm == State::S2 || state_.fsm == State::S8;
    if (!takes && state_.fsm != State::S4 && state_.fsm != State::S10) return;
    const bool read_off = lines.level(Line::read_n) != 0;
    const std::uint32_t address = lines.level(Line::addr);
    if (takes && !read_off) put_word(state_.buffers.current(), state_.word, address, lines.level(Line::data));
    if (!settings_.verify_lines) return;
    const bool clock_wrong = is_host() && lines.level(Line::clk) != lines_.clk();
    const bool line_wrong = clock_wrong || (takes ? lines.level(Line::hold) == 0 : !read_off);
    if (!takes) {
        if (line_wrong) spoil(line_faults, bad_lines);
        return;
    }
    state_.bad_word = 0;
    const auto wanted = static_cast<std::uint32_t>(settings_.address(state_.word));
    if (read_off) return spoil(missed_words, bad_missed);
    if (is_host() ? address != wanted : !state_.taken.add(address)) return spoil(alien, bad_alien);
    if (line_wrong) spoil(line_faults, bad_lines);
    if (address == wanted) return;
    // A slave takes the words that the host addresses, and counts a scale that differs from its own list.
    errors_.count(alien);
    if (state_.other == 0) state_.other = static_cast<std::uint16_t>(1 + state_.word);
}

/// Counts the present word as bad, once.
void Card::spoil(ErrorCounter why, std::uint8_t bad) {
    if (state_.bad_word == 0) errors_.count(why);
    state_.bad_word = 1;
    state_.bad |= bad;
}

void Card::advance(Instant now) {
    if (state_.off != 0) {  // pulses keep their period
        if (pulses_.next() == now) pulses_.advance();
        return age_.check(now);
    }
    if (state_.state_ends == now) enter(after(state_.fsm, state_.word + 1 < settings_.scales), now);
    if (state_.starts == now) begin(now);
    if (pulses_.fall() == now) lines_.set_clk(0), pulses_.set_fall(never);
    if (pulses_.next() == now) pulse(now);
    age_.check(now);
}

void Card::clock_rose(Instant now) {
    if (settings_.role != CardRole::slave || state_.off != 0) return;
    if (state_.miss != 0) {
        --state_.miss;
        return;
    }
    lines_.wake();
    pulses_.note_edge(now);
    if (!idle()) return errors_.count_overrun(pulses_.sequence());
    if (state_.late == Duration{0}) return begin(now);
    state_.starts = now + state_.late;
}

void Card::pulse(Instant now) {
    lines_.wake();
    lines_.set_clk(1);
    pulses_.set_fall(now + settings_.period / 2);
    pulses_.note_edge(now);
    pulses_.advance();
    if (!idle()) return errors_.count_overrun(pulses_.sequence());
    begin(now);
}

void Card::begin(Instant now) {
    state_.starts = never;
    begin_frame(now);
    report_begin(now);
    enter(State::S1, now);
}

void Card::begin_frame(Instant now) {
    state_.frame_time = now;
    state_.frame_sequence = pulses_.sequence();
    state_.word = 0;
    state_.bad = 0;
    state_.bad_word = 0;
    state_.other = 0;
    state_.taken = {};
    state_.buffers.begin();
}

void Card::enter(State state, Instant now) {
    const State before = state_.fsm;
    state_.fsm = state;
    state_.state_ends = state == State::S0 ? never : now + time_in(settings_.timing, state);
    lines_.enter(state);
    switch (state) {
        case State::S0:
            state_.word = 0;
            break;
        case State::S7:
            ++state_.word;
            break;
        case State::S2:
        case State::S8:
            state_.asks = 1;
            break;
        case State::S12:
            publish(now, nullptr);
            break;
        default:
            break;
    }
    if (before != state) show();
}

// ---- frames

/// Takes the first `words` words from the decoder's latch.
void Card::put_words(const Latched& latched, int words) {
    for (int k = 0; k < words; ++k) {
        const auto address = static_cast<std::uint32_t>(settings_.address(k));
        put_word(state_.buffers.current(), k, address, latched[address]);
        state_.taken.add(address);
    }
}

/// `like`: a frame with the same counts and a known CRC, or nullptr.
void Card::publish(Instant now, const Frame* like) {
    if (state_.bad != 0) return give_up(state_.frame_sequence, state_.bad);
    Frame& frame = state_.buffers.current();
    frame.time = state_.frame_time.count();
    frame.sequence = state_.frame_sequence;
    frame.words = static_cast<std::uint32_t>(settings_.scales);
    const bool known =
        like && like->sequence == frame.sequence && like->time == frame.time && like->words == frame.words;
    frame.crc = known ? like->crc : crc_of(frame);
    if (state_.other != 0 && state_.was_other == 0) {
        const int word = state_.other - 1;
        const std::int64_t address = frame.addresses[static_cast<std::size_t>(word)];
        errors_.report(BusCondition::other_scale, word, address << 8 | settings_.address(word));
    }
    state_.was_other = state_.other;
    hand_out(now, state_.frame_time);
}

void Card::give_up(std::uint32_t sequence, std::uint8_t why) {
    state_.buffers.abandon();
    errors_.count(broken);
    if (state_.was_bad == 0) errors_.report(BusCondition::bad_frame, sequence, why);
    state_.was_bad = 1;
}

void Card::hand_out(Instant now, Instant since) {
    const Frame& frame = state_.buffers.current();
    state_.was_bad = 0;
    state_.buffers.publish();
    ++state_.frames;
    age_.renew(frame.sequence, since);
    set_fresh(true);
    for (FrameListener* listener : listeners_) listener->published(*this, frame, now);
}

void Card::take(const Frame& frame, Instant now) {
    MOTIONRACK_ASSERT(is_remote());
    if (off()) return;
    Frame& own = state_.buffers.begin();
    if (!sound(frame) || frame.words != static_cast<std::uint32_t>(settings_.scales)) {
        give_up(frame.sequence, bad_content);
    } else {
        own = frame;
        hand_out(now, now);
    }
    bus_.look_again(now);
}

// ---- whole frames

void Card::take_up(Instant start, const Latched& latched, Instant now) {
    const Moment m = moment_of(settings_.timing, settings_.scales, now - start);
    if (m.state == State::S0 || is_remote()) return;
    if (m.state != State::S12) {
        begin_frame(start);
        const bool sampled =
            m.state != State::S1 && m.state != State::S2 && m.state != State::S7 && m.state != State::S8;
        put_words(latched, m.word + (sampled ? 1 : 0));
    }
    state_.fsm = m.state;
    state_.word = m.word;
    state_.state_ends = start + m.until;
    lines_.take(outputs_of(m, settings_));
}

Moment Card::moment() const {
    if (bus_.in_span() && !is_remote() && state_.fsm == State::S0 && state_.off == 0)
        return moment_of(settings_.timing, settings_.scales, kernel_.now() - bus_.span_start());
    return {state_.fsm, state_.word, state_.state_ends - state_.frame_time};
}

}  // namespace motionrack::grating_bus
