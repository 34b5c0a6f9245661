// Processes a whole frame as one step.
#include <algorithm>
#include <motionrack/cards/grating_bus/model/bus.hpp>

namespace motionrack::grating_bus {

/// Returns true if a frame that begins now is undisturbed and unobserved.
bool Bus::regular() const {
    if (!alike_ || state_.wanted != 0 || state_.lines.any_forced() || decoders_[0]->state_.no_latch != 0) return false;
    for (const Card* card : cards_) {
        const CardState& s = card->state_;
        if (s.off != 0 || s.late != Duration{0} || s.miss != 0) return false;
        if (state_.span == 0 && !card->idle()) return false;
    }
    const Card& first = *cards_[static_cast<std::size_t>(host_)];
    const Instant next_period = first.pulses_.grid() + host().period;
    if (first.pulses_.next() + host().timing.frame_time(host().scales) >= next_period)
        return false;  // the next pulse may come before the frame ends
    return state_.span != 0 || (state_.lines.level(Line::clk) == 0 && !first.lines_.quiet());
}

void Bus::begin_span(Instant now) {
    decoders_[0]->latch(now);
    state_.span = 1;
    state_.published = 0;
    state_.start = now;
    state_.done = now + host().timing.frame_time(host().scales) - host().timing.clock;
    for (Card* card : cards_) {
        card->age_.check(now);
        if (card->is_remote()) continue;
        card->lines_.wake();
        card->pulses_.note_edge(now);
        if (card->is_host()) card->pulses_.advance();
        card->report_begin(now);
    }
}

void Bus::publish_span(Instant now) {
    const Frame* like = nullptr;
    Decoder::State& decoder = decoders_[0]->state_;
    for (Card* card : cards_) {
        if (card->is_remote()) continue;
        card->frames_.begin(state_.start, card->pulses_.sequence());
        card->frames_.put_words(decoder.latched, host().scales);
        card->publish(now, like);
        like = card->last();
    }
    decoder.out = decoder.latched[static_cast<std::size_t>(host().address(host().scales - 1))];
    state_.published = 1;
}

Bus::DecoderOutput Bus::span_output(Instant now) const {
    const Decoder& decoder = *decoders_[0];
    const BusTiming& timing = host().timing;
    const Instant first = state_.start + timing.t1 + decoder.settings().output;  // instant of word 0
    if (now < first) return {decoder.state_.out, first};
    const auto words = std::min<std::int64_t>(host().scales, (now - first) / timing.word_time() + 1);
    const std::uint32_t out =
        decoder.state_.latched[static_cast<std::size_t>(host().address(static_cast<int>(words) - 1))];
    return {out, words < host().scales ? first + words * timing.word_time() : never};
}

std::uint32_t Bus::span_level(Line line, Instant now) const {
    const Duration elapsed = now - state_.start;
    if (line == Line::clk) return elapsed < host().period / 2;
    const Outputs outputs = outputs_of(moment_of(host().timing, host().scales, elapsed), host());
    if (line == Line::hold) return outputs.hold;
    if (line == Line::read_n) return outputs.read_n;
    if (line == Line::addr) return outputs.addr;
    return outputs.read_n == 0 ? span_output(now).out : rest_of(Line::data);
}

void Bus::interrupt_span(Instant now) {
    if (state_.span == 0) return;
    if (state_.published == 0 && now >= state_.done) publish_span(now);
    Decoder& decoder = *decoders_[0];
    const DecoderOutput output = span_output(now);
    const Outputs lines = outputs_of(moment_of(host().timing, host().scales, now - state_.start), host());
    decoder.state_.out = output.out;
    decoder.state_.valid = state_.start + decoder.settings().latch;
    const Duration since = std::max(Duration{0}, now - state_.start - host().timing.t1);  // since the first address
    const std::int64_t word = std::min<std::int64_t>(since / host().timing.word_time(), host().scales - 1);
    decoder.state_.asked = state_.start + host().timing.t1 + word * host().timing.word_time();
    const bool owes = lines.read_n == 0 && output.next == decoder.state_.asked + decoder.settings().output;
    decoder.state_.output = owes ? output.next : never;
    decoder.state_.hold = decoder.state_.frozen = lines.hold;
    decoder.state_.read_n = lines.read_n, decoder.state_.addr = lines.addr;
    state_.clk_was = span_level(Line::clk, now);
    state_.span = 0;
    Card& first = *cards_[static_cast<std::size_t>(host_)];
    first.lines_.set_clk(state_.clk_was);
    first.pulses_.set_fall(state_.clk_was != 0 ? state_.start + host().period / 2 : never);
    for (std::size_t i = 0; i < cards_.size(); ++i) {
        cards_[i]->take_up(state_.start, decoder.state_.latched, now);
        cards_[i]->drive(state_.lines, card_driver_[i]);
    }
    if (lines.read_n == 0)
        state_.lines.drive(Line::data, decoder_driver_[0], output.out);
    else
        state_.lines.leave(Line::data, decoder_driver_[0]);
    state_.lines.settle();
    schedule();
}

}  // namespace motionrack::grating_bus
