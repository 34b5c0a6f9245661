// Adds the calls of a line.
#include <motionrack/control/gcode/step_queue.hpp>
#include <utility>

namespace motionrack::control::gcode {

std::uint32_t StepQueue::set_aside() {
    const std::uint32_t kept = todo_ & (todo_comments | (end_pending_ ? todo_stop : 0u));
    todo_ &= ~kept;
    return kept;
}

void StepQueue::add_comments() {
    todo_ |= todo_comments;
    comments_pulled_ = 0;
}

void StepQueue::add_dwell(double seconds) {
    dwell_seconds_ = seconds;
    todo_ |= todo_dwell;
}

void StepQueue::add_wait(double seconds) {
    wait_seconds_ = seconds;
    todo_ |= todo_wait;
}

void StepQueue::add_port(double value) {
    port_value_ = value;
    todo_ |= todo_port;
}

void StepQueue::add_stop(std::int16_t code) {
    stop_code_ = code;
    todo_ |= todo_stop;
}

void StepQueue::add_motion(Motion motion) {
    motion_ = motion;
    todo_ |= todo_motion;
}

void StepQueue::add_move_via(const Point& via) {
    via_ = via;
    via_point_done_ = false;
    add_motion(Motion::via_point);
}

void StepQueue::add_cycle(const DrillCycle& plan) {
    cycle_.begin(plan);
    moving_.line = plan.pattern.line;
    moving_.probe = Probe::none;
    add_motion(Motion::cycle);
}

void StepQueue::add_spline(const CubicBezier& curve) {
    spline_.begin(curve, moving_.move);
    add_motion(Motion::spline);
}

void StepQueue::add_turning(std::vector<LatheMove> moves) {
    turned_ = std::move(moves);
    turned_pulled_ = 0;
    add_motion(Motion::turning);
}

void StepQueue::commit(const Point& position, bool overridable) {
    if (has(todo_dwell | todo_wait)) dwell_at_ = position;
    end_pending_ = ends_program();
    moving_.overridable = overridable;
}

void StepQueue::apply_end(Modes& modes, Offsets& offsets) {
    if (!end_pending_) return;
    end_pending_ = false;
    modes.end_program();
    offsets.activate(modes.now().system);
}

}  // namespace motionrack::control::gcode
