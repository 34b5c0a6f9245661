// The bus of the IOFLEX02 cards: each answers in 100h bytes from its base address.
//
//   host ── address ──► 2300h .. 23FFh: card "c1"     2400h .. 24FFh: card "c2"     elsewhere: no card, reads FFFFh
//
// Two cards at one address both accept writes; their answers are ANDed on the wires, as with open collectors.
#pragma once

#include <cstdint>
#include <motionrack/cards/ioflex02/model/card.hpp>
#include <string>
#include <vector>

namespace motionrack::ioflex02 {

class Bus final : public sim::Device, public sim::RegisterDevice {
  public:
    /// Adds the bus and its wire "<name>.bus.int" to the kernel. These cards have no interrupt, so it is always 1
    /// (inactive).
    Bus(sim::Kernel& kernel, const std::string& name);
    /// Adds a card, whose settings contain its address; before the kernel starts.
    void plug(Card& card) { cards_.push_back(&card); }

    /// An address is the card's base address plus the offset of a register.
    std::uint16_t read(std::uint32_t address) override;
    void write(std::uint32_t address, std::uint16_t value) override;
    std::uint16_t peek(std::uint32_t address) const override;

    sim::DeviceId id() const { return id_; }
    sim::WireId interrupt_wire() const { return interrupt_; }

    void on_scheduled(Instant) override {}
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    struct State {
        std::uint64_t reported =
            0;  ///< bit n: the conflict of the n-th card (bit 63: of all further cards) was reported
    };
    void report_conflict(std::uint32_t address);

    sim::Kernel& kernel_;
    sim::DeviceId id_{};
    sim::WireId interrupt_{};
    std::vector<Card*> cards_;
    State state_;
};

}  // namespace motionrack::ioflex02
