// Manual accesses to the cards' own buses, executed by the motion thread while the machine is at standstill.
//
//   request ──► checked, pending ──step──► checked again ──► bus of the card ──► answer
//                                                                │ a write to a card that moves axes
//                                                                └──► its axes have no valid position; motion that
//                                                                     it starts blocks every start until a stop
//
// Cards that measure and move nothing are accessed while axes move, too, and between the calls of a service. During
// homing and during a call the access waits.
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/base/result.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace motionrack::operate {

class Machine;

/// Used only by the motion thread.
class ManualAccess {
  public:
    struct BusAccess {
        std::string card;
        int bits = 16;                       ///< a width of the card's bus
        std::uint32_t address = 0;           ///< on the host's bus
        std::optional<std::uint32_t> value;  ///< to write; none: read, with side effects
    };
    /// Receives the value read or written. Errors: refused: a stop came before a write was executed.
    using Answered = std::function<void(Result<std::uint32_t>)>;

    explicit ManualAccess(Machine& machine) : machine_(machine) {}

    /// Requests one access. Refused: the machine is not at standstill, the card does not support the access; a write
    /// also while a stop is in force, after Machine::forbid_starts, and, to a card that moves axes, while one of them
    /// is disabled or the door is open.
    Result<void> request(const BusAccess& access, Answered ready);
    bool any() const { return !pending_.empty(); }
    /// Executes the pending accesses; in a service these are of cards that measure only. Virtual time advances
    /// meanwhile, and commands arrive.
    void step();
    /// Returns the letter of an axis that a register write keeps moving; '\0': none. Call at standstill of the machine.
    char moving_axis() const;
    /// Ends that motion without a ramp and returns the cards to the controller. Errors: as Rack::path_axes.
    Result<void> end_motion();

  private:
    Result<void> check_write(const std::string& card) const;
    void execute(const BusAccess& access, const Answered& ready);

    Machine& machine_;
    std::vector<std::pair<BusAccess, Answered>> pending_;
    std::vector<std::string> written_;  ///< cards with axes that were written, each once
};

}  // namespace motionrack::operate
