// check, canon and new: commands on files that do not move anything.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <motionrack/control/gcode/canon.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/rack/count_noun.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/template.hpp>
#include <nlohmann/json.hpp>
#include <vector>

namespace motionrack::cli {

namespace {

using rack::count_noun;

struct CheckOptions {
    std::vector<std::string> files;
    std::string rack;
    ReadingOptions reading;
    bool json = false;
};

nlohmann::json error_json(const Error& error) {
    return {{"file", error.file},
            {"line", error.location.line},
            {"column", error.location.column},
            {"message", error.message}};
}

bool is_rack_file(const std::string& path) {
    return path.size() > 5 && path.substr(path.size() - 5) == ".toml";
}

int check_rack(const std::string& path, nlohmann::json* json) {
    const rack::RackReading reading = rack::read_rack_file(path);
    if (json) {
        nlohmann::json entry = {{"file", path},
                                {"ok", reading.errors.empty()},
                                {"errors", nlohmann::json::array()},
                                {"warnings", nlohmann::json::array()}};
        for (const Error& error : reading.errors) entry["errors"].push_back(error_json(error));
        for (const Error& warning : reading.warnings) entry["warnings"].push_back(error_json(warning));
        json->push_back(entry);
    } else {
        for (const Error& warning : reading.warnings) print_warning(warning.text());
        for (const Error& error : reading.errors) print_error(error.text());
        if (reading.config)
            fmt::print("{}: good. {}: {}, {}, {}.\n", path, reading.config->name,
                       count_noun(reading.config->cards.size(), "card"),
                       count_noun(reading.config->axes.size(), "axis", "axes"),
                       count_noun(reading.config->wires.size(), "wire"));
        else
            fmt::print("{}: {}.\n", path, count_noun(reading.errors.size(), "error"));
    }
    return reading.errors.empty() ? exit_done : exit_code(reading.errors.front().kind);
}

int check_program_file(const std::string& path, const CheckOptions& options, nlohmann::json* json) {
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    const Result<std::string> text = read_text(path);
    if (!text) return report(text.error());
    const auto settings = program_settings(*config, path, options.reading, code);
    if (!settings) return code;
    const control::gcode::ProgramCheck check = control::gcode::check_program(*text, *settings, max_problems, path);
    if (json) {
        nlohmann::json entry = {{"file", path},           {"ok", check.problems.empty()},
                                {"lines", check.lines},   {"moves", check.moves},
                                {"dwells", check.dwells}, {"errors", nlohmann::json::array()}};
        for (const auto& problem : check.problems) {
            nlohmann::json one = error_json(problem);
            one["word"] = problem.word;
            one["grbl_error"] = static_cast<int>(problem.status);
            entry["errors"].push_back(one);
        }
        json->push_back(entry);
        return check.problems.empty() ? exit_done : exit_invalid_input;
    }
    if (const int bad = print_problems(check, path); bad != exit_done) return bad;
    fmt::print("{}: good. {}, {}, {}", path, count_noun(check.lines, "line"), count_noun(check.moves, "move"),
               count_noun(check.dwells, "dwell"));
    for (const rack::RackAxis& axis : config->axes) {
        const auto i = static_cast<std::size_t>(axis.index());
        fmt::print("{} {} {:.3f} to {:.3f} {}", i == 0 ? ";" : ",", axis.letter, check.min[i], check.max[i],
                   axis.unit());
    }
    fmt::print(" (machine coordinates).\n");
    return exit_done;
}

/// Six axes without travel limits.
control::MachineLimits boundless() {
    control::MachineLimits limits = {};
    for (control::AxisLimits& axis : limits) {
        axis.present = true;
        axis.min_position = -1e9;
        axis.max_position = 1e9;
    }
    return limits;
}

int check(const CheckOptions& options) {
    int result = exit_done;
    nlohmann::json json = nlohmann::json::array();
    for (const std::string& path : options.files) {
        nlohmann::json* to = options.json ? &json : nullptr;
        const int code = is_rack_file(path) ? check_rack(path, to) : check_program_file(path, options, to);
        if (result == exit_done) result = code;
    }
    if (options.json) fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    return result;
}

}  // namespace

void add_check(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command =
        app.add_subcommand("check", "List all errors of rack files (*.toml) and part programs; nothing moves");
    command->add_option("FILE", options->files, "rack files and part programs")->required();
    command->add_option("--rack", options->rack,
                        "rack file that the programs are checked against (default: the built-in router)");
    add_reading_options(*command, options->reading);
    command->add_flag("--json", options->json, "print the findings as JSON");
    command->footer("Example: motionrack check my.toml part.ngc --rack my.toml");
    command->callback([options, &chosen] { chosen = [options] { return check(*options); }; });
}

void add_canon(CLI::App& app, Action& chosen) {
    struct Options {
        std::string file, rack;
        ReadingOptions reading;
        bool machine = false, numbered = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "canon", "Print the canonical calls of a part program, one a line, as LinuxCNC's rs274 -g does");
    command->add_option("FILE", options->file, "part program ('-': standard input)")->required();
    command->add_option("--rack", options->rack,
                        "rack file whose axes, limits and start count (default: six axes without limits, at 0)");
    command->add_flag("--machine", options->machine,
                      "machine coordinates in mm and degrees instead of the program's own");
    add_reading_options(*command, options->reading, "-t,--tools");
    command->add_flag("--numbered", options->numbered,
                      "with the two columns of numbers that rs274 prints before each call");
    command->footer("Example: motionrack canon part.ngc | grep ARC_FEED");
    command->callback([options, &chosen] {
        chosen = [options]() -> int {
            namespace gcode = control::gcode;
            int code = exit_done;
            std::optional<rack::RackConfig> config = rack::RackConfig();
            if (!options->rack.empty()) config = load_rack(options->rack, code);
            if (!config) return code;
            const Result<std::string> text = read_text(options->file);
            if (!text) return report(text.error());
            gcode::CanonOptions how;
            how.coordinates = options->machine ? gcode::Coordinates::machine : gcode::Coordinates::program;
            how.numbered = options->numbered;
            auto settings = program_settings(*config, options->file, options->reading, code);
            if (!settings) return code;
            if (options->rack.empty()) settings->limits = boundless();
            settings->probe = true;  // accepts probing moves even if the rack has no probe
            const auto done = gcode::print_canon(
                *text, *settings, how, [](std::string_view line) { std::fwrite(line.data(), 1, line.size(), stdout); },
                options->file);
            return done ? static_cast<int>(exit_done) : report(done.error());
        };
    });
}

void add_new(CLI::App& app, Action& chosen) {
    struct Options {
        std::string variant = "router", file;
        bool force = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("new", "Write a commented rack file to start from");
    std::string kinds;
    for (const rack::TemplateVariant& variant : rack::template_variants())
        kinds += fmt::format("{}{}: {}", kinds.empty() ? "" : "; ", variant.name, variant.doc);
    command->add_option("KIND", options->variant, kinds)->capture_default_str();
    command->add_option("FILE", options->file, "where to write it (default: standard output)");
    command->add_flag("--force", options->force, "overwrite FILE if it is there");
    command->footer("Example: motionrack new router my.toml");
    command->callback([options, &chosen] {
        chosen = [options]() -> int {
            const Result<std::string> text = rack::rack_template(options->variant);
            if (!text) return report(text.error());
            if (options->file.empty()) {
                fmt::print("{}", *text);
                return exit_done;
            }
            if (!options->force) {
                if (std::FILE* there = std::fopen(options->file.c_str(), "rb")) {
                    std::fclose(there);
                    print_error(
                        fmt::format("{} is there already and was left as it is; choose another name or add --force.",
                                    options->file));
                    return exit_refused;
                }
            }
            if (!may_write({}, {options->file})) return exit_refused;
            const Result<void> written = write_text(options->file, *text);
            if (!written) return report(written.error());
            fmt::print("{} written. Next: motionrack check {}\n", options->file, options->file);
            return exit_done;
        };
    });
}

}  // namespace motionrack::cli
