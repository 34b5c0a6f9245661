// Executes the sequence S0 .. S12 of a card, step by step, and ends frames.
#include <algorithm>
#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <motionrack/cards/grating_bus/model/card.hpp>

namespace motionrack::grating_bus {

/// Actions of the card when a state begins. after() gives the order of the states, LineOutputs their levels.
struct Card::SequenceActions {
    static void first_word(Card& card, Instant) { card.frames_.set_word(0); }
    static void next_word(Card& card, Instant) { card.frames_.set_word(card.frames_.word() + 1); }
    static void ask(Card& card, Instant) { card.state_.asks = 1; }
    static void publish(Card& card, Instant now) { card.publish(now, nullptr); }

    static constexpr void (*actions[])(Card&, Instant) = {
        first_word, nullptr,    ///< S0, S1
        ask,        nullptr,    ///< S2, S3
        nullptr,    nullptr,    ///< S4, S5
        nullptr,    next_word,  ///< S6, S7
        ask,        nullptr,    ///< S8, S9
        nullptr,    nullptr,    ///< S10, S11
        publish                 ///< S12
    };
    static_assert(std::size(actions) == std::size(map::states));
};

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
    if (takes && !read_off) frames_.put(address, lines.level(Line::data));
    if (!settings_.verify_lines) return;
    const bool clock_wrong = is_host() && lines.level(Line::clk) != lines_.clk();
    const bool line_wrong = clock_wrong || (takes ? lines.level(Line::hold) == 0 : !read_off);
    if (!takes) {
        if (line_wrong) frames_.spoil(line_faults, bad_lines);
        return;
    }
    frames_.begin_check();
    const auto wanted = static_cast<std::uint32_t>(settings_.address(frames_.word()));
    if (read_off) return frames_.spoil(missed_words, bad_missed);
    if (is_host() ? address != wanted : !frames_.add_address(address)) return frames_.spoil(alien, bad_alien);
    if (line_wrong) frames_.spoil(line_faults, bad_lines);
    if (address == wanted) return;
    // A slave takes the words that the host addresses, and notes a scale that differs from its own list.
    frames_.note_other();
}

void Card::advance(Instant now) {
    if (state_.off != 0) {  // pulses keep their period while the card is off
        if (pulses_.next() == now) pulses_.advance();
        return age_.check(now);
    }
    if (state_.state_ends == now) enter(after(state_.fsm, frames_.word() + 1 < settings_.scales), now);
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
    frames_.begin(now, pulses_.sequence());
    report_begin(now);
    enter(after(state_.fsm, true), now);
}

void Card::enter(State state, Instant now) {
    const State before = state_.fsm;
    state_.fsm = state;
    state_.state_ends = state == State::S0 ? never : now + time_in(settings_.timing, state);
    lines_.enter(state);
    if (const auto action = SequenceActions::actions[static_cast<int>(state)]; action != nullptr) action(*this, now);
    if (before != state) wires_.show(state_.fsm);
}

// ---- frames

void Card::publish(Instant now, const Frame* like) {
    if (frames_.finish(like)) hand_out(now, frames_.time());
}

void Card::hand_out(Instant now, Instant since) {
    const Frame& frame = frames_.publish();
    age_.renew(frame.sequence, since);
    wires_.set_fresh(true);
    for (FrameListener* listener : listeners_) listener->published(*this, frame, now);
}

void Card::take(const Frame& frame, Instant now) {
    MOTIONRACK_ASSERT(is_remote());
    if (off()) return;
    Frame& own = frames_.begin_remote();
    if (!sound(frame) || frame.words != static_cast<std::uint32_t>(settings_.scales)) {
        frames_.give_up(frame.sequence, bad_content);
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
        frames_.begin(start, pulses_.sequence());
        const bool sampled =
            m.state != State::S1 && m.state != State::S2 && m.state != State::S7 && m.state != State::S8;
        frames_.put_words(latched, m.word + (sampled ? 1 : 0));
    }
    state_.fsm = m.state;
    frames_.set_word(m.word);
    state_.state_ends = start + m.until;
    lines_.take(outputs_of(m, settings_));
}

Moment Card::moment() const {
    if (bus_.in_span() && !is_remote() && state_.fsm == State::S0 && state_.off == 0)
        return moment_of(settings_.timing, settings_.scales, kernel_.now() - bus_.span_start());
    return {state_.fsm, frames_.word(), state_.state_ends - frames_.time()};
}

}  // namespace motionrack::grating_bus
