// One-line text for the problems found by a program check.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <string>

namespace motionrack::rack {

/// Returns true if a file access is among the causes: an unreadable subprogram.
inline bool has_unreadable(const control::gcode::ProgramCheck& check) {
    return std::any_of(check.problems.begin(), check.problems.end(),
                       [](const control::gcode::Problem& problem) { return problem.kind == ErrorKind::io; });
}

/// Returns "part.ngc has 3 problems; nothing was moved."
inline std::string problems_verdict(const control::gcode::ProgramCheck& check, const std::string& name) {
    return fmt::format("{} has {}{}; nothing was moved.", name, check.more_problems ? "at least " : "",
                       count_noun(check.problems.size(), "problem"));
}

}  // namespace motionrack::rack
