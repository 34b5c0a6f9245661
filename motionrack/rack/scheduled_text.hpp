// "ACTION@TIME": a user's text that schedules an action during a run.
#pragma once

#include <motionrack/base/time.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::rack {

struct ScheduledText {
    Instant at{};        ///< since the start of the rack
    std::string action;  ///< text before the '@'
    std::string text;    ///< complete text of the user
};

inline constexpr double max_planned_seconds = 1e6;

/// Parses ACTION@TIME. TIME is a number with s, ms or us, 0 .. max_planned_seconds. Returns nothing if the text has no
/// such time.
std::optional<ScheduledText> read_timed_text(std::string_view text);

}  // namespace motionrack::rack
