// Card select, and the common interrupt line.
#include <motionrack/cards/databoard4002/model/bus.hpp>

namespace motionrack::databoard4002 {

Bus::Bus(sim::Kernel& kernel, const std::string& name)
    : kernel_(kernel),
      id_(kernel.add(*this, sim::Phase::wires, name + ".bus")),
      interrupt_(kernel.add_wire(name + ".bus.int", 0)) {}

void Bus::plug(Card& card, std::uint8_t select) {
    MOTIONRACK_ASSERT(slots_.size() < max_cards);
    for (const AddressSlot& slot : slots_) MOTIONRACK_ASSERT(slot.select != select);
    kernel_.listen(card.interrupt_wire(), id_, static_cast<int>(slots_.size()));
    slots_.push_back({&card, select, kernel_.find_wire(kernel_.device_name(card.id()) + ".csb")});
}

Card* Bus::chosen() const {
    for (const AddressSlot& slot : slots_)
        if (slot.select == state_.chosen) return slot.card;
    return nullptr;
}

std::uint8_t Bus::in(std::uint8_t port) {
    if (port == ports::RST) {
        for (const AddressSlot& slot : slots_) (void)slot.card->in(port);
        return 0xFF;
    }
    Card* card = chosen();
    return card ? card->in(port) : 0xFF;
}

std::uint8_t Bus::peek(std::uint8_t port) const {
    const Card* card = chosen();
    return card ? card->peek(port) : 0xFF;
}

void Bus::out(std::uint8_t port, std::uint8_t value) {
    if (port == ports::CS) {
        state_.chosen = value;
        for (const AddressSlot& slot : slots_) kernel_.set_wire(slot.csb, slot.select == value);
        return;
    }
    if (Card* card = chosen()) card->out(port, value);
}

void Bus::on_scheduled(Instant now) {
    on_wire(0, 0, now);
}

void Bus::on_wire(int, int, Instant) {
    bool asked = false;
    for (const AddressSlot& slot : slots_) asked = asked || kernel_.level(slot.card->interrupt_wire()) != 0;
    kernel_.set_wire(interrupt_, asked);
}

}  // namespace motionrack::databoard4002
