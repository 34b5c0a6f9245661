// Loading what a command works on.
#include <fmt/format.h>

#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/counted.hpp>
#include <motionrack/rack/template.hpp>

namespace motionrack::cli {

Result<ProgramText> load_program(const std::string& path) {
    if (path.empty()) return ProgramText{example_program(), "built-in example"};
    MOTIONRACK_TRY(std::string text, read_text(path));
    return ProgramText{std::move(text), path};
}

Result<ProgramText> load_rack_text(const std::string& path, BuiltInRack built_in) {
    if (path.empty() && built_in == BuiltInRack::router) return ProgramText{*rack::rack_template("router"), "built-in router"};
    if (path.empty()) return ProgramText{demonstration_rack(), "built-in demonstration"};
    MOTIONRACK_TRY(std::string text, read_text(path));
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
    for (const Error& warning : reading.warnings) print_warning(warning.text());
    for (const Error& error : reading.errors) print_error(error.text());
    if (!reading.errors.empty()) exit_code_out = exit_code(reading.errors.front().trouble);
    return reading.config;
}

int print_problems(const control::gcode::Check& check, const std::string& name) {
    if (check.problems.empty()) return exit_done;
    for (const control::gcode::Problem& problem : check.problems) print_error(problem.text());
    print_error(fmt::format("{} has {}{}; nothing was moved.", name, check.more_problems ? "at least " : "",
                            rack::counted(check.problems.size(), "problem")));
    return exit_bad_input;
}

}  // namespace motionrack::cli
