// Samples the position once a period, and puts each sample's word on the wires after the transmission delay.
#include <algorithm>
#include <cmath>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/serial_word_source.hpp>

namespace motionrack::parts {

namespace {

constexpr double ticks_per_us = 10'000;

}  // namespace

SerialWordSource::SerialWordSource(sim::Kernel& kernel, const std::string& name, const std::string& wires,
                                   const SerialPositionSource& sender)
    : kernel_(kernel),
      sender_(sender),
      period_ticks_(sender.settings().period_us * ticks_per_us),
      delay_(static_cast<std::int64_t>(std::floor(sender.settings().delay_us * ticks_per_us + 0.5))),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      word_wire_(kernel.add_wire(wires + ".mcbsp", 0, 32)),
      frame_wire_(kernel.add_wire(wires + ".mcbsp_frame", 0)) {
    MOTIONRACK_ASSERT(sender.settings().delay_us <
                      static_cast<double>(max_under_way - 1) * sender.settings().period_us);
    schedule();
}

Instant SerialWordSource::reading(std::int64_t n) const {
    return Instant{static_cast<std::int64_t>(std::floor(static_cast<double>(n) * period_ticks_ + 0.5))};
}

void SerialWordSource::schedule() {
    const Instant sending = state_.sent < state_.read ? reading(state_.sent) + delay_ : never;
    kernel_.schedule(id_, std::min(reading(state_.read), sending));
}

void SerialWordSource::on_scheduled(Instant now) {
    State& s = state_;
    const auto position = [](std::int64_t n) { return static_cast<std::size_t>(n % max_under_way); };
    if (reading(s.read) <= now) {
        s.words[position(s.read)] = sender_.word_at(to_seconds(now));
        ++s.read;
    }
    while (s.sent < s.read && reading(s.sent) + delay_ <= now) {
        const std::int64_t word = s.words[position(s.sent++)];
        if (s.silent) continue;
        if (word == s.word) s.frame = !s.frame;
        s.word = word;
        kernel_.set_wire(word_wire_, static_cast<std::int32_t>(static_cast<std::uint32_t>(word)));
        kernel_.set_wire(frame_wire_, static_cast<int>(s.frame));
    }
    schedule();
}

bool SerialWordSource::fault(std::string_view name, double value, Instant) {
    if (name != "sender.silent") return false;
    state_.silent = value != 0;
    return true;
}

}  // namespace motionrack::parts
