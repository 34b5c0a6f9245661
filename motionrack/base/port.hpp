// Interfaces of a driver to a card: registers, byte ports and an interrupt line. A driver uses only these, so it works
// with a virtual card as with a real one.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>

namespace motionrack {

/// A 16-bit register bus. Offsets are byte offsets as in the card's map. Write one access per statement: a read may
/// have side effects, and compilers differ in the order of arguments.
class RegisterPort {
  public:
    virtual ~RegisterPort() = default;
    virtual void write(std::uint32_t offset, std::uint16_t value) = 0;
    virtual std::uint16_t read(std::uint32_t offset) = 0;
};

/// An 8-bit port space, as the IN and OUT instructions of an 8-bit host access it.
class BytePort {
  public:
    virtual ~BytePort() = default;
    virtual void out(std::uint8_t port, std::uint8_t value) = 0;
    virtual std::uint8_t in(std::uint8_t port) = 0;
};

/// Interrupt line of a card and passage of time, as a host sees them. On a virtual card a wait runs the simulation; on
/// a real one it sleeps.
class Interrupt {
  public:
    virtual ~Interrupt() = default;
    /// Waits until the line is active or `timeout` has passed (`never`: without limit); returns true if the line is
    /// active.
    virtual bool wait(Duration timeout) = 0;
    /// Waits for `duration`, independent of the line.
    virtual void pass(Duration duration) = 0;
    /// The host's clock.
    virtual Instant now() const = 0;
    /// True once the user has requested a stop; a waiting driver then stops the motion and returns.
    virtual bool stop_requested() const { return false; }
};

}  // namespace motionrack
