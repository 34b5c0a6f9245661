// Limits of the axes.
#include <motionrack/control/gcode/block.hpp>
#include <motionrack/control/gcode/travel.hpp>

namespace motionrack::control::gcode {

void Travel::start(const Settings& settings) {
    constexpr double nowhere = 4e9;
    for (int axis = 0; axis < axis_count; ++axis) {
        const AxisLimits& limits = settings.limits[axis];
        low_[axis] = limits.present ? limits.min_position - limit_slack : nowhere;
        high_[axis] = limits.present ? limits.max_position + limit_slack : -nowhere;
        if (limits.present) present_words_ |= letter_bit(axis_letters[axis]);
    }
    position_ = settings.start;
}

void Travel::remove_limits() {
    low_.fill(-1e9);
    high_.fill(1e9);
    present_words_ = axis_words;
}

}  // namespace motionrack::control::gcode
