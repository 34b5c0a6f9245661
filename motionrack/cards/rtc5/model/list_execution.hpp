// Execution of lists: position, calls, starts and ends.
#pragma once

#include <cstdint>
#include <motionrack/cards/rtc5/model/connections.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <motionrack/cards/rtc5/model/status_flags.hpp>

namespace motionrack::rtc5 {

class ListExecution {
  public:
    /// `lists` is part of the card's state and must outlive this.
    ListExecution(Lists& lists, StatusFlags& flags, const Connections& connections)
        : lists_(lists), flags_(flags), connections_(connections) {}

    bool is_running() const { return lists_.running != 0; }
    /// Returns true if a list runs or the card moves by goto_xy.
    bool is_busy() const { return lists_.running || lists_.moving_alone; }
    /// Returns the answer of get_status, whose bits map::status_bits names.
    std::uint32_t status() const;
    std::int64_t position() const { return lists_.current; }

    void auto_change() { lists_.auto_change = 1; }
    void start_loop() { lists_.loop = 1; }
    void quit_loop() { lists_.loop = 0; }
    /// Executes execute_at_pointer: starts a list at a memory position. Refused while the card is busy.
    Result<void> execute_at(std::int64_t position);
    /// Begins a list at a memory position. `cause`: bit set in the start and stop info.
    void begin(std::int64_t position, std::uint32_t cause);
    /// Ends the running list; the other list may follow. `written`: set_end_of_list ended it, not an empty position.
    void end(bool written, std::int64_t tick);
    /// Calls a subroutine at a memory position; list_return continues behind the call. A call to an
    /// undefined target (-1) is a list_nop. Returns false if the command takes a tick.
    bool call(std::int64_t position, std::int64_t tick);
    /// Returns the start position of a subroutine; -1: undefined.
    std::int64_t subroutine(std::int64_t index) const;
    /// Executes list_return. Returns false if the command takes a tick, because no call is open.
    bool come_back();
    /// Pauses the running list. Returns true if the laser was on and must be switched off.
    bool pause();
    /// Continues after pause(). Returns true if the laser is switched on again.
    bool restart();
    /// Ends the running list with its calls, pause, loop and automatic change, and a goto_xy.
    void stop();

  private:
    Lists& lists_;
    StatusFlags& flags_;
    const Connections& connections_;
};

}  // namespace motionrack::rtc5
