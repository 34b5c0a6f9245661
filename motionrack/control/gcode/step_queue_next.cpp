// Makes the next call of a line.
#include <algorithm>
#include <motionrack/control/gcode/plane_point.hpp>
#include <motionrack/control/gcode/step_queue.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr std::int16_t input_code = 66;
constexpr std::int16_t first_analog_output = 67;

}  // namespace

const CanonCall* StepQueue::make_next(const StepSources& from) {
    was_held_ = false;
    const std::uint32_t what = todo_ & (0 - todo_);
    if (what == todo_motion) return make_motion(from);
    if (what == todo_held) {
        if (const CanonCall* step = from.held.next()) {
            was_held_ = from.held.was_held();
            return step;
        }
        todo_ &= ~what;
        return next(from);
    }
    if (what == todo_comments) return make_comment(from);
    todo_ &= ~what;
    const ModalState& modes = from.modes.now();
    event_ = CanonCall{};
    event_.line = from.words.number();
    event_.speed_rpm = modes.speed_rpm;
    event_.tool = modes.tool_selected;
    event_.mist = modes.mist;
    event_.flood = modes.flood;
    event_.overridable = modes.feed_override;
    fill_event(what, from);
    return &event_;
}

void StepQueue::fill_event(std::uint32_t what, const StepSources& from) {
    const ModalState& modes = from.modes.now();
    switch (what) {
        case todo_spindle_speed:
            event_.kind = CanonCallKind::spindle_speed;
            break;
        case todo_tool_select:
            event_.kind = CanonCallKind::tool_select;
            break;
        case todo_tool_change:
            event_.kind = from.words.block().m[m_tool] == 61 ? CanonCallKind::tool_number : CanonCallKind::tool_change;
            event_.tool = modes.tool_loaded;
            break;
        case todo_coolant:
            event_.kind = CanonCallKind::coolant;
            break;
        case todo_spindle:
            event_.kind = CanonCallKind::spindle;
            event_.spindle = modes.spindle;
            break;
        case todo_wait:
            fill_dwell(wait_seconds_, from);
            event_.awaits_input = true;
            break;
        case todo_port:
            fill_port(from.words.block());
            break;
        case todo_overrides:
            fill_overrides(from.words.block().m[m_override], modes);
            break;
        case todo_dwell:
            fill_dwell(dwell_seconds_, from);
            break;
        default:
            apply_end(from.modes, from.offsets);
            event_.kind = stop_code_ == 0 || stop_code_ == 60 ? CanonCallKind::pause
                          : stop_code_ == 1                   ? CanonCallKind::optional_pause
                                                              : CanonCallKind::end;
            break;
    }
}

void StepQueue::fill_dwell(double seconds, const StepSources& from) {
    Move& move = event_.move;
    move.kind = MoveKind::dwell;
    move.path = from.modes.now().path;
    move.tolerance_mm = from.modes.now().tolerance_mm;
    move.line = from.words.number();
    move.seconds = seconds;
    move.end = dwell_at_;
}

void StepQueue::fill_port(const Block& block) {
    const int code = block.m[m_io];
    event_.kind = code == input_code ? CanonCallKind::input : CanonCallKind::output;
    event_.analog = block.has('E') && (code >= first_analog_output || code == input_code);
    event_.with_motion = code == 62 || code == 63 || code == 67;
    event_.port = static_cast<std::int32_t>(block[event_.analog ? 'E' : 'P']);
    event_.value = port_value_;
}

void StepQueue::fill_overrides(int code, const ModalState& modes) {
    event_.kind = CanonCallKind::overrides;
    event_.port = code;
    event_.value = code == 51   ? modes.speed_override
                   : code == 52 ? false
                   : code == 53 ? modes.feed_stop
                                : modes.feed_override;
}

const CanonCall* StepQueue::make_motion(const StepSources& from) {
    if (motion_ == Motion::single) {
        todo_ &= ~static_cast<std::uint32_t>(todo_motion);
        return &moving_;
    }
    if (motion_ == Motion::via_point) {
        moving_.move.end = via_point_done_ ? from.travel.position() : via_;
        if (via_point_done_) todo_ &= ~static_cast<std::uint32_t>(todo_motion);
        via_point_done_ = true;
        return &moving_;
    }
    if (motion_ == Motion::turning) {
        fill_turning();
        return &moving_;
    }
    if (motion_ == Motion::spline ? fill_spline(from.travel) : cycle_.next(moving_)) return &moving_;
    moving_.kind = CanonCallKind::move;
    todo_ &= ~static_cast<std::uint32_t>(todo_motion);
    return next(from);
}

void StepQueue::fill_turning() {
    const LatheMove& turned = turned_[turned_pulled_++];
    Move& move = moving_.move;
    move.kind = turned.kind;
    move.first = plane_axes[1][0];
    move.second = plane_axes[1][1];
    move.turns = turned.turns;
    move.centre_first = turned.centre.first;
    move.centre_second = turned.centre.second;
    move.end[2] = turned.to.first;
    move.end[0] = turned.to.second;
    if (turned_pulled_ == turned_.size()) todo_ &= ~static_cast<std::uint32_t>(todo_motion);
}

/// Makes the next arc of the curve. Its joints may lie beside the curve, but not outside the limits.
bool StepQueue::fill_spline(const Travel& travel) {
    Move& move = moving_.move;
    if (!spline_.next(move)) return false;
    for (const int axis : {0, 1}) move.end[axis] = std::clamp(move.end[axis], travel.low()[axis], travel.high()[axis]);
    return true;
}

const CanonCall* StepQueue::make_comment(const StepSources& from) {
    const auto& comments = from.words.block().comments;
    const Comment& comment = comments[comments_pulled_++];
    if (comments_pulled_ == comments.size()) todo_ &= ~static_cast<std::uint32_t>(todo_comments);
    event_ = CanonCall{};
    event_.kind = comment.message ? CanonCallKind::message : CanonCallKind::comment;
    event_.line = from.words.number();
    event_.text = comment.text;
    if (comment.values) event_.text = shown_[comments_pulled_ - 1];
    return &event_;
}

}  // namespace motionrack::control::gcode
