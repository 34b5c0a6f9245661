// What a driver talks to: registers, byte ports and an interrupt line. A driver cannot tell a virtual card from a real
// one, because this is all it ever sees.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>

namespace motionrack {

/// A 16-bit register bus. Offsets are byte offsets as in the card's map; one access a statement, because a read may
/// have effects and the order of arguments is not the same on every compiler.
class RegisterPort {
  public:
    virtual ~RegisterPort() = default;
    virtual void write(std::uint32_t offset, std::uint16_t value) = 0;
    virtual std::uint16_t read(std::uint32_t offset) = 0;
};

/// An 8-bit port space, as the IN and OUT instructions of an 8-bit host see it.
class BytePort {
  public:
    virtual ~BytePort() = default;
    virtual void out(std::uint8_t port, std::uint8_t value) = 0;
    virtual std::uint8_t in(std::uint8_t port) = 0;
};

/// The interrupt line of a card and the passing of time, as a host sees them. On a virtual card waiting lets the world
/// run; on a real one it sleeps.
class Interrupt {
  public:
    virtual ~Interrupt() = default;
    /// Waits until the line is active or `timeout` has passed (`never`: however long it takes); true if the line is
    /// active.
    virtual bool wait(Duration timeout) = 0;
    /// Lets `duration` pass, whatever the line does.
    virtual void pass(Duration duration) = 0;
    /// The host's clock.
    virtual Instant now() const = 0;
    /// True once the user asked to stop; a driver in a waiting loop then stops the motion and returns.
    virtual bool stop_requested() const { return false; }
};

}  // namespace motionrack
