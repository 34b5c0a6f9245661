// registers: decoded registers of a virtual or a real card.
#include <fmt/format.h>

#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/live/open_card.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/register_view.hpp>

namespace motionrack::cli {

namespace {

struct RegistersOptions {
    std::string card, rack, live;
    std::uint8_t select = 13;
    bool clear = false, all = false, json = false;
};

void print_registers(const rack::RegisterView& view, const RegistersOptions& options) {
    fmt::print("{}", options.json ? rack::view_json(view) : rack::view_text(view, options.all));
}

Result<rack::RegisterView> live_view(const live::PortSpec& spec, const rack::CardPlugin& plugin,
                                     const RegistersOptions& options) {
    MOTIONRACK_TRY(const live::OpenCard card, live::open_card(spec, plugin.map()));
    Result<rack::RegisterView> view =
        plugin.view({card.registers, card.bytes, card.port.get(), options.select}, options.clear);
    if (card.port->trouble()) return tl::unexpected<Error>(*card.port->trouble());
    return view;
}

int live_registers(const RegistersOptions& options) {
    const auto plugin = rack::find_live_plugin(options.card.empty() ? "mcx314" : options.card);
    if (!plugin) {
        print_error(plugin.error().message);
        return exit_usage;
    }
    const auto spec = live::read_port_spec(options.live);
    if (!spec) return report(spec.error());
    const auto view = live_view(*spec, **plugin, options);
    if (!view) return report(view.error());
    print_registers(*view, options);
    return exit_done;
}

int virtual_registers(const RegistersOptions& options) {
    int code = exit_done;
    const auto config = load_rack(options.rack, code);
    if (!config) return code;
    rack::Rack rack(*config);
    rack.start();
    std::string known;
    for (std::size_t i = 0; i < rack.cards().size(); ++i) {
        rack::Card& card = *rack.cards()[i];
        known += (known.empty() ? "" : ", ") + card.name();
        if (!options.card.empty() && options.card != card.name()) continue;
        const rack::CardPlugin* const plugin = rack::find_card_plugin(config->cards[i].type);
        if (!plugin || !plugin->view) continue;
        const Result<rack::RegisterView> view = plugin->view(rack::bus_of(card, config->cards[i]), options.clear);
        if (!view) return report(view.error());
        print_registers(*view, options);
        return exit_done;
    }
    print_error(
        fmt::format("The rack has no card '{}' whose registers can be shown; its cards are: {}.", options.card, known));
    return exit_usage;
}

}  // namespace

void add_registers(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<RegistersOptions>();
    CLI::App* command =
        app.add_subcommand("registers", "Read a card's registers and print their meaning; nothing moves");
    command->add_option("CARD", options->card,
                        "name of a card in the rack (default: the first); with --live its type (default: mcx314)");
    auto* rack = command->add_option("--rack", options->rack, "rack file (default: the built-in router)");
    command->add_option("--live", options->live, "a real card: " + std::string(live::port_spec_form()))->excludes(rack);
    command->add_option("--select", options->select, "number of a real databoard4002 on its bus (13)");
    command->add_flag("--clear", options->clear, "also read RR3, which clears it");
    command->add_flag("--all", options->all, "also fields that are 0");
    command->add_flag("--json", options->json, "as JSON");
    command->footer(
        "Example: motionrack registers --live uio:/dev/uio0\nOf a real mcx314 WR0 is written, with NOP and read "
        "commands; a real databoard4002 is selected and gets the commands P and R. No other program may use the card "
        "at the same time.");
    command->callback([options, &chosen] {
        chosen = [options] { return options->live.empty() ? virtual_registers(*options) : live_registers(*options); };
    });
}

}  // namespace motionrack::cli
