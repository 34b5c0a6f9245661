#include <motionrack/grbl/session_settings.hpp>

namespace motionrack::grbl {

bool take_control(const SessionSettings& settings, Answers& answers) {
    if (!settings.take_control) return true;
    const Result<void> taken = settings.take_control();
    if (!taken) answers.push(taken.error().message);
    return taken.has_value();
}

}  // namespace motionrack::grbl
