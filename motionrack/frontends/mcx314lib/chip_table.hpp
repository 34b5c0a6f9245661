// The chips that a process has open through mcx314lib.h, and which of them is selected.
//
//   MOTIONRACK_RACK ─┐
//   mcx314_open ─────┴─► Chip 1 ─ Driver ─ Manual x4 ─┐
//                        Chip 2 ─ Driver ─ Manual x4 ─┴─► one World (a rack and its time), or one each
//                        Chip 3 ─ Driver ─ Manual x4 ───► live::CardPort: a real card and the computer's time
#pragma once

#include <array>
#include <map>
#include <memory>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/cards/mcx314/driver/manual.hpp>
#include <motionrack/frontends/mcx314lib/world.hpp>
#include <motionrack/live/card_port.hpp>

namespace motionrack::mcx314lib {

/// An open card with its library.
class Chip {
  public:
    Chip(std::shared_ptr<World> in, VirtualCard& on)
        : world(std::move(in)), card(&on), driver(on.registers(), on.interrupt()) {}
    explicit Chip(std::unique_ptr<live::CardPort> port) : live(std::move(port)), driver(*live, *live) {}

    Instant now() { return driver.interrupt().now(); }
    /// Errors: io, the first access that the computer refused.
    Result<void> check_live() const;
    /// Of its rack. Errors: refused where the card is a real one.
    Result<VirtualCard*> virtual_card(const char* what) const;
    mcx314::Manual& manual(int channel) { return manuals[static_cast<std::size_t>(channel)]; }
    /// Lets manual operations look; true if one goes on.
    bool step();

    std::unique_ptr<live::CardPort> live;  ///< of a real card
    std::shared_ptr<World> world;          ///< of a virtual one, with `card`
    VirtualCard* card = nullptr;
    mcx314::Driver driver;
    std::array<mcx314::Manual, 4> manuals{{{driver, 0}, {driver, 1}, {driver, 2}, {driver, 3}}};
    unsigned home_axes = mcx314::axis_x;
};

class Bench {
  public:
    /// See mcx314_open; a null rack or card is left open.
    Result<int> open(const char* rack, const char* card);
    Result<void> select(int handle);
    Result<void> close(int handle);
    /// The selected chip; without any chip the rack of the environment variable MOTIONRACK_RACK is opened.
    Result<Chip*> selected();
    /// Lets time pass in the world of `chip`; manual operations of all its chips look every millisecond.
    Result<void> pass(Chip& chip, Duration duration);

  private:
    Result<void> check_open(int handle) const;
    std::string handles() const;
    bool is_open(const VirtualCard& card) const;
    Result<int> open_live(const char* text, const char* card);
    int keep(std::unique_ptr<Chip> chip);
    /// Lets the manual operations of all chips in the world of `chip` look; true if one goes on.
    bool step_all_beside(Chip& chip);

    std::map<int, std::unique_ptr<Chip>> chips_;
    int selected_ = 0;  // 0: none
    int last_ = 0;
};

}  // namespace motionrack::mcx314lib
