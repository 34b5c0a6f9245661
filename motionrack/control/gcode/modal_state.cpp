// Changes of the modal state outside of a line, and modes that are saved and restored.
#include <motionrack/control/gcode/modal_state.hpp>

namespace motionrack::control::gcode {

void Modes::start(double tolerance_mm, bool in_g0) {
    now_.tolerance_mm = tolerance_mm;
    if (in_g0) now_.motion = 0;
    next_ = now_;
}

void Modes::set_coolant(bool mist, bool flood) {
    now_.mist = mist;
    now_.flood = flood;
}

void Modes::end_program() {
    now_.motion = 10;
    now_.plane = 0;
    now_.incremental = now_.inverse_time = now_.arc_absolute = false;
    now_.feed = now_.feed_rotary = 0;
    now_.spindle = Spindle::off;
    now_.mist = now_.flood = false;
    now_.feed_override = now_.speed_override = true;
    now_.ended = true;
    now_.cutter = CutterSide::off;
    now_.system = 0;
    next_ = now_;
}

void Modes::save(int code, std::size_t level) {
    if (kept_.size() <= level) kept_.resize(level + 1);
    kept_[level] = {};
    if (code != 71) kept_[level] = {now_, code == 73};
}

const ModalState* Modes::saved(std::size_t level) const {
    return level < kept_.size() && kept_[level].modes ? &*kept_[level].modes : nullptr;
}

void Modes::restore(const ModalState& saved) {
    next_.plane = saved.plane;
    next_.system = saved.system;
    next_.inch = saved.inch;
    next_.incremental = saved.incremental;
    next_.arc_absolute = saved.arc_absolute;
    next_.inverse_time = saved.inverse_time;
    next_.retract_to_r = saved.retract_to_r;
    next_.path = saved.path;
    next_.tolerance_mm = saved.tolerance_mm;
    next_.feed = saved.feed;
    next_.feed_rotary = saved.feed_rotary;
    next_.feed_override = saved.feed_override;
    next_.speed_override = saved.speed_override;
    next_.feed_stop = saved.feed_stop;
}

std::optional<ModalState> Modes::leave_call(std::size_t level) {
    if (kept_.size() <= level) return {};
    const SavedModes kept = kept_[level];
    kept_.resize(level);
    return kept.comes_back ? kept.modes : std::nullopt;
}

bool Modes::can_stay_beside(const ModalState& saved) const {
    return saved.plane == now_.plane && saved.inch == now_.inch && saved.system == now_.system && !saved.inverse_time;
}

}  // namespace motionrack::control::gcode
