#include <fmt/format.h>

#include <motionrack/control/axis_group.hpp>

namespace motionrack::control {

std::string position_text(const Point& at, const MachineLimits& limits) {
    std::string out;
    for (std::size_t i = 0; i < at.size(); ++i)
        if (limits[i].present) out += fmt::format("{}{} {:.4f}", out.empty() ? "" : ", ", axis_letters[i], at[i]);
    return out;
}

tl::unexpected<Error> stopped_on_request(int line, const Point& at, const MachineLimits& limits) {
    return fail(ErrorKind::stopped,
                fmt::format("Stopped on request in line {}; the axes stopped along the path at {}.", line,
                            position_text(at, limits)),
                {line, 1});
}

}  // namespace motionrack::control
