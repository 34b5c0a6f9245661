// What the G-code reader must know of the machine: its axes and limits, and what a Grbl or LinuxCNC keeps between
// programs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/control/gcode/tools.hpp>
#include <motionrack/control/limits.hpp>
#include <string>

namespace motionrack::control::gcode {

inline constexpr int work_offset_count = 9;       ///< G54 .. G59, G59.1 .. G59.3
inline constexpr int grbl_work_system_count = 6;  ///< of them those that lines from a sender know

/// The text of a subprogram that a program calls by a name that it does not have itself. An error's sentence goes on
/// after "and".
using SubprogramSource = std::function<Result<std::string>(const std::string& name)>;

struct Settings {
    MachineLimits limits = {};  ///< axes present and how far they may go, machine coordinates
    bool block_delete = false;  ///< true: lines that begin with '/' are left out
    bool point_to_point =
        false;                 ///< true: each axis positions by itself, so arcs and feeds of several axes are refused
    bool probe = false;        ///< true: there is a probe; false: G38.2 .. G38.5 are refused
    bool start_in_g0 = false;  ///< true: axis words before any motion word are rapid moves, as in Grbl; false: an error
    double path_tolerance_mm = 0.01;   ///< of G64 without P, and at the start; >= 0
    double peck_clearance_mm = 0.254;  ///< G83 rapids back to this far above the depth already drilled; >= 0
    Point start = {};                  ///< where the machine is at the start, machine coordinates
    std::array<Point, work_offset_count> work_offsets = {};  ///< at the start, mm and degrees
    Point g28 = {};                                          ///< where G28 goes, machine coordinates
    Point g30 = {};                                          ///< where G30 goes, machine coordinates
    ToolTable tools = {};  ///< for G43, G41 and G42; empty: any tool number will do, but has no length and no diameter
    std::int64_t max_lines = 5'000'000;   ///< that loops and calls may go through, beside the program's own; >= 0
    std::int64_t max_steps = 20'000'000;  ///< that cycles may make, beside 16 a line; >= 0
    SubprogramSource subprogram = {};     ///< none: a program has the subs that are in its text
};

/// Refuses settings with numbers that are not finite, or larger than 1e9, or limits the wrong way round.
Result<void> check_settings(const Settings& settings);

}  // namespace motionrack::control::gcode
