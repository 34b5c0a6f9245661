// manual: the manual page motionrack(1) from the command line definition.
#include <fmt/format.h>

#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace motionrack::cli {

namespace {

/// Escapes text for troff, so that it contains neither requests nor escapes.
std::string plain(const std::string& text) {
    std::string out;
    bool line_start = true;
    for (const char c : text) {
        if (line_start && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '\'')
            out += "\\(aq";
        else
            out += c;
        line_start = c == '\n';
    }
    return out;
}

/// Returns every command, each followed by the commands of its group.
std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    std::vector<const CLI::App*> out;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        out.push_back(command);
        const std::vector<const CLI::App*> inner = commands_of(*command);
        out.insert(out.end(), inner.begin(), inner.end());
    }
    return out;
}

/// Returns the full name of a command in a group: "frames publish".
std::string name_of(const CLI::App& command, const CLI::App& app) {
    return (command.get_parent() == &app ? "" : name_of(*command.get_parent(), app) + " ") + command.get_name();
}

/// Returns "--rack FILE": the option names in bold and its argument.
std::string head_of(const CLI::Option& option) {
    std::string names;
    for (const std::string& name : option.get_snames())
        names += (names.empty() ? "" : ", ") + std::string("\\fB") + plain("-" + name) + "\\fR";
    for (const std::string& name : option.get_lnames())
        names += (names.empty() ? "" : ", ") + std::string("\\fB") + plain("--" + name) + "\\fR";
    if (names.empty()) return "\\fI" + plain(option.get_name(true)) + "\\fR";
    if (option.get_items_expected_max() > 0 && option.get_type_size_max() > 0)
        names += " \\fI" + plain(option.get_type_name()) + "\\fR";
    return names;
}

std::string options_of(const CLI::App& command) {
    std::string out;
    for (const CLI::Option* option : command.get_options()) {
        if (option == command.get_help_ptr() && command.get_parent()) continue;  // common to all commands: listed once
        out += ".TP\n" + head_of(*option) + "\n" + plain(option->get_description());
        if (!option->get_default_str().empty()) out += plain(" (default: " + option->get_default_str() + ")");
        if (option->get_required()) out += " (required)";
        out += '\n';
    }
    return out;
}

std::string verbatim(const std::string& text) {
    return text.empty() ? "" : ".PP\n.nf\n" + plain(text) + "\n.fi\n";
}

std::string page(const CLI::App& app) {
    std::string out = fmt::format(".TH MOTIONRACK 1 \"\" \"motionrack {}\" \"User Commands\"\n", MOTIONRACK_VERSION);
    out += ".SH NAME\nmotionrack \\- a rack of motion\\-control cards, in software\n";
    out += ".SH SYNOPSIS\n.B motionrack\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n";
    out += ".SH DESCRIPTION\n" + plain(app.get_description()) + "\n";
    out += ".SH OPTIONS\n" + options_of(app);
    out += ".SH COMMANDS\n";
    for (const CLI::App* command : commands_of(app))
        out += ".SS " + plain(name_of(*command, app)) + "\n" + plain(command->get_description()) + ".\n" +
               options_of(*command) + verbatim(command->get_footer());
    out += ".SH EXAMPLES AND EXIT CODES\n" + verbatim(app.get_footer());
    return out;
}

}  // namespace

void add_manual(CLI::App& app, Action& chosen) {
    CLI::App* command = app.add_subcommand("manual", "Print the manual page");
    command->footer("Example: motionrack manual | man -l -");
    command->callback([&app, &chosen] {
        chosen = [&app]() -> int {
            fmt::print("{}", page(app));
            return exit_done;
        };
    });
}

}  // namespace motionrack::cli
