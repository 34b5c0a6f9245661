// Detects openings of the door and stores states over them.
#include <fmt/format.h>

#include <motionrack/operate/door.hpp>
#include <utility>

namespace motionrack::operate {

Door::Door(rack::Rack& rack) : contacts_(rack.stop_latch().contacts()) {
    rack.stop_latch().heed_door(false);
}

Result<void> Door::check_closed(const char* what) const {
    if (!contacts_.door_open()) return {};
    return fail(ErrorKind::refused, fmt::format("{}: the door is open. Nothing was moved; close it first.", what));
}

std::optional<std::string> Door::take_opening(bool moves, bool held) {
    const bool open = contacts_.door_open();
    if (std::exchange(was_open_, open) || !open) return {};
    return fmt::format("The door was opened at {:.3f} s: {}, the spindle is off. Close it, then {}.",
                       to_seconds(contacts_.door_opened()),
                       held    ? "the feed is held"
                       : moves ? "the motion was stopped"
                               : "nothing was moving",
                       held ? "resume" : "continue");
}

void Door::keep_tools(const Status& status) {
    if (!kept_) kept_ = Tools{status.spindle, status.mist, status.flood};
}

bool Door::keep_event(const control::gcode::CanonCall& event) {
    using Kind = control::gcode::CanonCallKind;
    if (kept_ && event.kind == Kind::spindle) kept_->spindle = event.spindle;
    if (event.kind == Kind::coolant) keep_coolant(event.mist, event.flood);
    if (kept_ && event.kind == Kind::end) kept_ = Tools{};
    return kept_ || (was_open_ && contacts_.door_open());
}

void Door::keep_coolant(bool mist, bool flood) {
    if (!kept_) return;
    kept_->mist = mist;
    kept_->flood = flood;
}

void Door::give_back_tools(Status& status) {
    if (!kept_) return;
    status.spindle = kept_->spindle;
    status.mist = kept_->mist;
    status.flood = kept_->flood;
    kept_.reset();
}

}  // namespace motionrack::operate
