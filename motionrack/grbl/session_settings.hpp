// Settings of a Grbl port by its owner: the reported axes, and the permissions of its sender.
#pragma once

#include <functional>
#include <motionrack/grbl/answers.hpp>
#include <motionrack/operate/machine.hpp>
#include <string>

namespace motionrack::grbl {

struct SessionSettings {
    int axes = 3;  ///< 3: X Y Z; 4: also A, in grblHAL's report format
    /// Succeeds if this sender may move the machine now. Empty: always.
    std::function<Result<void>()> take_control = {};
    /// Succeeds if a reset by this sender may stop the present action of the machine, or release its stop. Empty:
    /// always.
    std::function<Result<void>()> may_stop = {};
    /// Returns the identity of this sender, for reports of its resets; `kind`: "^X", "$X".
    std::function<operate::StopOrigin(const char* kind)> source = [](const char* kind) {
        return operate::StopOrigin{"a sender", "", kind};
    };
    bool onlookers_reset = false;  ///< resets by observers count as this sender's
    /// Called with a sentence when a setting has changed.
    std::function<void(const std::string&)> on_setting = {};
};

/// Returns true if the sender may move the machine now; else sends the reason.
bool take_control(const SessionSettings& settings, Answers& answers);

}  // namespace motionrack::grbl
