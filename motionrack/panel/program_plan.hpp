// What a program will do, without moving anything: problems, extents, the path as a polyline, and how long it takes.
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
    std::vector<PathPoint> path;        ///< thinned
    std::size_t thinned = 1;            ///< of how many places one was kept
    std::vector<float> seconds_before;  ///< of each line, from the program's begin; as planned at 100 %
    double seconds = 0, path_mm = 0;

    /// Seconds that are left when `line` begins.
    double after(std::int32_t line) const;
};

/// Reads a program that begins as `settings` say and plans it. `accel_reserve`: see control::make_look_ahead_planner.
/// Any thread.
ProgramPlan plan_program(const std::string& text, const std::string& name, const control::gcode::Settings& settings,
                         double accel_reserve);

/// `letters`: of the machine's axes.
nlohmann::json to_json(const ProgramPlan& plan, const std::string& letters);
/// A place's numbers in the order of the letters, to 0.1 um.
nlohmann::json place_json(const control::Point& place, const std::string& letters);

}  // namespace motionrack::panel
