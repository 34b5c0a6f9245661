// Changes of the offsets and of the tool table.
#include <motionrack/control/gcode/offsets.hpp>

namespace motionrack::control::gcode {

void Offsets::start(const Settings& settings) {
    frame_.work = settings.work_offsets;
    frame_.g28 = settings.g28;
    frame_.g30 = settings.g30;
    frame_.activate(0);
    tools_ = settings.tools;
}

WorkFrame& Offsets::edit_frame() {
    if (!frame_edited_) next_frame_ = frame_;
    frame_edited_ = true;
    return next_frame_;
}

void Offsets::commit() {
    if (tool_edited_) tools_.put(*tool_edited_);
    if (frame_edited_) frame_ = next_frame_;
}

void Offsets::reset_rotation(int system) {
    frame_.rotation_deg = {};
    frame_.activate(system);
}

void Offsets::restore(const WorkFrame& earlier, int system) {
    frame_.work = earlier.work;
    frame_.rotation_deg = earlier.rotation_deg;
    frame_.g92 = earlier.g92;
    frame_.g92_saved = earlier.g92_saved;
    frame_.g28 = earlier.g28;
    frame_.g30 = earlier.g30;
    frame_.activate(system);
}

void Offsets::set_probe_result(bool hit, const Point& at) {
    frame_.probe = at;
    frame_.probe_hit = hit;
}

}  // namespace motionrack::control::gcode
