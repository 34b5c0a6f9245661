// Dry run of a program without motion: problems, extents, the path as a polyline, and the duration.
#pragma once

#include <memory>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/panel/polyline.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace motionrack::panel {

struct ProgramPlan {
    std::string name;
    control::gcode::ProgramCheck check;
    std::vector<PathPoint> path;        ///< polyline of limited length, see `thinned`
    std::size_t thinned = 1;            ///< every n-th point is stored; a power of two
    std::vector<float> seconds_before;  ///< by line, from the start of the program; as planned at 100 %
    double seconds = 0, path_mm = 0;

    /// Returns the seconds from the start of `line` to the end of the program.
    double after(std::int32_t line) const;
};

/// Reads a program with the initial state in `settings` and plans it. `accel_reserve`: see
/// control::make_look_ahead_planner. Any thread.
ProgramPlan plan_program(const std::string& text, const std::string& name, const control::gcode::Settings& settings,
                         double accel_reserve);

/// `letters`: axis letters of the machine.
nlohmann::json to_json(const ProgramPlan& plan, const std::string& letters);
/// Returns the coordinates in the order of the letters, to 0.1 um.
nlohmann::json position_json(const control::Point& position, const std::string& letters);

}  // namespace motionrack::panel
