// completion: a bash completion script from the command line definition.
#include <fmt/format.h>

#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <string>

namespace motionrack::cli {

namespace {

std::string bash_script(const CLI::App& app) {
    std::string commands, cases;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        commands += (commands.empty() ? "" : " ") + command->get_name();
        std::string options, names;
        const auto add_options = [&options](const CLI::App& of) {
            for (const CLI::Option* option : of.get_options())
                for (const std::string& name : option->get_lnames())
                    if ((options + " ").find(" --" + name + " ") == std::string::npos) options += " --" + name;
        };
        add_options(*command);
        for (const CLI::App* inner : command->get_subcommands([](const CLI::App*) { return true; })) {
            names += (names.empty() ? "" : " ") + inner->get_name();
            add_options(*inner);
        }
        cases += fmt::format("        {}) words=\"{}\"{} ;;\n", command->get_name(),
                             options.empty() ? "" : options.substr(1),
                             names.empty() ? "" : fmt::format(" names=\"{}\"", names));
    }
    return fmt::format(
        "# bash completion of motionrack; put this into ~/.bashrc:  eval \"$(motionrack completion)\"\n"
        "_motionrack() {{\n"
        "    local word=${{COMP_WORDS[COMP_CWORD]}} words=\"{}\" names=\n"
        "    if [ \"$COMP_CWORD\" -gt 1 ]; then\n"
        "        case ${{COMP_WORDS[1]}} in\n{}"
        "        esac\n"
        "    fi\n"
        "    case $word in\n"
        "        -*) COMPREPLY=($(compgen -W \"$words\" -- \"$word\")) ;;\n"
        "        *) if [ \"$COMP_CWORD\" -eq 1 ]; then COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
        "           elif [ \"$COMP_CWORD\" -eq 2 ] && [ -n \"$names\" ]; then COMPREPLY=($(compgen -W \"$names\" -- "
        "\"$word\"))\n"
        "           else COMPREPLY=($(compgen -f -- \"$word\")); fi ;;\n"
        "    esac\n"
        "}}\n"
        "complete -F _motionrack motionrack\n",
        commands, cases);
}

}  // namespace

void add_completion(CLI::App& app, Action& chosen) {
    CLI::App* command = app.add_subcommand("completion", "Print a bash completion script");
    command->footer("Example: eval \"$(motionrack completion)\"");
    command->callback([&app, &chosen] {
        chosen = [&app]() -> int {
            fmt::print("{}", bash_script(app));
            return exit_done;
        };
    });
}

}  // namespace motionrack::cli
