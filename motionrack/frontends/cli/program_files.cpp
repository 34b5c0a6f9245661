// Loads the program and the rack of a command.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <motionrack/disk/outputs.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/problems_text.hpp>
#include <motionrack/rack/subprogram_files.hpp>
#include <motionrack/rack/template.hpp>

namespace motionrack::cli {

Result<ProgramText> load_program(const std::string& path) {
    if (path.empty()) return ProgramText{example_program(), "built-in example"};
    MOTIONRACK_TRY(std::string text, read_text(path));
    return ProgramText{std::move(text), path};
}

Result<ProgramText> load_rack_text(const std::string& path, BuiltInRack built_in) {
    if (path.empty() && built_in == BuiltInRack::router)
        return ProgramText{*rack::rack_template("router"), "built-in router"};
    if (path.empty()) return ProgramText{demonstration_rack(), "built-in demonstration"};
    MOTIONRACK_TRY(std::string text, read_text(path, read_limits::toml));
    return ProgramText{std::move(text), path};
}

std::optional<rack::RackConfig> load_rack(const std::string& path, int& exit_code_out, BuiltInRack built_in) {
    rack::RackReading reading;
    if (!path.empty()) {
        reading = rack::read_rack_file(path);
    } else {
        const Result<ProgramText> text = load_rack_text(path, built_in);
        reading = rack::read_rack_text(text->text, text->name);
    }
    return print_reading(std::move(reading), exit_code_out);
}

std::optional<rack::RackConfig> print_reading(rack::RackReading reading, int& exit_code_out) {
    for (const Error& warning : reading.warnings) print_warning(warning.text());
    for (const Error& error : reading.errors) print_error(error.text());
    if (!reading.errors.empty()) exit_code_out = exit_code(reading.errors.front().kind);
    return reading.config;
}

control::gcode::Settings program_settings(const rack::RackConfig& config, const std::string& path, bool block_delete) {
    control::gcode::Settings settings = rack::reader_settings(config, block_delete);
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(path, unknown)) return settings;
    settings.subprogram = rack::subprograms_in(std::filesystem::path(path).parent_path());
    return settings;
}

void add_reading_options(CLI::App& command, ReadingOptions& options, const char* tools) {
    command.add_option(tools, options.tools,
                       "tool table (LinuxCNC's .tbl) with the lengths for G43 and the diameters for G41, G42");
    command.add_flag("--block-delete", options.block_delete, "skip lines that begin with '/'");
}

std::optional<control::gcode::Settings> program_settings(const rack::RackConfig& config, const std::string& path,
                                                         const ReadingOptions& options, int& exit_code_out) {
    control::gcode::Settings settings = program_settings(config, path, options.block_delete);
    if (options.tools.empty()) return settings;
    const Result<std::string> text = read_text(options.tools, read_limits::table);
    Result<control::gcode::ToolTable> tools =
        text ? control::gcode::read_tool_table(*text, options.tools) : tl::unexpected<Error>(text.error());
    if (!tools) {
        exit_code_out = report(tools.error());
        return std::nullopt;
    }
    settings.tools = std::move(*tools);
    return settings;
}

void note_subprograms(control::gcode::Settings& settings, const std::string& program, std::vector<std::string>& files) {
    if (!settings.subprogram) return;
    settings.subprogram = [load = settings.subprogram, folder = std::filesystem::path(program).parent_path(),
                           &files](const std::string& name) -> Result<std::string> {
        std::string file = rack::subprogram_file(folder, name).string();
        if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(std::move(file));
        return load(name);
    };
}

bool may_write(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
    const Result<void> may = disk::may_write(inputs, outputs);
    if (!may) print_error(may.error().message);
    return may.has_value();
}

int print_problems(const control::gcode::ProgramCheck& check, const std::string& name) {
    if (check.problems.empty()) return exit_done;
    for (const control::gcode::Problem& problem : check.problems) print_error(problem.text());
    print_error(rack::problems_verdict(check, name));
    return rack::has_unreadable(check) ? exit_io : exit_invalid_input;
}

}  // namespace motionrack::cli
