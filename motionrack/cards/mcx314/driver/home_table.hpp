// The ways of homing as tables: START states write a drive and lead on at once, WAIT states look at one status.
//
//   CHECK_START ─off─► SEARCH_START ► SEARCH_WAIT ─on─► REST ─on─► BACK_START ► BACK_WAIT ─off─► CLEAR ► SETTLE ...
//        ├─on────────────────────────────────────────────────────►┘  ▲                          ... ─off─► SLOW ...
//        └─limit─► RETURN_START ► RETURN_WAIT ─on──────────────────────┘
#pragma once

#include <array>
#include <motionrack/base/states.hpp>
#include <span>
#include <string_view>

namespace motionrack::mcx314 {

/// What a state of a homing does. All but the three waits and the ends lead on at once.
enum class HomingAction : std::uint8_t {
    look,         ///< looks where the axis stands
    drive,        ///< writes stop input, speed and pulses, and starts
    wait_end,     ///< until the drive has ended (RR0), then looks why (RR1)
    settle,       ///< notes the time
    wait_steady,  ///< until the home input has not changed for the settling time (RR4, RR5)
    zero,         ///< writes LP and EP
    wait_stop,    ///< until the axis stands after a failure
    end
};
enum class SearchDirection : std::uint8_t { towards, away };  ///< the switch, as the direction of the search has it
enum class HomingSpeed : std::uint8_t { fast, back, slow };   ///< fast has ramps; back and slow are constant speeds
enum class HomingStopInput : std::uint8_t { distance, on, off, index };  ///< distance: the clearance, no stop input

/// What leads from a state to the next one.
enum class HomingTransition : std::uint8_t {
    done,   ///< it did what it should
    on,     ///< the home input is active
    off,    ///< it is not
    limit,  ///< the limit switch in the way was reached, or is active
    early,  ///< the switch came before the speed V was reached
    unseen  ///< the home input is not active, and the index has not been seen
};

struct HomeExit {
    HomingTransition cause = HomingTransition::done;
    std::string_view to = {};  ///< "": no exit
};

struct HomeState {
    std::string_view name;
    std::string_view meaning;
    HomingAction does = HomingAction::end;
    std::array<HomeExit, 3> exits = {};
    SearchDirection way = SearchDirection::towards;
    HomingSpeed pace = HomingSpeed::fast;
    HomingStopInput until = HomingStopInput::distance;
};

/// A way of homing: what runs, and the same as a declared state machine for people, traces and checks.
struct HomeTable {
    std::span<const HomeState> states;
    MachineInfo machine;

    const HomeState& state(std::string_view name) const {
        return states[static_cast<std::size_t>(state_index(machine, name))];
    }
};

/// The table of a type, 1..5.
const HomeTable& home_table(int type);

}  // namespace motionrack::mcx314
