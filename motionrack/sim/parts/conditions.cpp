// Messages for the conditions of a simulated axis.
#include <fmt/format.h>

#include <motionrack/sim/parts/conditions.hpp>

namespace motionrack::parts {

std::string describe(const sim::Condition& c, std::string_view axis) {
    const double at = to_seconds(c.at);
    switch (static_cast<AxisCondition>(c.code)) {
        case AxisCondition::fell_out_of_step:
            return fmt::format(
                "axis {}: at {:.6f} s the motor fell out of step when the pulse rate went from {} to {} Hz, more than "
                "it follows at once or above its pull-out rate",
                axis, at, c.a, c.b);
        case AxisCondition::lost_steps:
            return fmt::format(
                "axis {}: at {:.6f} s the motor was in step again and had {} {} pulses ({} in all); the true position "
                "differs from the commanded one: home it again",
                axis, at, c.a < 0 ? "run on by" : "lost", c.a < 0 ? -c.a : c.a, c.b);
        case AxisCondition::end_of_travel:
            return fmt::format("axis {}: at {:.6f} s the axle hit its {} hard stop at {} microsteps and stopped there",
                               axis, at, c.a > 0 ? "plus" : "minus", c.b);
        case AxisCondition::axle_held:
            return fmt::format("axis {}: at {:.6f} s the axle was held fast at {} microsteps (an injected fault)", axis,
                               at, c.a);
        case AxisCondition::stage_end:
            return fmt::format("stage {}: at {:.6f} s it hit its {} hard stop at {} nm and stopped there", axis, at,
                               c.a > 0 ? "plus" : "minus", c.b);
        case AxisCondition::scale_too_fast:
            return fmt::format(
                "scale {}: at {:.6f} s its velocity reached {} counts/s, above the {} counts/s of its electronics; it "
                "counts nothing until it is slower, and its position is invalid until it is referenced again",
                axis, at, c.a, c.b);
        case AxisCondition::scale_lost:
            return fmt::format(
                "scale {}: at {:.6f} s it counts again and has lost {} counts ({} in all); reference it again", axis,
                at, c.a, c.b);
    }
    return fmt::format("axis {}: at {:.6f} s condition {} ({}, {})", axis, at, c.code, c.a, c.b);
}

}  // namespace motionrack::parts
