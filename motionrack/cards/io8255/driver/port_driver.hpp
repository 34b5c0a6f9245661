// The card's function library: modes, bytes, lines, and bytes with a handshake. It accesses the card only through byte
// ports, so it works with a virtual card as with a real one.
//
//   send:     INTR? ─► OUT_A ─► OBF low ─► the peripheral takes the byte: ACK ─► INTR
//   receive:  the peripheral strobes a byte: STB ─► INTR? ─► PORT_A
#pragma once

#include <cstdint>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/io8255/map.hpp>

namespace motionrack::io8255 {

class PortDriver {
  public:
    /// `poll`: > 0, interval between two reads of the status while it waits for a peripheral.
    PortDriver(BytePort& port, Interrupt& host, Duration poll = microseconds(10));

    /// Sets modes and directions: all outputs go low. Interrupts of strobed groups are enabled, because INTR alone
    /// shows that a pulse of STB or ACK is over.
    void set_modes(const PortModes& modes);
    const PortModes& modes() const { return modes_; }

    std::uint8_t read(IoPort port);
    void write(IoPort port, std::uint8_t value);
    /// Sets a line of port C, 0 .. 7.
    void set_line(int line, bool high);

    /// Waits until the peripheral has taken the byte before, and puts out the next one. Errors: refused (the group is
    /// not a strobed output), machine (timeout), stopped.
    Result<void> send(PortGroup group, std::uint8_t value, Duration timeout);
    /// Waits for a byte of the peripheral. Errors: as send.
    Result<std::uint8_t> receive(PortGroup group, Duration timeout);

  private:
    Result<void> check_strobed(PortGroup group, bool input) const;
    /// Waits for INTR.
    Result<void> await_request(PortGroup group, Duration timeout);

    BytePort& port_;
    Interrupt& host_;
    Duration poll_;
    PortModes modes_;
};

}  // namespace motionrack::io8255
