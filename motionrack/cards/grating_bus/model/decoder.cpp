// Latches the counts of a decoder and outputs them on the bus.
#include <algorithm>
#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <motionrack/cards/grating_bus/model/decoder.hpp>

namespace motionrack::grating_bus {

Decoder::Decoder(sim::Kernel& kernel, const std::string& name, Bus& bus, const DecoderSettings& settings)
    : kernel_(kernel), settings_(settings), bus_(bus), id_(kernel.add(*this, sim::Phase::cards, name)) {
    MOTIONRACK_ASSERT(check(settings).has_value());
    for (int n = 0; n < settings.scales; ++n)
        for (const int line : {0, 1})
            kernel.listen(kernel.add_wire(name + (line == 0 ? ".a" : ".b") + std::to_string(n), 0), id_, 2 * n + line);
    int_wire_ = kernel.add_wire(name + ".int_n", 1);
    bus.plug(*this);
}

std::int64_t Decoder::position(int n, Instant now) const {
    const auto at = static_cast<std::size_t>(n);
    return scales_[at] ? scales_[at]->count(now) : state_.counters[at].count();
}

void Decoder::on_wire(int pin, int level, Instant) {
    const auto at = static_cast<std::size_t>(pin / 2);
    const unsigned bit = 1u << (pin % 2);
    std::uint32_t& lines = state_.lines[at];
    lines = level != 0 ? lines | bit : lines & ~bit;
    state_.counters[at].lines(static_cast<std::uint8_t>(lines));
}

void Decoder::latch(Instant now) {
    for (int n = 0; n < settings_.scales; ++n) state_.latched[static_cast<std::size_t>(n)] = count(n, now);
}

/// Sets the instant at which the decoder outputs the addressed count; never for an address without a scale.
void Decoder::ask(Instant now) {
    const Instant from = state_.frozen != 0 ? std::max(state_.asked, state_.valid) : state_.asked;
    state_.output = answers(state_.addr) ? std::max(now, from + settings_.output) : never;
}

void Decoder::follow(Lines& lines, int driver, Instant now) {
    State& s = state_;
    const std::uint32_t hold = lines.level(Line::hold), read_n = lines.level(Line::read_n),
                        addr = lines.level(Line::addr);
    const bool rose = hold != 0 && s.hold == 0, fell = hold == 0 && s.hold != 0;
    const bool asked = read_n == 0 && (s.read_n != 0 || addr != s.addr);
    s.hold = hold, s.read_n = read_n, s.addr = addr;
    if (asked) s.asked = now;
    if (rose && s.no_latch == 0) {
        latch(now);
        s.valid = now + settings_.latch;
        s.frozen = 1;
    }
    if (fell) s.frozen = 0;
    if (read_n != 0 || !answers(addr)) {
        s.output = never;
        lines.leave(Line::data, driver);
        return;
    }
    if (asked || (rose && s.frozen != 0) || (fell && s.output != never)) ask(now);
    if (s.output <= now) {
        s.output = never;
        s.out = s.frozen != 0 ? s.latched[addr] : count(static_cast<int>(addr), now);
    }
    lines.drive(Line::data, driver, s.out);
}

// ---- the host's bus

std::uint16_t Decoder::peek(std::uint32_t at) const {
    if (is_count(at))
        return static_cast<std::uint16_t>(at % 4 != 0 ? state_.high
                                                      : count(static_cast<int>(at - counts_at) / 4, kernel_.now()));
    if (at == decoder_offset("SIGNATURE")) return decoder_signature;
    if (at == decoder_offset("SCALES")) return static_cast<std::uint16_t>(settings_.scales);
    return 0xFFFF;
}

std::uint16_t Decoder::read(std::uint32_t at) {
    if (is_count(at) && at % 4 == 0) state_.high = count(static_cast<int>(at - counts_at) / 4, kernel_.now()) >> 16;
    if (!is_count(at) && at > decoder_offset("SCALES"))
        kernel_.report(id_, static_cast<std::uint16_t>(BusCondition::no_register), at, -1);
    return peek(at);
}

void Decoder::write(std::uint32_t at, std::uint16_t value) {
    kernel_.report(id_, static_cast<std::uint16_t>(BusCondition::no_register), at, value);
}

bool Decoder::fault(std::string_view name, double value, Instant now) {
    if (name != "no_latch") return false;
    bus_.interrupt_span(now);
    state_.no_latch = value != 0 ? 1 : 0;
    bus_.look_again(now);
    return true;
}

}  // namespace motionrack::grating_bus
