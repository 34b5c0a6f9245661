// The chip on an 8-bit bus: sixteen ports, and 16-bit register access through the ports for a host's library.
//
//   port   0    1    2    3    4    5   ..   14    15
//   write  WR0L WR0H WR1L WR1H WR2L WR2H     WR7L  WR7H      WR0H is stored, WR0L executes the command
//   read   RR0L RR0H RR1L RR1H RR2L RR2H     RR7L  RR7H      a byte of RR3 clears that byte's flags
#pragma once

#include <motionrack/base/port.hpp>
#include <motionrack/cards/mcx314/chip/chip.hpp>

namespace motionrack::mcx314 {

class ByteBus final : public BytePort, public sim::RegisterDevice {
  public:
    explicit ByteBus(Chip& chip) : chip_(chip) {}

    void out(std::uint8_t port, std::uint8_t value) override { chip_.write_byte(port & 15u, value); }
    std::uint8_t in(std::uint8_t port) override { return chip_.read_byte(port & 15u); }

    /// Writes the high byte, then the low byte, at the same instant.
    void write(std::uint32_t offset, std::uint16_t value) override {
        chip_.write_byte(offset + 1, static_cast<std::uint8_t>(value >> 8));
        chip_.write_byte(offset, static_cast<std::uint8_t>(value));
    }
    /// Reads the low byte, then the high byte, at the same instant.
    std::uint16_t read(std::uint32_t offset) override {
        const unsigned low = chip_.read_byte(offset);
        return static_cast<std::uint16_t>(low | static_cast<unsigned>(chip_.read_byte(offset + 1)) << 8);
    }
    std::uint16_t peek(std::uint32_t offset) const override { return chip_.peek(offset); }

  private:
    Chip& chip_;
};

}  // namespace motionrack::mcx314
