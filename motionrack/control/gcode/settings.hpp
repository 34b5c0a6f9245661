// What the G-code reader must know of the machine: its axes and limits, and what a Grbl or LinuxCNC keeps between
// programs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/control/limits.hpp>
#include <optional>

namespace motionrack::control::gcode {

inline constexpr int work_system_count = 6;  ///< G54 .. G59

struct Settings {
    MachineLimits limits = {};  ///< axes present and how far they may go, machine coordinates
    bool block_delete = false;  ///< true: lines that begin with '/' are left out
    bool point_to_point = false;  ///< true: each axis positions by itself, so arcs and feeds of several axes are refused
    bool probe = false;  ///< true: there is a probe; false: G38.2 .. G38.5 are refused
    bool start_in_g0 = false;  ///< true: axis words before any motion word are rapid moves, as in Grbl; false: an error
    double path_tolerance_mm = 0.01;   ///< of G64 without P, and at the start; >= 0
    double peck_clearance_mm = 0.254;  ///< G83 rapids back to this far above the depth already drilled; >= 0
    Point start = {};                  ///< where the machine is at the start, machine coordinates
    std::array<Point, work_system_count> work_offsets = {};  ///< G54 .. G59 at the start, mm and degrees
    Point g28 = {};                                          ///< where G28 goes, machine coordinates
    Point g30 = {};                                          ///< where G30 goes, machine coordinates
    /// For G41 and G42: the diameter (mm) of the tool of that number; none: the table has no such tool. Empty: there is
    /// no tool table.
    std::function<std::optional<double>(std::int32_t tool)> tool_diameter;
};

/// Refuses settings with numbers that are not finite, or larger than 1e9, or limits the wrong way round.
Result<void> check_settings(const Settings& settings);

}  // namespace motionrack::control::gcode
