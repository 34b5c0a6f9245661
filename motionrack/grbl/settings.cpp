// Table of Grbl's numbered settings.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/grbl/numbers.hpp>
#include <motionrack/grbl/settings.hpp>
#include <motionrack/rack/homing.hpp>

namespace motionrack::grbl {

namespace {

using rack::RackAxis;
using rack::RackConfig;

constexpr int axis_decimals = 3;

/// Returns a mask of axes: bit n for axis n of X Y Z A.
template <class Is>
double mask(const RackConfig& config, Is is) {
    unsigned bits = 0;
    for (const RackAxis& axis : config.axes) bits |= is(axis) ? 1u << axis.index() : 0u;
    return bits;
}

/// Returns the value of the first axis that can be homed; 0 if none can.
template <class Get>
double of_homing(const RackConfig& config, Get get) {
    for (const RackAxis& axis : config.axes)
        if (const auto order = rack::home_order(config, axis)) return get(*order, axis);
    return 0;
}

double nothing(const RackConfig&) {
    return 0;
}
double one(const RackConfig&) {
    return 1;
}

constexpr std::array<Setting, 22> table = {{
    {0, 0, "step pulse, us", [](const RackConfig&) { return 10.0; }, nullptr},
    {1, 0, "step idle delay, ms; 255: motors stay on", [](const RackConfig&) { return 255.0; }, nullptr},
    {2, 0, "step pulse invert, mask", nothing, nullptr},
    {3, 0, "direction invert, mask",
     [](const RackConfig& c) { return mask(c, [](const RackAxis& axis) { return axis.reversed; }); }, nullptr},
    {4, 0, "step enable invert", nothing, nullptr},
    {5, 0, "limit pins invert", nothing, nullptr},
    {6, 0, "probe pin invert", nothing, nullptr},
    {10, 0, "status report, mask", nullptr, &SessionSettingValues::report, 255},
    {11, 3, "junction deviation, mm", [](const RackConfig& c) { return c.controller.default_path_tolerance_mm; },
     nullptr},
    {12, 3, "arc tolerance, mm", [](const RackConfig& c) { return c.controller.arc_tolerance_mm; }, nullptr},
    {13, 0, "report in inches", nullptr, &SessionSettingValues::inches, 1},
    {20, 0, "soft limits", one, nullptr},
    {21, 0, "hard limits",
     [](const RackConfig& c) {
         return mask(c, [](const RackAxis& axis) { return axis.switches.limit_minus || axis.switches.limit_plus; }) != 0
                    ? 1.0
                    : 0.0;
     },
     nullptr},
    {22, 0, "homing cycle",
     [](const RackConfig& c) {
         return mask(c, [&](const RackAxis& axis) { return c.can_home(axis); }) != 0 ? 1.0 : 0.0;
     },
     nullptr},
    {23, 0, "homing direction invert, mask: axes that search in - direction",
     [](const RackConfig& c) {
         return mask(c, [&](const RackAxis& axis) {
             return c.can_home(axis) && axis.homing.search_direction == rack::HomingDirection::minus;
         });
     },
     nullptr},
    {24, 3, "homing feed, mm/min",
     [](const RackConfig& c) {
         return of_homing(
             c, [](const control::HomingRequest& order, const RackAxis&) { return order.latch_velocity * 60; });
     },
     nullptr},
    {25, 3, "homing seek, mm/min",
     [](const RackConfig& c) {
         return of_homing(
             c, [](const control::HomingRequest& order, const RackAxis&) { return order.search_velocity * 60; });
     },
     nullptr},
    {26, 0, "homing debounce, ms",
     [](const RackConfig& c) {
         return of_homing(c,
                          [](const control::HomingRequest& order, const RackAxis&) { return order.settle_s * 1000; });
     },
     nullptr},
    {27, 3, "homing pull-off, mm",
     [](const RackConfig& c) {
         return of_homing(c, [](const control::HomingRequest& order, const RackAxis&) { return order.backoff; });
     },
     nullptr},
    {30, 0, "maximum spindle speed, rpm", nullptr, &SessionSettingValues::max_rpm, 1e6},
    {31, 0, "minimum spindle speed, rpm", nullptr, &SessionSettingValues::min_rpm, 1e6},
    {32, 0, "laser mode", nullptr, &SessionSettingValues::laser, 1},
}};

constexpr std::array<AxisSetting, 4> axis_table = {{
    {100, "pulses per mm or degree", [](const RackAxis& axis) { return axis.pulses_per_unit(); }},
    {110, "maximum velocity, mm/min", [](const RackAxis& axis) { return axis.max_velocity * 60; }},
    {120, "acceleration, mm/s2", [](const RackAxis& axis) { return axis.max_accel; }},
    {130, "travel, mm", [](const RackAxis& axis) { return axis.max_limit - axis.min_limit; }},
}};

double axis_value(const RackConfig& config, const AxisSetting& setting, int axis) {
    const RackAxis* found = config.axis(control::axis_letters[static_cast<std::size_t>(axis)]);
    return found == nullptr ? 0 : setting.get(*found);
}

SettingResult of_the_rack(int number, double value, double there, int decimals) {
    const double half = std::pow(10.0, -decimals) / 2;
    if (std::fabs(value - there) <= half) return {};
    return {error_unknown, fmt::format("${} is {:.{}f} in the rack file. It was not changed; change the rack file",
                                       number, there, decimals)};
}

}  // namespace

std::span<const Setting> settings() {
    return table;
}
std::span<const AxisSetting> axis_settings() {
    return axis_table;
}

std::string settings_text(const rack::RackConfig& config, const SessionSettingValues& own, int axes) {
    std::string out;
    for (const Setting& setting : table)
        out += fmt::format("${}={:.{}f}\r\n", setting.number,
                           setting.own != nullptr ? own.*setting.own : setting.rack(config), setting.decimals);
    for (const AxisSetting& setting : axis_table)
        for (int axis = 0; axis < axes; ++axis)
            out +=
                fmt::format("${}={:.{}f}\r\n", setting.first + axis, axis_value(config, setting, axis), axis_decimals);
    return out;
}

SettingResult change_setting(const rack::RackConfig& config, SessionSettingValues& own, int axes, int number,
                             double value) {
    if (value < 0) return {error_negative, {}};
    if (number == 0 && value < 3) return {error_short_pulse, {}};
    for (const AxisSetting& setting : axis_table)
        if (number >= setting.first && number < setting.first + axes)
            return of_the_rack(number, value, axis_value(config, setting, number - setting.first), axis_decimals);
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const Setting& setting) { return setting.number == number; });
    if (found == table.end()) return {error_unknown, fmt::format("Unknown setting ${}", number)};
    if (found->own == nullptr) return of_the_rack(number, value, found->rack(config), found->decimals);
    if (value > found->max || value != std::floor(value))
        return {error_bad_number,
                fmt::format("${} must be a whole number, 0 to {:.0f}. It was not changed", number, found->max)};
    own.*found->own = value;
    return {0, fmt::format("${} is {:.0f}", number, value)};
}

}  // namespace motionrack::grbl
