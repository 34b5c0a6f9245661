// Touch off: sets a work offset at the present position.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/operate/machine.hpp>

namespace motionrack::operate {

Result<void> touch_off(Machine& machine, char axis, double value) {
    MOTIONRACK_TRY(const rack::RackAxis* found,
                   axis_named(machine.rack().config(), "The work offset was not set", axis));
    if (!std::isfinite(value))
        return fail(ErrorKind::invalid_input, "The work offset was not set: the value is not a number.");
    if (machine.stream().has_work())
        return fail(ErrorKind::refused,
                    "The work offset was not set: the machine moves. Stop it, or wait for standstill.");
    const bool inches = machine.stream().interpreter().modes().inch && found->kind == rack::AxisKind::linear;
    if (const auto read = machine.line(fmt::format("G10 L20 P0 {}{:.9f}", axis, inches ? value / 25.4 : value), 1);
        !read)
        return tl::unexpected<Error>(read.error());
    return {};
}

}  // namespace motionrack::operate
