// Sources that can set the stop latch of a rack.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace motionrack::rack {

enum class StopSource : std::uint8_t {
    emergency_stop,  ///< the rack's button, or a card's input for it
    stop_command,    ///< a command from a client or the operator
    drive_alarm,     ///< alarm of an axis' drive, at its card's input
    limit_switch,    ///< limit switch of an axis at standstill or moving towards it
    watchdog,        ///< reset of a card whose program hung
    following_error  ///< following error above the limit: see following_watch.hpp
};

inline constexpr std::array<StopSource, 6> stop_sources = {StopSource::emergency_stop, StopSource::stop_command,
                                                           StopSource::drive_alarm,    StopSource::limit_switch,
                                                           StopSource::watchdog,       StopSource::following_error};

/// Returns "emergency stop", "STOP command", "drive alarm", "limit switch", "watchdog" or "following error".
std::string_view name_of(StopSource source);

}  // namespace motionrack::rack
