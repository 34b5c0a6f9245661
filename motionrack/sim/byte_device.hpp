// A card as an 8-bit host sees it: port access with and without side effects.
#pragma once

#include <cstdint>

namespace motionrack::sim {

class ByteDevice {
  public:
    virtual ~ByteDevice() = default;
    virtual std::uint8_t in(std::uint8_t port) = 0;
    virtual void out(std::uint8_t port, std::uint8_t value) = 0;
    /// Result of in without side effects: for inspectors and traces.
    virtual std::uint8_t peek(std::uint8_t port) const = 0;
};

}  // namespace motionrack::sim
