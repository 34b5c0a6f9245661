// Homing methods as tables: START states write a drive and continue at once, WAIT states poll one status.
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

/// Action of a homing state. All states except the three waits and the ends continue at once.
enum class HomingAction : std::uint8_t {
    poll,         ///< reads the position of the axis
    drive,        ///< writes stop input, speed and pulses, and starts
    wait_end,     ///< waits until the drive has ended (RR0), then reads the cause (RR1)
    settle,       ///< records the time at which settling begins
    wait_steady,  ///< waits until the home input has not changed for the settling time (RR4, RR5)
    zero,         ///< writes LP and EP
    wait_stop,    ///< waits until standstill after a failure
    end
};
enum class SearchDirection : std::uint8_t { towards, away };  ///< relative to the switch
enum class HomingSpeed : std::uint8_t { fast, back, slow };   ///< fast has ramps; back and slow are constant speeds
enum class HomingStopInput : std::uint8_t { distance, on, off, index };  ///< distance: the backoff, no stop input

/// Condition of a transition.
enum class HomingTransition : std::uint8_t {
    done,   ///< the action is complete
    on,     ///< the home input is active
    off,    ///< the home input is inactive
    limit,  ///< the limit switch ahead was reached, or is active
    early,  ///< the switch acted before the speed V was reached
    unseen  ///< the home input is inactive, and the index has not been seen
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
    SearchDirection search_direction = SearchDirection::towards;
    HomingSpeed pace = HomingSpeed::fast;
    HomingStopInput until = HomingStopInput::distance;
};

/// A homing method: the executed table, and the same as a declared state machine for documents, traces and checks.
struct HomeTable {
    std::span<const HomeState> states;
    MachineInfo machine;

    const HomeState& state(std::string_view name) const {
        return states[static_cast<std::size_t>(state_index(machine, name))];
    }
};

/// Returns the table of a method, 1 .. 5.
const HomeTable& home_table(int type);

}  // namespace motionrack::mcx314
