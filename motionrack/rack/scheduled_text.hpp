// "WHAT@TIME" as users plan what happens on the way of a run.
#pragma once

#include <motionrack/base/time.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::rack {

struct ScheduledText {
    Instant at{};        ///< since the rack was started
    std::string action;  ///< what stands before the '@'
    std::string text;    ///< all of it, as its user wrote it
};

inline constexpr double max_planned_seconds = 1e6;

/// TIME is a number with s, ms or us, 0 .. max_planned_seconds. Nothing: it has no such time.
std::optional<ScheduledText> read_timed_text(std::string_view text);

}  // namespace motionrack::rack
