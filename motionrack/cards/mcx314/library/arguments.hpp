// The arguments of the library's functions: names as in the source, ranges as checked by the Driver.
#pragma once

#include <array>
#include <motionrack/base/function_library.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>

namespace motionrack::mcx314::functions {

inline constexpr std::array axis_values = {ValueInfo{1, "X"}, ValueInfo{2, "Y"}, ValueInfo{4, "Z"}, ValueInfo{8, "U"}};
inline constexpr std::array two_axes = {ValueInfo{3, "X Y"}, ValueInfo{5, "X Z"},  ValueInfo{9, "X U"},
                                        ValueInfo{6, "Y Z"}, ValueInfo{10, "Y U"}, ValueInfo{12, "Z U"}};
inline constexpr std::array three_axes = {ValueInfo{7, "X Y Z"}, ValueInfo{11, "X Y U"}, ValueInfo{13, "X Z U"},
                                          ValueInfo{14, "Y Z U"}};
inline constexpr std::array low_high = {ValueInfo{0, "Low"}, ValueInfo{1, "High"}};
inline constexpr std::array off_on = {ValueInfo{0, "off"}, ValueInfo{1, "on"}};

constexpr ArgumentInfo number(std::string_view name, std::int64_t min, std::int64_t max, std::string_view unit,
                              std::string_view meaning, std::int64_t start) {
    return {name, min, max, unit, meaning, start};
}
constexpr ArgumentInfo of(std::string_view name, const Parameter& parameter, std::string_view unit,
                          std::string_view meaning, std::int64_t start) {
    return {name, parameter.min, parameter.max, unit, meaning, start};
}
template <std::size_t count>
constexpr ArgumentInfo one_of(std::string_view name, const std::array<ValueInfo, count>& values,
                              std::string_view meaning) {
    std::int64_t min = values[0].value, max = values[0].value;
    for (const ValueInfo& one : values) {
        min = one.value < min ? one.value : min;
        max = one.value > max ? one.value : max;
    }
    return {name, min, max, {}, meaning, values[0].value, values};
}

inline constexpr ArgumentInfo axes{"axis", 1, 15, {}, "axes", 1, axis_values, true};
inline constexpr ArgumentInfo one_axis = one_of("axis", axis_values, "axis");
inline constexpr ArgumentInfo two = one_of("axis", two_axes, "the two axes");
inline constexpr ArgumentInfo three = one_of("axis", three_axes, "the three axes");

inline constexpr std::string_view speed_unit = "x M pulses/s", ramp_unit = "x 125 M pulses/s2", pulse_unit = "pulses";
inline constexpr std::array speed = {axes, of("data", param::V, speed_unit, "speed", 1000)};
inline constexpr std::array ramp = {axes, of("data", param::A, ramp_unit, "acceleration", 100)};

constexpr ArgumentInfo sv_of(std::string_view name) {
    return of(name, param::SV, speed_unit, "initial speed", 100);
}
constexpr ArgumentInfo v_of(std::string_view name) {
    return of(name, param::V, speed_unit, "drive speed", 1000);
}
constexpr ArgumentInfo a_of(std::string_view name) {
    return of(name, param::A, ramp_unit, "acceleration", 100);
}
constexpr ArgumentInfo k_of(std::string_view name) {
    return of(name, param::K, "", "the acceleration's rate: the jerk is 62,500,000 / K x M pulses/s3", 1000);
}
inline constexpr ArgumentInfo d_or_a =
    number("D", 0, param::D.max, ramp_unit, "deceleration; 0: as the acceleration", 0);
inline constexpr ArgumentInfo fixed_pulses =
    of("m_Pulse", param::pulses, pulse_unit, "the sign is the direction", 1000);
constexpr ArgumentInfo finish_of(std::string_view name, std::string_view meaning, std::int64_t start) {
    return of(name, param::finish, pulse_unit, meaning, start);
}
inline constexpr std::string_view finish_text = "finish point, from the start; all 0: that of SetFP";
inline constexpr std::string_view arc_finish_text = "finish point, from the start; all 0: a full circle";
inline constexpr std::string_view centre_text = "centre, from the start; all 0: finish and centre of SetFP and SetCP";

}  // namespace motionrack::mcx314::functions
