// The catalogue of faults as catalogue.toml declares it: read once, for the tests that run every row and for the page
// made of it.
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

/// Where a fault is run. Its values replace "{name}" in the texts of its fault.
struct Point {
    std::string name;  ///< "slow"
    std::string test;  ///< of a fault that a test of another room runs: its name
    std::map<std::string, std::string> values;
};

/// How a fault is run, and what all faults of a group share.
struct Setup {
    std::string by;       ///< run, home, frames, session (a rack without a program), shell, test
    std::string is;       ///< what the machine is, for the page
    std::string rack;     ///< path from the project's folder, or the text itself
    std::string program;  ///< of run
    std::vector<Point> points;
};

struct Fault {
    std::string name;
    std::string does;  ///< what is injected, in words
    std::vector<std::string>
        inject;  ///< options of the program: "--fault X.motor.stall@0.3s"; of session the fault itself
    std::string before, command, after;  ///< of shell
    std::string stops;                   ///< what must stop, in words
    std::optional<double> within_ms;     ///< of simulated time after the fault; without it all goes on
    std::vector<std::string> says;       ///< what the user reads
    std::vector<std::string> shows;      ///< values afterwards: "flex.2.POSITION = 4952", "line.encoder_counts stands"
    std::string keeps;                   ///< what is kept, in words
    std::optional<bool> trusted;         ///< of run: whether the positions are
    int exit = 0;                        ///< the program's exit code
    std::vector<std::string> alarms;     ///< words of a served machine's alarms; empty: the first of `says`
    std::string state;                   ///< of a served machine afterwards; empty: see state_when_served()
    Setup setup;                         ///< the group's, with what the fault has in its place

    /// Whether a served machine is broken in the same way, too: by faults of parts, cards and wires in a program, in a
    /// search for home, or of a stage.
    bool is_served() const;
    /// "error stop" where something must stop, "standstill" where a program goes on to its end.
    std::string state_when_served() const;
    /// Words of its alarms, in order.
    std::vector<std::string> alarms_when_served() const;

    /// `text` with the point's values in place.
    static std::string at_point(std::string text, const Point& point);
};

struct Group {
    std::string name, about;
    Setup setup;
    std::vector<Fault> faults;
};

/// Errors: invalid_input with line and column, of the first thing that is wrong; io.
Result<std::vector<Group>> read_catalogue(const std::filesystem::path& file);

/// The page of reference.
std::string catalogue_page(const std::vector<Group>& groups);

}  // namespace motionrack::faults
