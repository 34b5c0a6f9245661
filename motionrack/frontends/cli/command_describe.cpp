// describe: registers, commands, states and pins of a card; keys of a rack file, marking job or sweep file; G and M
// codes; or operations of a served machine.
#include <fmt/format.h>

#include <memory>
#include <motionrack/base/describe.hpp>
#include <motionrack/control/gcode/words.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/mark/marking_job.hpp>
#include <motionrack/panel/operation_specs.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/stop_reactions.hpp>
#include <motionrack/sweep/sweep_file.hpp>

namespace motionrack::cli {

namespace {

struct DescribeOptions {
    std::string what;
    bool markdown = false, json = false;
};

/// Returns all card types: "mcx314, databoard4002".
std::string card_types() {
    std::string out;
    for (const std::string_view name : rack::card_type_names()) out.append(out.empty() ? "" : ", ").append(name);
    return out;
}

int describe(const DescribeOptions& options) {
    if (options.what == "rack-file") {
        fmt::print("{}", rack::rack_file_reference());
        return exit_done;
    }
    if (options.what == "marking-job") {
        fmt::print("{}", mark::job_file_reference());
        return exit_done;
    }
    if (options.what == "sweep-file") {
        fmt::print("{}", sweep::sweep_file_reference());
        return exit_done;
    }
    if (options.what == "gcode") {
        fmt::print("{}", control::gcode::gcode_reference());
        return exit_done;
    }
    if (options.what == "safety") {
        fmt::print("{}", rack::safety_reference());
        return exit_done;
    }
    if (options.what == "api") {
        fmt::print("{}", options.markdown ? panel::api_reference() : panel::openapi().dump(2) + "\n");
        return exit_done;
    }
    const rack::CardPlugin* plugin = rack::find_card_plugin(options.what);
    if (!plugin) {
        print_error(
            fmt::format("Unknown topic '{}'. Known topics: rack-file, marking-job, sweep-file, gcode, safety, api, {}.",
                        options.what, card_types()));
        return exit_usage;
    }
    const CardMap& map = plugin->map();
    fmt::print("{}", options.json       ? describe_json(map)
                     : options.markdown ? describe_markdown(map)
                                        : describe_text(map));
    return exit_done;
}

}  // namespace

void add_describe(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<DescribeOptions>();
    CLI::App* command =
        app.add_subcommand("describe",
                           "Print a card's registers, commands, states and pins, the keys of a rack "
                           "file, marking job or sweep file, the G and M codes, or the interface of a served "
                           "machine");
    command
        ->add_option(
            "CARD", options->what,
            fmt::format(
                "a card type ({}), rack-file, marking-job, sweep-file, gcode, safety (what a stop does), or api "
                "(OpenAPI)",
                card_types()))
        ->required();
    auto* markdown = command->add_flag("--markdown", options->markdown, "as Markdown, as in docs/reference");
    command->add_flag("--json", options->json, "as JSON")->excludes(markdown);
    command->footer("Example: motionrack describe mcx314 | less");
    command->callback([options, &chosen] { chosen = [options] { return describe(*options); }; });
}

}  // namespace motionrack::cli
