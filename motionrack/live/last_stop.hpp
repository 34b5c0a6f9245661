// The stop of real cards where nothing else is possible any more: a thread ends the program, because an allocation or
// an internal check has failed, or an exception was not caught. The other threads still run, and are not waited for.
//
//   LiveCard ──► LastStop { library on the bare port } ──► list ──► terminate handler ──► quick stop, then the end
//
// A real card drives on when its program ends, so its stop comes before the end. It needs no memory and no virtual
// time. The thread that drives the card may be within an access, so the stop is written twice. It writes nothing else
// from then on: see is_program_ending().
#pragma once

#include <exception>
#include <motionrack/base/function_library.hpp>

namespace motionrack::live {

/// Lists a card for stop_live_cards() while it lives. Neither copied nor moved.
class LastStop {
  public:
    /// `library`: on the port itself, used for nothing else. It must outlive this object.
    explicit LastStop(FunctionLibrary& library);
    ~LastStop();
    LastStop(const LastStop&) = delete;
    LastStop& operator=(const LastStop&) = delete;

  private:
    friend void stop_live_cards() noexcept;
    FunctionLibrary& library_;
    LastStop* next_;
};

/// Writes the quick stop of all listed cards. Allocates nothing where the computer accepts the accesses. Any thread.
void stop_live_cards() noexcept;

/// True from the call of the terminate handler below on: drivers of real cards write nothing more. Any thread.
bool is_program_ending();

/// Installs a terminate handler that stops the listed cards and then calls `then`, which must not return.
void stop_live_cards_at_terminate(std::terminate_handler then);

}  // namespace motionrack::live
