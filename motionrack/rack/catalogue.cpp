// The types of card of a rack: one line per type. The reference page and lists keep this order.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/databoard4002_card.hpp>
#include <motionrack/rack/grating_card.hpp>
#include <motionrack/rack/io8255_card.hpp>
#include <motionrack/rack/ioflex02_card.hpp>
#include <motionrack/rack/mcx314_card.hpp>
#include <motionrack/rack/rtc5_card.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

constexpr std::array<const CardPlugin*, 7> plugins = {
    &mcx314_plugin,           //
    &databoard4002_plugin,    //
    &ioflex02_plugin,         //
    &grating_bus_plugin,      //
    &grating_decoder_plugin,  //
    &rtc5_plugin,             //
    &io8255_plugin,
};

}  // namespace

std::span<const CardPlugin* const> card_plugins() {
    return plugins;
}

const CardPlugin* find_card_plugin(std::string_view type) {
    for (const CardPlugin* plugin : plugins)
        if (plugin->type.name == type) return plugin;
    return nullptr;
}

Result<const CardPlugin*> find_live_plugin(std::string_view type) {
    const CardPlugin* const plugin = find_card_plugin(type);
    if (plugin != nullptr && plugin->no_live_port.empty()) return plugin;
    std::string known;
    for (const CardPlugin* each : plugins)
        if (each->no_live_port.empty()) known += fmt::format("{}{}", known.empty() ? "" : ", ", each->type.name);
    const std::string cause =
        plugin != nullptr ? std::string(plugin->no_live_port) : fmt::format("Unknown card type {}.", in_quotes(type));
    return fail(ErrorKind::invalid_input,
                fmt::format("{} Nothing was opened. A real card is one of: {}.", cause, known));
}

const CardType* find_card_type(std::string_view name) {
    const CardPlugin* plugin = find_card_plugin(name);
    return plugin != nullptr ? &plugin->type : nullptr;
}

std::span<const std::string_view> card_type_names() {
    static const auto names = [] {
        std::array<std::string_view, plugins.size()> out;
        std::transform(plugins.begin(), plugins.end(), out.begin(),
                       [](const CardPlugin* plugin) { return plugin->type.name; });
        return out;
    }();
    return names;
}

std::vector<std::string_view> card_types_that(bool (*holds)(const CardType& type)) {
    std::vector<std::string_view> out;
    for (const CardPlugin* plugin : plugins)
        if (holds(plugin->type)) out.push_back(plugin->type.name);
    return out;
}

bool Card::shows(std::string_view scope, std::string_view wire) const {
    if (scope == name()) return true;
    const std::string full = fmt::format("{}.{}", scope, wire);
    const std::span<const std::string> shared = shared_wires();
    return std::find(shared.begin(), shared.end(), full) != shared.end();
}

std::uint8_t bus_select(const RackCard& card) {
    const CardType* type = find_card_type(card.type);
    return type != nullptr && type->select != nullptr ? type->select(card) : std::uint8_t{0};
}

CardBus bus_of(Card& card, const RackCard& config) {
    return {card.port(), card.byte_port(), &card.host(), bus_select(config)};
}

tl::unexpected<Error> no_such_value(const Card& card, std::string_view name, std::span<const std::string_view> more) {
    std::vector<std::string_view> known(more.begin(), more.end());
    for (const RegisterInfo& reg : card.map().registers)
        if (reg.access != Access::write && reg.bank.empty()) known.push_back(reg.name);
    return fail(ErrorKind::invalid_input, fmt::format("Card {} has no value {}; it has {}. Nothing was done.",
                                                      card.name(), in_quotes(name), fmt::join(known, ", ")));
}

}  // namespace motionrack::rack
