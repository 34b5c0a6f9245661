// Runs the program as from the command line, in a temporary folder with the examples of the project.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack {

struct Ran {
    int code = -1;
    std::string out;
};

/// Returns the output of a shell command in a folder, and its exit code; -1 if it was killed. `errors`: destination of
/// its error messages, "&1" or "/dev/null".
inline Ran run_in(const std::filesystem::path& folder, const std::string& command, const std::string& errors = "&1") {
    Ran ran;
    std::FILE* pipe = ::popen(("cd '" + folder.string() + "' && ( " + command + " ) 2>" + errors).c_str(), "r");
    if (!pipe) return ran;
    std::array<char, 4096> buffer{};
    for (std::size_t got; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        ran.out.append(buffer.data(), got);
    const int status = ::pclose(pipe);
    if (WIFEXITED(status)) ran.code = WEXITSTATUS(status);
    return ran;
}

/// Returns a command for run_in: it is interrupted `seconds` after it has installed its handler for Ctrl-C, and ends
/// with its exit code. The copy of the shell before the exec has a handler, too.
inline std::string interrupted(const std::string& command, const std::string& seconds) {
    return command +
           " & job=$!; until grep -q '^Name:.motionrack$' /proc/$job/status && "
           "grep -q '^SigCgt:.*[2367abef]$' /proc/$job/status; do kill -0 $job || break; sleep 0.01; done; sleep " +
           seconds + "; kill -INT $job; wait $job";
}

/// A folder for commands that write files.
class InFolder : public testing::Test {
  protected:
    void SetUp() override {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
        std::filesystem::create_directory_symlink(source_root / "examples", folder / "examples");
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    /// Runs a shell command; returns its terminal output, including warnings.
    Ran shell(const std::string& line) const { return run_in(folder, line); }
    Ran motionrack(const std::string& arguments) const { return shell(MOTIONRACK_PROGRAM " " + arguments); }
    /// Runs each command of a page and expects the output shown; returns the exit codes by the arguments of the
    /// commands.
    std::map<std::string, int> run_page(const std::string& path) const {
        const std::string page = text_of(source_root / path), begin = "```\n$ motionrack ";
        std::map<std::string, int> codes;
        for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
            const std::size_t command = at + begin.size(), end_of_line = page.find('\n', command),
                              end = page.find("```", end_of_line);
            const std::string arguments = page.substr(command, end_of_line - command);
            const Ran ran = motionrack(arguments);
            EXPECT_EQ(ran.out, page.substr(end_of_line + 1, end - end_of_line - 1)) << arguments;
            codes[arguments] = ran.code;
        }
        return codes;
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
    }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("motionrack_test_" + std::to_string(::getpid()));
};

}  // namespace motionrack
