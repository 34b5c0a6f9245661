// A card as its host bus sees it: 16-bit register access with and without side effects.
#pragma once

#include <cstdint>

namespace motionrack::sim {

class RegisterDevice {
  public:
    virtual ~RegisterDevice() = default;
    virtual std::uint16_t read(std::uint32_t offset) = 0;
    virtual void write(std::uint32_t offset, std::uint16_t value) = 0;
    /// Result of read without side effects: for inspectors and traces.
    virtual std::uint16_t peek(std::uint32_t offset) const = 0;
};

}  // namespace motionrack::sim
