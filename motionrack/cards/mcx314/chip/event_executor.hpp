// Executes the events of a chip up to a tick, and finds the tick of the next one.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/external_drives.hpp>
#include <motionrack/cards/mcx314/chip/fast_forward.hpp>
#include <motionrack/cards/mcx314/chip/generators.hpp>
#include <motionrack/cards/mcx314/chip/home_search.hpp>
#include <motionrack/cards/mcx314/chip/input_filters.hpp>
#include <motionrack/cards/mcx314/chip/position_notifier.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/cards/mcx314/chip/synchronous_actions.hpp>

namespace motionrack::mcx314 {

class EventExecutor {
  public:
    EventExecutor(State& state, EventRequests& requests, PositionNotifier& notifier, FastForward& forward,
                  Generators& generators, InputFilters& filters, ExternalDrives& external, ChipHomeSearch& homes,
                  SynchronousActions& actions)
        : state_(state),
          requests_(requests),
          notifier_(notifier),
          forward_(forward),
          generators_(generators),
          filters_(filters),
          external_(external),
          homes_(homes),
          actions_(actions) {}

    /// Brings the whole chip up to `tick`.
    void advance_to(std::int64_t tick);
    /// Executes the events up to `tick`; the state of generators without an event at the last of these ticks may remain
    /// older.
    void work_to(std::int64_t tick);
    /// Finds the tick of the next event.
    void find_next();

  private:
    void work_off(std::int64_t tick);
    void skip_to(std::int64_t tick);
    void look_at_in_position();

    State& state_;
    EventRequests& requests_;
    PositionNotifier& notifier_;
    FastForward& forward_;
    Generators& generators_;
    InputFilters& filters_;
    ExternalDrives& external_;
    ChipHomeSearch& homes_;
    SynchronousActions& actions_;
};

}  // namespace motionrack::mcx314
