// Chips that a process has open through mcx314lib.h, and the selected one.
//
//   MOTIONRACK_RACK ─┐
//   mcx314_open ─────┴─► Chip 1 ─ Driver ─ Manual x4 ─┐
//                        Chip 2 ─ Driver ─ Manual x4 ─┴─► one VirtualRack (a rack and its time), or one each
//                        Chip 3 ─ Driver ─ Manual x4 ───► live::CardPort: a real card and the computer's time
#pragma once

#include <array>
#include <map>
#include <memory>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/cards/mcx314/driver/manual.hpp>
#include <motionrack/frontends/mcx314lib/virtual_rack.hpp>
#include <motionrack/live/card_port.hpp>

namespace motionrack::mcx314lib {

/// An open card with its driver.
class OpenChip {
  public:
    OpenChip(std::shared_ptr<VirtualRack> in, VirtualCard& on)
        : rack(std::move(in)), card(&on), driver(on.registers(), on.interrupt()) {}
    explicit OpenChip(std::unique_ptr<live::CardPort> port) : live(std::move(port)), driver(*live, *live) {}

    Instant now() { return driver.interrupt().now(); }
    /// Errors: io, for the first access that the computer refused.
    Result<void> check_live() const;
    /// Returns the virtual card. Errors: refused if the card is real.
    Result<VirtualCard*> virtual_card(const char* what) const;
    mcx314::Manual& manual(int channel) { return manuals[static_cast<std::size_t>(channel)]; }
    /// Polls the manual operations; returns true if one is running.
    bool step();

    std::unique_ptr<live::CardPort> live;  ///< real card only
    std::shared_ptr<VirtualRack> rack;     ///< virtual card only, with `card`
    VirtualCard* card = nullptr;
    mcx314::Driver driver;
    std::array<mcx314::Manual, 4> manuals{{{driver, 0}, {driver, 1}, {driver, 2}, {driver, 3}}};
    unsigned home_axes = mcx314::axis_x;
};

class ChipTable {
  public:
    /// See mcx314_open; a null rack or card selects the default.
    Result<int> open(const char* rack, const char* card);
    Result<void> select(int handle);
    Result<void> close(int handle);
    /// Returns the selected chip. If no chip is open, opens the rack of the environment variable MOTIONRACK_RACK.
    Result<OpenChip*> selected();
    /// Advances the rack of `chip`; polls the manual operations of all its chips every millisecond.
    Result<void> pass(OpenChip& chip, Duration duration);

  private:
    Result<void> check_open(int handle) const;
    std::string handles() const;
    bool is_open(const VirtualCard& card) const;
    Result<int> open_live(const char* text, const char* card);
    int keep(std::unique_ptr<OpenChip> chip);
    /// Polls the manual operations of all chips in the rack of `chip`; returns true if one is running.
    bool step_all_beside(OpenChip& chip);

    std::map<int, std::unique_ptr<OpenChip>> chips_;
    int selected_ = 0;  // 0: none
    int last_ = 0;
};

}  // namespace motionrack::mcx314lib
