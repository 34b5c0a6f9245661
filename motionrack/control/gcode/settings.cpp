// Refuses settings with which no program could be read.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/number.hpp>
#include <motionrack/control/gcode/settings.hpp>

namespace motionrack::control::gcode {

namespace {

bool sensible(double value) {
    return std::isfinite(value) && std::fabs(value) <= largest_number;
}

Result<void> check_point(const Point& point, const char* what) {
    for (int axis = 0; axis < axis_count; ++axis) {
        if (!sensible(point[axis])) {
            return fail(ErrorKind::invalid_input,
                        fmt::format("{} of axis {} is {}; it must be a number from -1e9 to 1e9", what,
                                    axis_letters[axis], point[axis]));
        }
    }
    return {};
}

}  // namespace

Result<void> check_settings(const Settings& settings) {
    for (int axis = 0; axis < axis_count; ++axis) {
        const AxisLimits& limits = settings.limits[axis];
        if (!limits.present) continue;
        if (!sensible(limits.min_position) || !sensible(limits.max_position) ||
            limits.min_position > limits.max_position) {
            return fail(
                ErrorKind::invalid_input,
                fmt::format("axis {} goes from {} to {}; the limits must be numbers from -1e9 to 1e9, the first not "
                            "greater than the second",
                            axis_letters[axis], limits.min_position, limits.max_position));
        }
    }
    if (!sensible(settings.path_tolerance_mm) || settings.path_tolerance_mm < 0) {
        return fail(ErrorKind::invalid_input,
                    fmt::format("the path tolerance is {} mm; it must be 0 or more", settings.path_tolerance_mm));
    }
    if (!sensible(settings.peck_clearance_mm) || settings.peck_clearance_mm < 0) {
        return fail(ErrorKind::invalid_input,
                    fmt::format("the peck clearance is {} mm; it must be 0 or more", settings.peck_clearance_mm));
    }
    MOTIONRACK_CHECK(check_point(settings.start, "the start position"));
    MOTIONRACK_CHECK(check_point(settings.g28, "the G28 position"));
    MOTIONRACK_CHECK(check_point(settings.g30, "the G30 position"));
    for (const Point& offset : settings.work_offsets) MOTIONRACK_CHECK(check_point(offset, "a work offset"));
    return {};
}

}  // namespace motionrack::control::gcode
