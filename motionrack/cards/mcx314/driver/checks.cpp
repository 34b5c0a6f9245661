#include <fmt/format.h>

#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/types.hpp>

namespace motionrack::mcx314 {

Result<void> check_axes(unsigned axes, const char* who) {
    if (axes >= 1 && axes <= xyzu) return {};
    return fail(ErrorKind::refused,
                fmt::format("{}: the axis mask {} names no axes; X is 1, Y 2, Z 4, U 8, and sums of these up "
                            "to 15. Nothing was written.",
                            who, axes));
}

Result<void> check(unsigned axes, const Parameter& parameter, std::int64_t value) {
    MOTIONRACK_CHECK(check_axes(axes, parameter.name));
    if (value >= parameter.min && value <= parameter.max) return {};
    return fail(ErrorKind::refused, fmt::format("{} of {} is {}; it must be {} to {}. Nothing was written.",
                                                parameter.name, axes_text(axes), value, parameter.min, parameter.max));
}

Result<void> check_switch(const char* who, int n, int max_n, const char* meanings) {
    if (n >= 0 && n <= max_n) return {};
    return fail(ErrorKind::refused,
                fmt::format("{}: n is {}; it must be 0 to {} ({}). Nothing was written.", who, n, max_n, meanings));
}

Result<void> check_no_path(const char* who, MainStatus main) {
    if (!main.interpolating()) return {};
    return fail(
        ErrorKind::refused,
        fmt::format("{}: an interpolation runs. Nothing was written. Wait for its end, or stop it first.", who));
}

}  // namespace motionrack::mcx314
