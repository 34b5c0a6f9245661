// The twin's lines, their drivers, and its decoders.
#include <algorithm>
#include <motionrack/cards/grating_bus/test/twin.hpp>

namespace motionrack::grating_bus::twin {

/// Returns true if card or decoder number `driver` drives `line`, and sets `level`.
bool Twin::drives(int driver, Line line, std::uint32_t& level) const {
    const int cards = static_cast<int>(cards_.size());
    if (driver >= cards) {
        const Decoder& decoder = decoders_[static_cast<std::size_t>(driver - cards)];
        level = decoder.drives;
        return line == data && decoder.answers;
    }
    const Card& card = cards_[static_cast<std::size_t>(driver)];
    if (card.off || card.silent || line == data) return false;
    if (!(line == addr ? card.settings.address_out : card.settings.clock_out)) return false;
    if (line == clk) level = card.own_clock ? 1 : 0;
    if (line == hold) level = card.hold_pin;
    if (line == read_n) level = card.read_pin;
    if (line == addr) level = card.address_pin;
    return true;
}

void Twin::take_levels(Line line) {
    std::uint32_t level = rest[line], driven = 0;
    bool first = true;
    for (int driver = 0; driver < static_cast<int>(cards_.size() + decoders_.size()); ++driver) {
        if (!drives(driver, line, driven)) continue;
        level = first ? driven : level & driven;
        first = false;
    }
    if (const auto whole = forced_.find({line, -1}); whole != forced_.end()) level = whole->second;
    for (int bit = 0; bit < width[line]; ++bit)
        if (const auto held = forced_.find({line, bit}); held != forced_.end())
            level = (level & ~(1u << bit)) | held->second << bit;
    if (level != levels_[line]) changes_.push_back({now_, line, level});
    levels_[line] = level;
}

void Twin::note_conflicts(Line line) {
    std::uint32_t driven = 0, some_high = 0, some_low = 0;
    for (int driver = 0; driver < static_cast<int>(cards_.size() + decoders_.size()); ++driver)
        if (drives(driver, line, driven)) some_high |= driven, some_low |= ~driven;
    for (int bit = 0; bit < width[line]; ++bit) {
        if (!(some_high & some_low & 1u << bit) && !lasting_.count({line, bit})) continue;
        std::set<int> high, low;
        for (int driver = 0; driver < static_cast<int>(cards_.size() + decoders_.size()); ++driver)
            if (drives(driver, line, driven)) ((driven >> bit & 1) ? high : low).insert(driver);
        const bool differ = !high.empty() && !low.empty();
        const auto old = lasting_.find({line, bit});
        if (old != lasting_.end()) {
            Conflict& conflict = conflicts_[old->second];
            if (differ && conflict.high == high && conflict.low == low) continue;
            conflict.end = now_;
            lasting_.erase(old);
        }
        if (!differ) continue;
        lasting_[{line, bit}] = conflicts_.size();
        conflicts_.push_back({now_, lasting, line, bit, high, low});
    }
}

/// Returns the instant at which the decoder outputs the requested count; never if it has output it, or none is
/// requested.
Ticks Twin::ready_at(const Decoder& decoder) const {
    if (levels_[read_n] != 0 || decoder.put_out || levels_[addr] >= static_cast<std::uint32_t>(decoder.settings.scales))
        return nothing_due;
    Ticks last = std::max(decoder.read_fell, decoder.address_changed);
    if (decoder.latched) last = std::max(last, decoder.valid_at);
    return last + decoder.settings.output;
}

void Twin::decode(Decoder& decoder) {
    if (decoder.seen[hold] == 0 && levels_[hold] == 1 && !decoder.no_latch) {
        for (int scale = 0; scale < decoder.settings.scales; ++scale)
            decoder.taken[static_cast<std::size_t>(scale)] = decoder.settings.count(scale, now_);
        decoder.latched = true;
        decoder.valid_at = now_ + decoder.settings.latch;
        decoder.put_out = false;
    }
    if (levels_[hold] == 0) decoder.latched = false;
    if (decoder.seen[read_n] == 1 && levels_[read_n] == 0) {
        decoder.read_fell = now_;
        decoder.put_out = false;
    }
    if (decoder.seen[addr] != levels_[addr]) {
        decoder.address_changed = now_;
        decoder.put_out = false;
    }
    decoder.seen = levels_;
    if (ready_at(decoder) <= now_) {
        const int scale = static_cast<int>(levels_[addr]);
        decoder.drives =
            decoder.latched ? decoder.taken[static_cast<std::size_t>(scale)] : decoder.settings.count(scale, now_);
        decoder.put_out = true;
    }
    decoder.answers = levels_[read_n] == 0 && levels_[addr] < static_cast<std::uint32_t>(decoder.settings.scales);
}

}  // namespace motionrack::grating_bus::twin
