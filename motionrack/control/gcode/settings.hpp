// Settings of the G-code reader: axes and limits of the machine, and the state that Grbl or LinuxCNC store between
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

inline constexpr int work_offset_count = 9;       ///< number of work systems: G54 .. G59, G59.1 .. G59.3
inline constexpr int grbl_work_system_count = 6;  ///< number of work systems for lines from a sender: G54 .. G59

/// Provides the text of a subprogram that a program calls by name but does not contain. The sentence of an error
/// continues after "and".
using SubprogramSource = std::function<Result<std::string>(const std::string& name)>;

struct Settings {
    MachineLimits limits = {};  ///< axes that are present, with their travel, in machine coordinates
    bool block_delete = false;  ///< true: lines that begin with '/' are skipped
    bool point_to_point =
        false;  ///< true: each axis positions independently, so arcs and feed moves of several axes are refused
    bool probe = false;        ///< true: a probe is connected; false: G38.2 .. G38.5 are refused
    bool start_in_g0 = false;  ///< true: axis words before any motion word are rapids, as in Grbl; false: an error
    double path_tolerance_mm = 0.01;   ///< default tolerance of G64 without P or with P0; >= 0
    double peck_clearance_mm = 0.254;  ///< G83 rapids back to this distance above the drilled depth; >= 0
    Point start = {};                  ///< initial position, machine coordinates
    std::array<Point, work_offset_count> work_offsets = {};  ///< initial work offsets, mm and degrees
    Point g28 = {};                                          ///< target of G28, machine coordinates
    Point g30 = {};                                          ///< target of G30, machine coordinates
    ToolTable tools = {};  ///< for G43, G41 and G42; empty: any tool number is valid, with zero length and diameter
    /// Maximum number of lines that loops and calls may execute, beyond those of the program; >= 0.
    std::int64_t max_lines = 5'000'000;
    /// Maximum number of moves that cycles may generate, beyond 16 per line; >= 0.
    std::int64_t max_steps = 20'000'000;
    SubprogramSource subprogram = {};  ///< none: only the subs in the text of the program
};

/// Refuses settings with numbers that are not finite or above 1e9, or with inverted limits.
Result<void> check_settings(const Settings& settings);

}  // namespace motionrack::control::gcode
