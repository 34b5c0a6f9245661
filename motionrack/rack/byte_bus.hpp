// The bus of cards with 8-bit ports.
#pragma once

#include <cstdint>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <span>

namespace motionrack::rack {

/// A card whose bus is its byte port. `Base`: Card or MotionCard.
template <class Base>
class ByteBusCard : public Base {
  public:
    std::span<const int> bus_widths() const final {
        static constexpr int bytes[] = {8};
        return bytes;
    }
    std::uint32_t bus_read(int, std::uint32_t address) final {
        return byte_port()->in(static_cast<std::uint8_t>(address));
    }
    void bus_write(int, std::uint32_t address, std::uint32_t value) final {
        byte_port()->out(static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(value));
    }
    sim::VirtualHost& host() final { return *byte_port(); }
    /// Returns its port, never nullptr.
    sim::VirtualBytePort* byte_port() override = 0;
};

}  // namespace motionrack::rack
