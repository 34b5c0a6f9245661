// Processes the instants of a bus, state by state.
#include <algorithm>
#include <bit>
#include <motionrack/cards/grating_bus/model/bus.hpp>

namespace motionrack::grating_bus {

namespace {

/// The line of a wire of one or more bits, and the bits of the line that the wire shows.
struct Part {
    Line line;
    std::uint32_t mask;
    int shift;
};

constexpr Part part_of(int pin) {
    if (pin < Bus::vector_pins) return {static_cast<Line>(pin), bits_of(static_cast<Line>(pin)), 0};
    if (pin == Bus::conflict_pin) return {Line::clk, 0, 0};  // belongs to no line
    const bool of_addr = pin < Bus::data_pins;
    const Line line = of_addr ? Line::addr : Line::data;
    const int bit = pin - (of_addr ? Bus::addr_pins : Bus::data_pins);
    return {line, 1u << bit, bit};
}

}  // namespace

Bus::Bus(sim::Kernel& kernel, const std::string& name)
    : kernel_(kernel), id_(kernel.add(*this, sim::Phase::cards, name)) {
    for (int pin = 0; pin < pin_count; ++pin) {
        const Part part = part_of(pin);
        const auto at = static_cast<std::size_t>(pin);
        const std::string line(line_types[static_cast<std::size_t>(part.line)].name);
        const std::string wire = pin == conflict_pin ? "conflict"
                                 : pin < vector_pins ? line
                                                     : line + std::to_string(part.shift);
        wire_names_.push_back(name + "." + wire);
        wires_[at] = kernel.add_wire(wire_names_.back(), static_cast<int>(wire_level(pin, Instant{0})),
                                     pin < vector_pins ? line_types[static_cast<std::size_t>(pin)].bits : 1);
        kernel.drive_lazily(wires_[at], id_, pin);
    }
    kernel.schedule(id_, Instant{0});
}

void Bus::plug(Card& card) {
    card_driver_.push_back(static_cast<int>(drivers_.size()));
    drivers_.push_back(card.id());
    cards_.push_back(&card);
    MOTIONRACK_ASSERT(drivers_.size() <= max_drivers);
}

void Bus::plug(Decoder& decoder) {
    decoder_driver_.push_back(static_cast<int>(drivers_.size()));
    drivers_.push_back(decoder.id());
    decoders_.push_back(&decoder);
    MOTIONRACK_ASSERT(drivers_.size() <= max_drivers);
}

const std::string& Bus::driver_name(int n) const {
    return kernel_.device_name(drivers_[static_cast<std::size_t>(n)]);
}

void Bus::begin() {
    state_.begun = 1;
    int hosts = 0;
    for (std::size_t i = 0; i < cards_.size(); ++i)
        if (cards_[i]->is_host()) host_ = ++hosts == 1 ? static_cast<int>(i) : -1;
    alike_ = host_ >= 0 && decoders_.size() == 1;
    for (Card* card : cards_) {
        const CardSettings& s = card->settings();
        if (s.wrong_direction())
            card->errors_.report(BusCondition::wrong_direction, card->is_host(),
                                 (s.clock_out() ? 1 : 0) | (s.address_out() ? 2 : 0));
        if (!alike_ || card->is_remote()) continue;
        alike_ = !s.wrong_direction() && s.same_list(host()) && s.timing == host().timing &&
                 check(s, decoders_[0]->settings()).has_value();
    }
}

// ---- one instant

void Bus::on_scheduled(Instant now) {
    if (state_.begun == 0) begin();
    if (state_.span != 0 && state_.published == 0 && state_.done == now)
        publish_span(now);
    else
        step(now);
    schedule();
}

// Processes one instant in the order of RULES.md: the cards sample, then all outputs change, then edges act.
void Bus::step(Instant now) {
    if (host_ >= 0 && cards_[static_cast<std::size_t>(host_)]->pulses_.next() == now && regular())
        return begin_span(now);
    if (state_.span != 0) interrupt_span(now);
    for (Card* card : cards_) card->sample(state_.lines, now);
    for (Card* card : cards_) card->advance(now);
    settle(now);
}

void Bus::settle(Instant now) {
    drive();
    if (give_addresses()) drive();
    if (state_.lines.level(Line::clk) != 0 && state_.clk_was == 0) {
        for (Card* card : cards_) card->clock_rose(now);
        drive();  // a card in reset drives again from this edge on
    }
    state_.clk_was = state_.lines.level(Line::clk);
    for (std::size_t i = 0; i < decoders_.size(); ++i) decoders_[i]->follow(state_.lines, decoder_driver_[i], now);
    state_.lines.settle();
    const unsigned begun = state_.lines.note_conflicts(now);
    for (std::size_t i = 0; i < line_count; ++i) {
        if ((begun >> i & 1) == 0 || (state_.reported >> i & 1) != 0) continue;
        state_.reported |= 1u << i;
        const Conflict& conflict = state_.lines.conflict(state_.lines.all_conflicts() - 1);
        const int high = std::countr_zero(conflict.high);
        const std::uint64_t others = conflict.low & ~(std::uint64_t{1} << high);  // not the one of `high`, if possible
        kernel_.report(id_, static_cast<std::uint16_t>(BusCondition::conflict), static_cast<std::int64_t>(i),
                       high * max_drivers + std::countr_zero(others != 0 ? others : conflict.low));
    }
    show();
}

void Bus::drive() {
    for (std::size_t i = 0; i < cards_.size(); ++i) cards_[i]->drive(state_.lines, card_driver_[i]);
    state_.lines.settle();
}

bool Bus::give_addresses() {
    bool looked = false;
    for (Card* card : cards_) {
        CardState& s = card->state_;
        if (s.asks == 0) continue;
        s.asks = 0;
        if (!card->is_host()) continue;
        looked = true;
        if (state_.lines.level(Line::read_n) == 0)
            card->lines_.set_address(card->settings().address(card->frames_.word()));
    }
    return looked;
}

void Bus::look_again(Instant now) {
    if (state_.begun == 0) begin();
    if (state_.span == 0) settle(now);
    schedule();
}

void Bus::schedule() {
    Instant next = state_.span != 0 && state_.published == 0 ? state_.done : never;
    if (state_.span != 0) {
        for (const Card* card : cards_) next = std::min(next, std::min(card->pulses_.next(), card->age_.next()));
    } else {
        for (const Card* card : cards_) next = std::min(next, card->next());
        for (const Decoder* decoder : decoders_) next = std::min(next, decoder->state_.output);
    }
    kernel_.schedule(id_, next);
}

// ---- wires

std::uint32_t Bus::level(Line line) const {
    return in_span() ? span_level(line, kernel_.now()) : state_.lines.level(line);
}

std::uint32_t Bus::wire_level(int pin, Instant now) const {
    if (pin == conflict_pin) return state_.lines.conflict() ? 1 : 0;
    const Part part = part_of(pin);
    const std::uint32_t level = in_span() ? span_level(part.line, now) : state_.lines.level(part.line);
    return (level & part.mask) >> part.shift;
}

int Bus::level_at(int pin, Instant now) const {
    return static_cast<int>(wire_level(pin, now));
}

void Bus::show() {
    if (state_.wanted == 0) return;
    for (int pin = 0; pin < pin_count; ++pin) {
        const sim::WireId wire = wires_[static_cast<std::size_t>(pin)];
        if (kernel_.wanted(wire)) kernel_.set_wire(wire, static_cast<int>(wire_level(pin, kernel_.now())));
    }
}

void Bus::wanted_changed(int, bool is_wanted, Instant now) {
    wanted(is_wanted, now);
}

void Bus::wanted(bool is_wanted, Instant now) {
    if (is_wanted) interrupt_span(now);
    state_.wanted = is_wanted ? state_.wanted + 1 : state_.wanted - 1;
}

// Forces the line of a wire that is forced or released. A forced wire of one bit overrides the wire of its whole line.
void Bus::forced_changed(int changed, bool, int, Instant now) {
    if (changed == conflict_pin) return;
    interrupt_span(now);
    const Line line = part_of(changed).line;
    std::uint32_t mask = 0, value = 0;
    for (int pin = 0; pin < pin_count; ++pin) {
        const sim::WireId wire = wires_[static_cast<std::size_t>(pin)];
        const Part part = part_of(pin);
        if (pin == conflict_pin || part.line != line || !kernel_.forced(wire)) continue;
        mask |= part.mask;
        value = (value & ~part.mask) | (static_cast<std::uint32_t>(kernel_.level(wire)) << part.shift & part.mask);
    }
    state_.lines.force(line, mask, value);
    look_again(now);
}

}  // namespace motionrack::grating_bus
