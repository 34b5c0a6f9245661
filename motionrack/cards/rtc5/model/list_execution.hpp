// The execution of lists: position, calls, starts and ends.
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
    /// A list runs, or the card moves by goto_xy.
    bool is_busy() const { return lists_.running || lists_.moving_alone; }
    /// get_status
    std::uint32_t status() const;
    std::int64_t position() const { return lists_.current; }

    void auto_change() { lists_.auto_change = 1; }
    void start_loop() { lists_.loop = 1; }
    void quit_loop() { lists_.loop = 0; }
    /// execute_at_pointer
    Result<void> execute_at(std::int64_t position);
    /// Begins at a position. `cause`: bit of the start and stop info.
    void begin(std::int64_t position, std::uint32_t cause);
    /// Ends the running list; the other list may follow. `written`: by set_end_of_list, not by an empty position.
    void end(bool written, std::int64_t tick);
    /// Continues at a position and returns later. A call to an undefined target (-1) is a list_nop. Returns false if
    /// the command takes a tick.
    bool call(std::int64_t position, std::int64_t tick);
    /// Start position of a subroutine; -1: undefined.
    std::int64_t subroutine(std::int64_t index) const;
    /// list_return. Returns false if the command takes a tick.
    bool come_back();
    /// Returns true if the laser was on; it goes off with the list.
    bool pause();
    /// Continues after pause(). Returns true if the laser is switched on again.
    bool restart();
    /// Ends all lists and what waits for their end.
    void stop();

  private:
    Lists& lists_;
    StatusFlags& flags_;
    const Connections& connections_;
};

}  // namespace motionrack::rtc5
