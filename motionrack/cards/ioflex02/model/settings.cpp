// Ranges of the settings.
#include <fmt/format.h>

#include <motionrack/cards/ioflex02/image.hpp>
#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/cards/ioflex02/model/settings.hpp>

namespace motionrack::ioflex02 {

Result<void> check(const Settings& s) {
    if (s.base_address % window != 0 || s.base_address > 0xFF00)
        return fail(ErrorKind::refused,
                    fmt::format("The base address is {:04X}h; it must be a multiple of {:X}h from 0 to FF00h.",
                                s.base_address, window));
    if (s.configuration_time < Duration{0} || s.configuration_time > whole_seconds(60))
        return fail(ErrorKind::refused, fmt::format("The time of configuration is {} s; it must be 0 to 60 s.",
                                                    to_seconds(s.configuration_time)));
    if (!s.image.empty()) MOTIONRACK_CHECK(inspect(s.image));
    return {};
}

}  // namespace motionrack::ioflex02
