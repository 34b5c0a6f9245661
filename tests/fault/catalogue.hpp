// Catalogue of faults from catalogue.toml: read once, for the tests of every row and for the generated page.
//
//   catalogue.toml ──read_catalogue──► groups ──► faults ──► two operating points each
//                                                   ├──► fault_test.cpp runs them (ctest -L fault)
//                                                   └──► page.cpp writes docs/reference/faults.md
#pragma once

#include <filesystem>
#include <map>
#include <motionrack/base/result.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::faults {

/// Operating point of a fault. Its values replace "{name}" in the texts of the fault.
struct Point {
    std::string name;  ///< "slow"
    std::string test;  ///< name of the test, for a fault that another module tests
    std::map<std::string, std::string> values;
};

/// How a fault is run; shared by the faults of a group.
struct Setup {
    std::string by;       ///< run, home, frames, session (a rack without a program), program (its text), shell, test
    std::string is;       ///< description of the machine, for the page
    std::string rack;     ///< path relative to the project folder, or the text itself
    std::string program;  ///< for run and program
    bool served = false;  ///< what runs it, a command or the tests of another module, is a served machine
    std::vector<Point> points;
};

struct Fault {
    std::string name;
    std::string does;                    ///< description of the injected fault
    std::vector<std::string> inject;     ///< program options "--fault X.motor.stall@0.3s"; for session the fault itself
    std::string before, command, after;  ///< for shell
    std::string stops;                   ///< description of the part that must stop
    std::optional<double> within_ms;     ///< simulated time after the fault; empty: the run continues
    std::vector<std::string> says;       ///< messages to the user
    std::vector<std::string> shows;      ///< values afterwards: "flex.2.POSITION = 4952", "line.encoder_counts stands"
    std::string keeps;                   ///< description of the data that is kept
    std::optional<bool> positions_valid;  ///< for run: whether the positions are valid afterwards
    int exit = 0;                         ///< exit code of the program
    std::vector<std::string> alarms;      ///< words of the alarms of a served machine; empty: the first of `says`
    std::string state;                    ///< state of a served machine afterwards; empty: see state_when_served()
    Setup setup;                          ///< settings of the group, overridden by those of the fault

    /// Returns true if the fault is also tested in a served machine. These are faults of parts, cards and wires in a
    /// program or a homing, and stage faults.
    bool is_served() const;
    /// Return true if its points are tried by a run, or another command; and in a served machine.
    bool is_tried_alone() const { return !setup.served; }
    bool is_tried_served() const { return setup.served || setup.by == "program" || is_served(); }
    /// Returns "error stop" if motion must stop, "standstill" if the program runs to its end.
    std::string state_when_served() const;
    /// Words of the alarms, in order.
    std::vector<std::string> alarms_when_served() const;

    /// Replaces the placeholders in `text` by the values of the point.
    static std::string at_point(std::string text, const Point& point);
};

struct Group {
    std::string name, about;
    Setup setup;
    std::vector<Fault> faults;
};

/// Errors: invalid_input with line and column of the first error; io.
Result<std::vector<Group>> read_catalogue(const std::filesystem::path& file);

/// Returns the reference page.
std::string catalogue_page(const std::vector<Group>& groups);

}  // namespace motionrack::faults
