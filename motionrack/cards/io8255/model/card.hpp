// The virtual IO8255: three ports of 8 lines behind four bus ports (RULES.md).
//
//   OUT_A ──► latch A ──────────────► pa0 .. pa7        PORT_A ◄── [ strobed byte ] ◄── pa0_in .. pa7_in
//   OUT_B ──► latch B ──────────────► pb0 .. pb7        PORT_B ◄── [ strobed byte ] ◄── pb0_in .. pb7_in
//   OUT_C ──► latch C ──┬───────────► pc0 .. pc7        PORT_C ◄──────────────────┬──── pc0_in .. pc7_in
//   BIT ────► INTE ─► handshakes: IBF, OBF, INTR ◄── STB, ACK ────────────────────┘
//                         └─────────► int
//
// The card has no clock: it acts at an access, and at an edge of STB or ACK.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/io8255/model/conditions.hpp>
#include <motionrack/cards/io8255/model/state.hpp>
#include <motionrack/sim/byte_device.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>

namespace motionrack::io8255 {

class Card final : public sim::Device, public sim::ByteDevice {
  public:
    /// Adds the card and its wires "<name>.<pin>" to the kernel.
    Card(sim::Kernel& kernel, const std::string& name);

    // ---- the bus: offsets of the map
    std::uint8_t in(std::uint8_t port) override;
    void out(std::uint8_t port, std::uint8_t value) override;
    std::uint8_t peek(std::uint8_t port) const override;

    /// Sets all outputs that no handshake drives low, without an access of the bus. Each that was high stays low until
    /// the host writes it low, then high. Discards the bytes of strobed outputs, whose lines no stop holds.
    void clear_outputs();

    // ---- inspection
    /// Returns the last control word that set the modes.
    std::uint8_t control_word() const { return static_cast<std::uint8_t>(state_.control); }
    PortModes modes() const { return modes_of(state_.control); }
    sim::DeviceId id() const { return id_; }
    sim::WireId interrupt_wire() const { return wires_.back(); }

    void on_scheduled(Instant) override {}
    void on_wire(int line, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    static constexpr std::size_t line_count = std::size_t{port_count} * lines_of_port;

    std::size_t received(IoPort port, int line) const;
    bool is_high(int line_of_c) const;
    unsigned levels(IoPort port) const;
    bool flag(PortGroup group) const;
    bool requests(PortGroup group) const;
    unsigned byte(PortGroup group) const;
    unsigned port_c() const;
    unsigned driven_c() const;
    void put(IoPort port, unsigned value, unsigned mask);
    void put_byte(PortGroup group, unsigned value);
    void discard_byte(PortGroup group);
    void set_modes(std::uint8_t word);
    void set_bit(std::uint8_t word);
    void strobe(PortGroup group, bool high);
    void drive();
    void report(CardCondition code, std::int64_t a, std::int64_t b = 0);

    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::array<sim::WireId, 2 * line_count + 1> wires_{};
    State state_{};
};

}  // namespace motionrack::io8255
