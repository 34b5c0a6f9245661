// The DataBoard bus: OUT 1 selects one of up to 32 cards; the others ignore all accesses.
//
//   host ── OUT 1 ──► selected number               card 13 ── int ──┐
//        ── OUT 0, 2..5, INP 0, 1 ──► that card    card 14 ── int ──┴─► BUS.int (1 while a card requests)
//        ◄───────────────────── csb ── that card
//        ── INP 7 ──► all cards
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/databoard4002/model/card.hpp>
#include <string>
#include <vector>

namespace motionrack::databoard4002 {

class Bus final : public sim::Device, public sim::ByteDevice {
  public:
    static constexpr std::size_t max_cards = 32;

    /// Adds the bus and its wire "<name>.int" to the kernel.
    Bus(sim::Kernel& kernel, const std::string& name);
    /// Puts a card on the bus under a unique number; before the kernel starts.
    void plug(Card& card, std::uint8_t select);

    /// Reads a port of the selected card; returns FFh if no card answers.
    std::uint8_t in(std::uint8_t port) override;
    void out(std::uint8_t port, std::uint8_t value) override;
    std::uint8_t peek(std::uint8_t port) const override;

    sim::DeviceId id() const { return id_; }
    sim::WireId interrupt_wire() const { return interrupt_; }

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    struct AddressSlot {
        Card* card = nullptr;
        std::uint8_t select = 0;
        sim::WireId csb{};  ///< the card's wire csb: 1 while the card is selected
    };
    struct State {
        std::int32_t chosen = -1;  ///< the number written to port 1; -1: none yet
    };
    Card* chosen() const;

    sim::Kernel& kernel_;
    sim::DeviceId id_{};
    sim::WireId interrupt_{};
    std::vector<AddressSlot> slots_;
    State state_;
};

}  // namespace motionrack::databoard4002
