// The programs of tests/golden/canon with the stored output of LinuxCNC's rs274 -g; rs274 itself can be run as well.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <motionrack/control/gcode/canon.hpp>
#include <sstream>
#include <tests/source_root.hpp>

#include "gcode_support.hpp"

namespace motionrack::control::gcode::testing::corpus {

inline std::string folder() {
    return source_dir() + "/tests/golden/canon/";
}

inline std::string file_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Returns the programs that have stored calls; files of subprograms have none.
inline std::vector<std::string> names() {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
        if (entry.path().extension() == ".canon") out.push_back(entry.path().stem());
    std::sort(out.begin(), out.end());
    return out;
}

/// Returns true if a program uses the tool table: its name begins with "tools".
inline bool has_tools(const std::string& name) {
    return name.starts_with("tools");
}

inline Settings settings_of(const std::string& name) {
    Settings settings = machine("XYZABC", 1e5);
    if (has_tools(name)) settings.tools = *read_tool_table(file_text(folder() + "tools.tbl"));
    settings.subprogram = [](const std::string& sub) -> Result<std::string> {
        return file_text(folder() + sub + ".ngc");
    };
    return settings;
}

/// Returns only moves, waits and outputs, without the leading columns and without the sign of zeros.
inline std::string motion_lines(const std::string& canon) {
    std::string out;
    std::istringstream lines(canon);
    for (std::string line; std::getline(lines, line);) {
        for (const char* start : {"STRAIGHT_", "ARC_FEED", "DWELL", "SET_MOTION_OUTPUT", "CLEAR_MOTION_OUTPUT",
                                  "SET_AUX_OUTPUT", "CLEAR_AUX_OUTPUT"}) {
            const std::size_t at = line.find(start);
            if (at == std::string::npos || line.find("COMMENT") != std::string::npos) continue;
            std::string call = line.substr(at);
            for (std::size_t zero; (zero = call.find("-0.0000")) != std::string::npos;) call.erase(zero, 1);
            out += call + '\n';
        }
    }
    return out;
}

/// Returns true for programs with lathe cycles. Our cycles skip moves of zero length, while rs274 prints them.
inline bool turns(const std::string& name) {
    return name.starts_with("lathe");
}

/// Removes the lines that end where the previous one ended.
inline std::string that_lead_on(const std::string& lines) {
    std::string out, last;
    std::istringstream text(lines);
    for (std::string line; std::getline(text, line);) {
        const std::size_t open = line.find('(');
        std::vector<std::string> n;
        std::istringstream numbers(line.substr(open + 1));
        for (std::string one; std::getline(numbers, one, ',');) n.push_back(one.substr(one.find_first_not_of(' ')));
        const std::string to =
            line.starts_with("ARC") ? n.at(1) + ' ' + n.at(0) : n.at(0) + ' ' + n.at(2);  // X Z; G18 arcs have Z first
        if (to != last) out += line + '\n';
        last = to;
    }
    return out;
}

inline std::string compared(const std::string& name, const std::string& canon) {
    return turns(name) ? that_lead_on(motion_lines(canon)) : motion_lines(canon);
}

inline std::string printed(const std::string& program, CanonOptions options = {},
                           const Settings& settings = machine("XYZABC", 1e5)) {
    std::string out;
    const auto done = print_canon(program, settings, options, [&](std::string_view line) { out += line; });
    EXPECT_TRUE(done) << done.error().text();
    return out;
}

}  // namespace motionrack::control::gcode::testing::corpus
