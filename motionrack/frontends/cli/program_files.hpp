// Program and rack of a command: from files, or the built-in example.
#pragma once

#include <CLI/CLI.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/rack/config.hpp>
#include <optional>
#include <string>

namespace motionrack::cli {

/// Built-in example program (examples/02_part/part.ngc).
const char* example_program();
/// Rack with every card type (examples/15_panel/demonstration.toml).
const char* demonstration_rack();

/// Text of a part program and its display name.
struct ProgramText {
    std::string text;
    std::string name;
};

/// Reads a part program ("-": standard input; empty: built-in example). Errors: io.
Result<ProgramText> load_program(const std::string& path);

enum class BuiltInRack { router, demonstration };
/// Reads a rack file and prints its warnings and errors. Returns nothing on errors. An empty path selects the built-in
/// rack.
std::optional<rack::RackConfig> load_rack(const std::string& path, int& exit_code,
                                          BuiltInRack built_in = BuiltInRack::router);

/// Prints the warnings and errors of a reading. Returns nothing on errors.
std::optional<rack::RackConfig> print_reading(rack::RackReading reading, int& exit_code);

/// Returns the text that load_rack reads from this path, with its display name. Errors: io.
Result<ProgramText> load_rack_text(const std::string& path, BuiltInRack built_in = BuiltInRack::router);

/// User options for reading a program.
struct ReadingOptions {
    std::string tools;  ///< path of a tool table; empty: no table
    bool block_delete = false;
};
/// Adds these options to a command. `tools`: name of the option for the tool table.
void add_reading_options(CLI::App& command, ReadingOptions& options, const char* tools = "--tools");

/// Settings for reading a program: the axes of the rack, and the subprograms beside the file as name.ngc. Standard
/// input and the built-in example have no folder.
control::gcode::Settings program_settings(const rack::RackConfig& config, const std::string& path,
                                          bool block_delete = false);
/// As above, with the user's tool table. If the table cannot be read, prints the error and returns nothing.
std::optional<control::gcode::Settings> program_settings(const rack::RackConfig& config, const std::string& path,
                                                         const ReadingOptions& options, int& exit_code);

/// Adds the file of each subprogram that is read from now on to `files`, once per file.
void note_subprograms(control::gcode::Settings& settings, const std::string& program, std::vector<std::string>& files);

/// Checks that the outputs of a command may be written, see disk::may_write. On false, an error that names the rejected
/// output was printed.
bool may_write(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// Maximum number of problems collected by a check, and by a run, which needs only the first ones.
inline constexpr std::size_t max_problems = 100, max_problems_of_run = 20;
/// Prints the problems with their lines and count. Returns the exit code (0 without problems).
int print_problems(const control::gcode::ProgramCheck& check, const std::string& name);

}  // namespace motionrack::cli
