// The bus of the IOFLEX02 cards: each answers in 100h bytes from its base address.
//
//   host ── address ──► 2300h .. 23FFh: card "c1"     2400h .. 24FFh: card "c2"     elsewhere: nobody, reads FFFFh
//
// Two cards at one address both listen; what they say is and-ed on the wires, as it is with open collectors.
#pragma once

#include <cstdint>
#include <motionrack/cards/ioflex02/model/card.hpp>
#include <string>
#include <vector>

namespace motionrack::ioflex02 {

class Bus final : public sim::Device, public sim::RegisterDevice {
  public:
    /// Adds the bus and its wire "<name>.bus.int" to the kernel; these cards have no interrupt, so it is always 1 (not
    /// active).
    Bus(sim::Kernel& kernel, const std::string& name);
    /// Before the kernel starts; the card has its address in its settings.
    void plug(Card& card) { cards_.push_back(&card); }

    /// Addresses are the card's base address plus a register's offset.
    std::uint16_t read(std::uint32_t address) override;
    void write(std::uint32_t address, std::uint16_t value) override;
    std::uint16_t peek(std::uint32_t address) const override;

    sim::DeviceId id() const { return id_; }
    sim::WireId interrupt_wire() const { return interrupt_; }

    void on_scheduled(Instant) override {}
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    struct State {
        std::uint64_t told = 0;  ///< bit n: the conflict of the n-th card (from the 64th on: of all those) was reported
    };
    void tell_conflict(std::uint32_t address);

    sim::Kernel& kernel_;
    sim::DeviceId id_{};
    sim::WireId interrupt_{};
    std::vector<Card*> cards_;
    State state_;
};

}  // namespace motionrack::ioflex02
