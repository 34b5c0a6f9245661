// docs: serves the documentation and its search to a browser on this computer, without a network.
#include <fmt/format.h>

#include <cstdio>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/interrupt_signal.hpp>
#include <motionrack/frontends/cli/share_folder.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/frontends/server/site_server.hpp>

namespace motionrack::cli {

namespace {

constexpr std::chrono::milliseconds signal_poll{100};

struct DocsOptions {
    std::string folder;
    std::uint16_t port = 8081;
};

int serve_docs(const DocsOptions& options) {
    const std::filesystem::path folder =
        options.folder.empty() ? share_folder() / "docs" : std::filesystem::path(options.folder);
    if (!has_index(folder)) {
        print_error(fmt::format(
            "The documentation was not found in {}. Nothing was served. Install the package motionrack-doc, build the "
            "site with packaging/docs, or name its folder with --folder.",
            folder.string()));
        return exit_io;
    }
    Result<server::Page> site = server::Page::read(folder);
    if (!site) return report(site.error());
    stop_on_signals();
    const auto server = server::SiteServer::open(std::move(*site), options.port);
    if (!server) return report(server.error());
    fmt::print("The documentation is at {} Ctrl-C ends it.\n", (*server)->url());
    std::fflush(stdout);
    while (!stop_asked) (*server)->serve_for(signal_poll);
    return exit_done;
}

}  // namespace

void add_docs(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<DocsOptions>();
    CLI::App* command = app.add_subcommand("docs", "Serve the documentation with its search to a browser here");
    command->add_option("--port", options->port, "TCP port of 127.0.0.1; 0: any free one")->capture_default_str();
    command->add_option("--folder", options->folder,
                        "folder of the site (default: the one that came with the program)");
    command->footer(
        "Example: motionrack docs --port 8090\n"
        "Prints the address, serves this computer alone, and needs no network. Ctrl-C ends it with code 0.");
    command->callback([options, &chosen] { chosen = [options] { return serve_docs(*options); }; });
}

}  // namespace motionrack::cli
