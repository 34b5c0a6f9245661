// Base addresses, and address conflicts of two cards.
#include <algorithm>
#include <motionrack/cards/ioflex02/model/bus.hpp>

namespace motionrack::ioflex02 {

namespace {

bool answers(const Card& card, std::uint32_t address) {
    return address >= card.settings().base_address && address - card.settings().base_address < window;
}

}  // namespace

Bus::Bus(sim::Kernel& kernel, const std::string& name)
    : kernel_(kernel),
      id_(kernel.add(*this, sim::Phase::wires, name + ".bus")),
      interrupt_(kernel.add_wire(name + ".bus.int", 1)) {}

void Bus::report_conflict(std::uint32_t address) {
    std::size_t first = cards_.size(), here = 0;
    for (std::size_t i = cards_.size(); i-- > 0;)
        if (answers(*cards_[i], address)) first = i, ++here;
    const std::uint64_t bit = std::uint64_t{1} << std::min<std::size_t>(first, 63);
    if (here < 2 || (state_.reported & bit) != 0) return;
    state_.reported |= bit;
    kernel_.report(id_, static_cast<std::uint16_t>(CardCondition::address_conflict),
                   cards_[first]->settings().base_address);
}

std::uint16_t Bus::read(std::uint32_t address) {
    report_conflict(address);
    unsigned out = no_answer;
    for (Card* card : cards_)
        if (answers(*card, address)) out &= card->read(address - card->settings().base_address);
    return static_cast<std::uint16_t>(out);
}

std::uint16_t Bus::peek(std::uint32_t address) const {
    unsigned out = no_answer;
    for (const Card* card : cards_)
        if (answers(*card, address)) out &= card->peek(address - card->settings().base_address);
    return static_cast<std::uint16_t>(out);
}

void Bus::write(std::uint32_t address, std::uint16_t value) {
    report_conflict(address);
    for (Card* card : cards_)
        if (answers(*card, address)) card->write(address - card->settings().base_address, value);
}

}  // namespace motionrack::ioflex02
