// Reference page of the rack file, written from the reader's tables.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/fields_table.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <utility>
#include <vector>

namespace motionrack::rack {
namespace {

std::string card_type_text(const CardType& type) {
    RackCard defaults;
    std::string out =
        fmt::format("### {}\n{}. {}.\n\n", type.name, type.doc,
                    type.channel_count() == 0 ? "No axis can be on it"
                    : type.channels.empty()   ? "It has one channel, without a name: an axis on it has no key `channel`"
                                              : fmt::format("Channels: {}", fmt::join(type.channels, " ")));
    const void* settings = type.settings_of(defaults);
    if (!type.settings.empty()) out += fields_table(type.settings, settings, settings);
    out += "| pin | direction | meaning | wired by default to |\n|---|---|---|---|\n";
    const auto direction = [](const PinType& pin) { return pin.direction == PinDirection::input ? "input" : "output"; };
    for (const PinType& pin : type.channel_pins) {
        std::string wired;
        for (const DefaultWire& wire : type.default_wires)
            if (wire.pin == pin.name) wired += fmt::format("{}`NAME.{}`", wired.empty() ? "" : ", else ", wire.end);
        if (pin.name == type.probe_pin) wired = "`probe`";
        out += fmt::format("| `{}{}` | {} | {} | {} |\n", type.channel_name(0), pin.name, direction(pin), pin.doc,
                           wired.empty() ? "-" : wired);
    }
    for (std::size_t i = 0; i < type.chip_pins.size(); ++i) {
        const PinType& pin = type.chip_pins[i];
        if (type.chip_pin_count != nullptr && i >= 2) continue;  // the settings give their number
        const std::string more = type.chip_pin_count != nullptr
                                     ? fmt::format(" .. `{}`", type.chip_pins[type.chip_pins.size() - 2 + i].name)
                                     : "";
        out += fmt::format("| `{}`{} | {} | {} | {} |\n", pin.name, more, direction(pin), pin.doc,
                           pin.name == type.estop_pin ? "`estop`" : "-");
    }
    if (type.channels.empty()) return out + '\n';
    return out + fmt::format(
                     "\nThe first {} pins are those of channel {}; the other channels have the same with their own "
                     "letter in front.\n\n",
                     type.channel_pins.size(), type.channels[0]);
}

std::string section_text(const PartSection& section) {
    const std::string doc = section.doc_of_cards != nullptr ? section.doc_of_cards() : std::string(section.doc);
    return fmt::format("## {}\n{}{}{}", section.title, doc, doc.empty() ? "" : "\n\n",
                       fields_table(section.fields(), section.defaults(false), section.defaults(true)));
}

/// Parts that are one wire come last.
std::vector<DeclaredSignal> declared_ends() {
    std::vector<DeclaredSignal> out;
    for (const PartKind* kind : part_kinds()) {
        if (kind->signals == nullptr) continue;
        for (DeclaredSignal& one : kind->signals->declared()) out.push_back(std::move(one));
    }
    std::stable_partition(out.begin(), out.end(),
                          [](const DeclaredSignal& one) { return one.name.find('.') != std::string::npos; });
    return out;
}

std::string wires_text() {
    std::string out =
        "## [wires]\nOne line a wire, only for what differs from the default rule: the input left, the output that "
        "drives it right, both in "
        "quotes; `\"open\"` leaves an input without a wire, which an input for a contact takes for an open contact: it "
        "is active. An output "
        "may drive many inputs.\n\n"
        "```toml\n[wires]\n\"motion.xlmtp\" = \"Y.limit_plus\"\n\"motion.xin2\" = \"open\"\n```\n\n"
        "A motor takes its pulses and their direction from one channel, and one channel drives one motor; `\"X.step\" "
        "= "
        "\"open\"` leaves the motor standing. An encoder is wired with both tracks or not at all: with the tracks "
        "crossed over it counts backwards, with both inputs open the channel counts what its pins are driven with.\n\n"
        "```toml\n[wires]\n\"X.step\" = \"motion.upp\"\n\"X.dir\" = \"motion.upm\"\n\"motion.xeca\" = \"X.enc_b\"\n"
        "\"motion.xecb\" = \"X.enc_a\"\n```\n\n"
        "Pins of cards are written CARD.pin (below), the ends of an axis' parts NAME.end:\n\n"
        "| end | direction | meaning | there if |\n|---|---|---|---|\n";
    for (const DeclaredSignal& one : declared_ends())
        out += fmt::format("| `{}` | {} | {} | {} |\n", one.name,
                           one.direction == PinDirection::input ? "input" : "output", one.doc,
                           one.needs.empty() ? "always" : with_unit(one.needs, "mm"));
    return out + '\n';
}

std::string safety_text(const RackSafety& safety) {
    return "## [safety]\nSafety contacts. Their wires are driven by hand or by a fault: `--fault estop2=0@1s`, "
           "`--fault door=0@1s`. What a stop does is on [its own page](../explanations/safety.md).\n\n" +
           fields_table(safety_fields(), &safety, &safety);
}

}  // namespace

std::string rack_file_reference() {
    const RackConfig rack;
    const RackCard card;
    std::string out = fmt::format(
        "# The rack file\nTOML. `motionrack new` writes one to start from. Unknown keys, wrong types and values out of "
        "range are errors; all are reported at once, with line and column. Text such as `card.c1 = \"{}\"` (only a "
        "card, by its type) is a rack, too: default settings and four ideal axes X Y Z A, 1000 pulses and 1000 encoder "
        "counts a mm or degree.\n\n",
        card_type_names().front());
    out += "## [rack]\n" + fields_table(rack_fields(), &rack, &rack);
    out +=
        "## [card.NAME]\nOne section a card; NAME is yours: letters, digits, `_`. The card types are described "
        "below.\n\n" +
        fields_table(card_fields(), &card, &card);
    for (const PartKind* kind : part_kinds())
        if (kind->sections != nullptr)
            for (const PartSection& section : kind->sections->sections) out += section_text(section);
    out += "## [controller]\n" + fields_table(controller_fields(), &rack.controller, &rack.controller);
    out += safety_text(rack.safety) + wires_text();
    out += "## Card types\n\n";
    for (const CardPlugin* plugin : card_plugins()) out += card_type_text(plugin->type);
    out.pop_back();
    return out;
}

}  // namespace motionrack::rack
