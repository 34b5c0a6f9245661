// Sets the ends of waiting calls.
#include <motionrack/control/gcode/compensation_queue.hpp>

namespace motionrack::control::gcode {

void CompensationQueue::settle(std::size_t first, std::size_t second, const CutterPath& path) {
    if (ready_ < steps_.size() && path.arc) steps_[ready_].move.turns = path.turns;
    for (std::size_t i = ready_; i < steps_.size(); ++i) {
        if (steps_[i].kind != CanonCallKind::move) continue;
        steps_[i].move.end[first] = path.end.first;
        steps_[i].move.end[second] = path.end.second;
    }
    settle();
}

const CanonCall* CompensationQueue::next() {
    if (has_ready()) return &steps_[next_++];
    steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(next_));
    next_ = ready_ = 0;
    return nullptr;
}

void CompensationQueue::clear() {
    steps_.clear();
    next_ = ready_ = of_lines_before_ = 0;
}

}  // namespace motionrack::control::gcode
