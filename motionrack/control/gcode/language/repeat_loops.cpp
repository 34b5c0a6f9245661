// Iterations and ends of repeat loops.
#include <motionrack/control/gcode/language/repeat_loops.hpp>

namespace motionrack::control::gcode {

bool RepeatLoops::next(std::int32_t location) {
    if (loops_.empty() || loops_.back().location != location) return false;
    if (--loops_.back().left > 0) return true;
    loops_.pop_back();
    return false;
}

void RepeatLoops::end_between(std::int32_t first, std::int32_t last) {
    const std::size_t outer = outer_.empty() ? 0 : outer_.back();
    while (loops_.size() > outer && loops_.back().location >= first && loops_.back().location < last) loops_.pop_back();
}

void RepeatLoops::leave_call() {
    end_all();
    outer_.pop_back();
}

}  // namespace motionrack::control::gcode
