// The program and the rack a command works on: files, or the built-in example.
#pragma once

#include <CLI/CLI.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/rack/config.hpp>
#include <optional>
#include <string>

namespace motionrack::cli {

/// The example that comes with the program (examples/02_part/part.ngc).
const char* example_program();
/// The rack with all kinds of card (examples/15_panel/demonstration.toml).
const char* demonstration_rack();

/// A part program's text and what to call it.
struct ProgramText {
    std::string text;
    std::string name;
};

/// Reads a part program ("-": standard input); an empty path is the built-in example. Errors: io.
Result<ProgramText> load_program(const std::string& path);

enum class BuiltInRack { router, demonstration };
/// Reads a rack file, prints its warnings, and every error; nothing if there are errors. An empty path is the built-in
/// one.
std::optional<rack::RackConfig> load_rack(const std::string& path, int& exit_code,
                                          BuiltInRack built_in = BuiltInRack::router);

/// The warnings of a reading, and every error; nothing if there are errors.
std::optional<rack::RackConfig> print_reading(rack::RackReading reading, int& exit_code);

/// The text that load_rack reads from this path, and what it is called. Errors: io.
Result<ProgramText> load_rack_text(const std::string& path, BuiltInRack built_in = BuiltInRack::router);

/// What a user says of how a program is read.
struct ReadingOptions {
    std::string tools;  ///< path of a tool table; empty: there is none
    bool block_delete = false;
};
/// `tools`: what the option is called.
void add_reading_options(CLI::App& command, ReadingOptions& options, const char* tools = "--tools");

/// How a program is read: by the rack's axes, with the subprograms that lie beside it as name.ngc. Programs from
/// standard input and the built-in example have no folder.
control::gcode::Settings program_settings(const rack::RackConfig& config, const std::string& path,
                                          bool block_delete = false);
/// The same with the user's tool table; nothing if that cannot be read, which was told.
std::optional<control::gcode::Settings> program_settings(const rack::RackConfig& config, const std::string& path,
                                                         const ReadingOptions& options, int& exit_code);

/// Adds the file of each subprogram that is read from now on to `files`, once.
void note_subprograms(control::gcode::Settings& settings, const std::string& program, std::vector<std::string>& files);

/// Whether the outputs of a command may be written: see disk::may_write. False: an error was printed that names the one
/// which may not.
bool may_write(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// How many problems a check for people collects; of a program that is to run the first ones are enough.
inline constexpr std::size_t max_problems = 100, max_problems_of_run = 20;
/// Prints the problems that were found with their lines, and how many there are; the exit code (0 if there are none).
int print_problems(const control::gcode::ProgramCheck& check, const std::string& name);

}  // namespace motionrack::cli
