// Port of a real card with registers of 16 bits, for its driver: mapped memory or I/O ports. The same driver runs on a
// virtual card.
//
//   driver ──► CardPort ──► LivePort ──► the computer's bus
#pragma once

#include <memory>
#include <motionrack/base/card_map.hpp>
#include <motionrack/live/live_port.hpp>
#include <vector>

namespace motionrack::live {

class CardPort final : public RegisterPort, public LivePort {
  public:
    /// Errors: invalid_input, an odd offset or stride.
    static Result<void> check(const PortSpec& spec);
    /// Opens a port without an access. `map` gives the extent of the card's registers; each is 16 bits wide. Errors:
    /// as check() and LivePort::open_parts.
    static Result<std::unique_ptr<CardPort>> open(const PortSpec& spec, const CardMap& map,
                                                  std::unique_ptr<Clock> clock = nullptr);

    /// One access, at least PortSpec::gap after the previous one. `offset`: of a register in the card's map.
    void write(std::uint32_t offset, std::uint16_t value) override;
    /// Returns FFFFh, as from an empty slot, if the computer refused an access; see trouble(). Where the card gives
    /// FFFFh, reads its other registers until one differs; if none does, no card answers, and that is trouble().
    std::uint16_t read(std::uint32_t offset) override;
    /// Reads the registers that reading does not change until one is not FFFFh. Errors: io if none is, or as trouble().
    Result<void> check_answers();

  private:
    CardPort(Parts parts, const PortSpec& spec, const CardMap& map, std::uint32_t last);
    bool begin_access_at(std::uint32_t offset);
    std::uint16_t read_word(std::uint32_t offset);

    std::uint32_t stride_;
    std::uint32_t last_;                ///< offset of the last register
    std::vector<std::uint32_t> quiet_;  ///< offsets of the registers that reading does not change
};

}  // namespace motionrack::live
