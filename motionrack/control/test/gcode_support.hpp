// Shared by the G-code tests: a machine, a whole program as a list of calls, and the problem of one line.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <motionrack/control/gcode/program_reader.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::control::gcode::testing {

/// Returns a machine with these axes, each from -500 to 500.
inline Settings machine(std::string_view axes = "XYZABC", double reach = 500) {
    Settings settings;
    settings.probe = true;
    for (int axis = 0; axis < axis_count; ++axis) {
        AxisLimits& limits = settings.limits[axis];
        limits.present = axes.find(axis_letters[axis]) != std::string_view::npos;
        limits.min_position = -reach;
        limits.max_position = reach;
    }
    return settings;
}

struct Program {
    std::vector<CanonCall> steps;
    std::vector<Problem> problems;

    std::vector<Move> moves() const {
        std::vector<Move> out;
        for (const CanonCall& step : steps) {
            if (step.kind == CanonCallKind::move) out.push_back(step.move);
        }
        return out;
    }
};

/// Reads all of `text` and continues after problems. The texts of the calls point into `text`.
inline Program read(std::string_view text, const Settings& settings = machine()) {
    Program program;
    ProgramReader reader(text, settings, "part.ngc");
    for (;;) {
        auto step = reader.next();
        if (!step) {
            program.problems.push_back(step.error());
        } else if (*step == nullptr) {
            return program;
        } else {
            program.steps.push_back(**step);
        }
    }
}

/// A program whose last line is the first refused one: at this column, with this text in its sentence.
struct Refused {
    const char* program;
    int column;
    const char* says;
};

inline void expect_refused(const std::string& preamble, std::span<const Refused> rows,
                           const Settings& settings = machine()) {
    for (const Refused& row : rows) {
        SCOPED_TRACE(row.program);
        const std::string text = preamble + row.program;
        const auto program = read(text, settings);
        ASSERT_GE(program.problems.size(), 1u);
        EXPECT_EQ(program.problems[0].location.line, 1 + std::count(text.begin(), text.end(), '\n'));
        EXPECT_EQ(program.problems[0].location.column, row.column);
        EXPECT_NE(program.problems[0].message.find(row.says), std::string::npos) << program.problems[0].message;
    }
}

/// A program whose first problem is in this line, with this text in its sentence.
struct RefusedAt {
    const char* program;
    int line;
    const char* says;
};

inline void expect_refused_at(std::span<const RefusedAt> rows, const Settings& settings) {
    for (const RefusedAt& row : rows) {
        SCOPED_TRACE(row.program);
        const auto program = read(row.program, settings);
        ASSERT_FALSE(program.problems.empty());
        EXPECT_EQ(program.problems[0].location.line, row.line);
        EXPECT_EQ(program.problems[0].file, "part.ngc");
        EXPECT_NE(program.problems[0].message.find(row.says), std::string::npos) << program.problems[0].message;
    }
}

/// Returns settings (by default of a machine with long travels) with G0 as initial mode, for programs that test the
/// order of lines.
inline Settings in_g0(Settings settings = machine("XYZABC", 1e6)) {
    settings.start_in_g0 = true;
    return settings;
}

/// Returns the X of all moves of a program in_g0() without problems.
inline std::vector<double> xs(const std::string& program, const Settings& settings = in_g0()) {
    const auto whole = read(program, in_g0(settings));
    for (const Problem& problem : whole.problems) ADD_FAILURE() << problem.text();
    std::vector<double> out;
    for (const Move& move : whole.moves()) out.push_back(move.end[0]);
    return out;
}

/// Formats all relevant fields of a move, for an exact comparison except for line numbers.
inline std::string describe(const Move& move) {
    std::string out = std::to_string(static_cast<int>(move.kind)) + ' ' + std::to_string(static_cast<int>(move.path)) +
                      ' ' + std::to_string(static_cast<int>(move.feed_mode)) + ' ' + std::to_string(move.turns);
    char number[40];
    const auto add = [&](double value) {
        std::snprintf(number, sizeof number, " %.17g", value);
        out += number;
    };
    for (const double value : {move.feed, move.tolerance_mm, move.centre_first, move.centre_second, move.seconds})
        add(value);
    for (const double value : move.end) add(value);
    return out;
}

}  // namespace motionrack::control::gcode::testing
