// LinuxCNC's interpreter, where it is installed (Debian: linuxcnc-uspace).
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "gcode_corpus.hpp"

namespace motionrack::control::gcode::testing::corpus {

inline bool is_installed() {
    return std::system("command -v rs274 >/dev/null 2>&1") == 0;
}

/// A folder that is deleted when the test ends.
class Folder {
  public:
    Folder() : path_(std::filesystem::temp_directory_path() / fmt::format("motionrack-rs274-{}", ::getpid())) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    std::string file(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline void write(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// Returns the tool table in inches, the machine units of rs274 -g.
inline std::string table_in_inches() {
    const ToolTable table = *read_tool_table(file_text(folder() + "tools.tbl"));
    std::string out;
    for (Tool tool : table.tools()) {
        for (std::size_t axis = 0; axis < 3; ++axis) tool.offset[axis] /= 25.4;
        tool.diameter_mm /= 25.4;
        out += to_text(tool) + "\n";
    }
    return out;
}

/// Returns the output of rs274 for a file in the folder. It stores tools in a file of the home folder, which parallel
/// runs would share.
inline std::string of_rs274(const Folder& at, const std::string& name, bool tools) {
    std::filesystem::remove(at.file("x.var"));
    const std::string command = fmt::format("cd '{}' && HOME=. timeout 120 rs274 -g {} -v x.var {}.ngc 2>&1",
                                            at.path().string(), tools ? "-t tools.tbl" : "", name);
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::string out;
    char part[4096];
    for (std::size_t got; pipe && (got = std::fread(part, 1, sizeof part, pipe)) > 0;) out.append(part, got);
    if (pipe) ::pclose(pipe);
    return out;
}

}  // namespace motionrack::control::gcode::testing::corpus
