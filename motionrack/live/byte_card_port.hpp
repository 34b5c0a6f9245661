// Port of a real card with ports of 8 bits (DataBoard 4002), for its driver: mapped memory or I/O ports. The same
// driver runs on a virtual card.
//
//   driver ──► ByteCardPort ──► LivePort ──► the computer's bus
#pragma once

#include <memory>
#include <motionrack/base/card_map.hpp>
#include <motionrack/live/live_port.hpp>

namespace motionrack::live {

class ByteCardPort final : public BytePort, public LivePort {
  public:
    /// Opens a port without an access. `map` gives the highest port of the card; its registers are 8 bits wide. Ports
    /// are PortSpec::stride bytes apart, 1 by default; PortSpec::width has no meaning. Errors: refused (registers of
    /// another width), or as LivePort::open_parts.
    static Result<std::unique_ptr<ByteCardPort>> open(const PortSpec& spec, const CardMap& map,
                                                      std::unique_ptr<Clock> clock = nullptr);

    /// One access, at least PortSpec::gap after the previous one. `port`: 0 to the highest of the card's map.
    void out(std::uint8_t port, std::uint8_t value) override;
    /// Returns FFh, as from an empty slot, if the computer refused an access; see trouble().
    std::uint8_t in(std::uint8_t port) override;

  private:
    ByteCardPort(Parts parts, const PortSpec& spec, std::uint32_t last);

    std::uint32_t stride_;
    std::uint32_t last_;  ///< highest port
};

}  // namespace motionrack::live
