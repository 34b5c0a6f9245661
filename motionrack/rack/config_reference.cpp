// Reference page of the rack file, written from the reader's tables.
#include <fmt/format.h>

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

std::vector<DeclaredSignal> declared_ends() {
    std::vector<DeclaredSignal> out;
    for (const PartKind* kind : part_kinds()) {
        if (kind->signals == nullptr) continue;
        for (DeclaredSignal& one : kind->signals->declared()) out.push_back(std::move(one));
    }
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
    const RackAxis linear = default_axis('X');
    const RackAxis rotary = default_axis('A');
    std::string out =
        "# The rack file\nTOML. `motionrack new` writes one to start from. Unknown keys, wrong types and values out of "
        "range are errors; all are reported at once, with line and column. Text such as `card.c1 = \"mcx314\"` (only a "
        "card, by its type) is a rack, too: default settings and four ideal axes X Y Z A, 1000 pulses and 1000 encoder "
        "counts a mm or degree.\n\n";
    out += "## [rack]\n" + fields_table(rack_fields(), &rack, &rack);
    out +=
        "## [card.NAME]\nOne section a card; NAME is yours: letters, digits, `_`. The card types are described "
        "below.\n\n" +
        fields_table(card_fields(), &card, &card);
    out += "## [axis.NAME]\nNAME is X, Y, Z (linear, mm) or A, B, C (rotary, degrees).\n\n" +
           fields_table(axis_fields(), &linear, &rotary);
    out +=
        "## [axis.NAME.motor]\nPulses are microsteps.\n\n" + fields_table(motor_fields(), &linear.motor, &rotary.motor);
    const RackServo servo;
    out +=
        "## [axis.NAME.servo]\nA servo amplifier with a DC motor and its tacho, in place of the stepping motor; with "
        "the section, even an "
        "empty one, the axis follows a voltage. The model is a first-order lag with a current limit.\n\n" +
        fields_table(servo_fields(), &servo, &servo);
    out += "## [axis.NAME.switches]\nMachine positions where they act.\n\n" +
           fields_table(switch_fields(), &linear.switches, &rotary.switches);
    out += "## [axis.NAME.homing]\nHow `motionrack home` finds the home switch.\n\n" +
           fields_table(homing_fields(), &linear.homing, &rotary.homing);
    const RackProbe probe;
    out +=
        "## [probe]\nA touch probe for G38.2 to G38.5 and the workpiece that it touches, in machine coordinates. "
        "Without this section the rack has no probe. "
        "Where an axis has one bound or none the workpiece is unbounded there; without any bound the probe touches "
        "nothing. The axes must be on a card "
        "of type mcx314 with `variant = \"mcx314as\"`; by default its wire `probe` leads to the input `in3` of each of "
        "their channels.\n\n" +
        fields_table(probe_fields(), &probe, &probe);
    const RackStage stage;
    const RackStageServo stage_servo;
    out +=
        "## [stage.NAME]\nA stage on a linear motor with a grating scale, driven by an analog output of a card of a "
        "grating bus.\n\n" +
        fields_table(stage_fields(), &stage, &stage);
    out += "## [stage.NAME.scale]\n" + fields_table(scale_fields(), &stage.scale, &stage.scale);
    out +=
        "## [stage.NAME.servo]\nWith the section, even an empty one, the card's processor closes a loop through the "
        "bus' frames and follows "
        "the profile.\n\n" +
        fields_table(stage_servo_fields(), &stage_servo, &stage_servo);
    const RackConveyor belt;
    RackConveyor turning;
    turning.rotary = true;
    out +=
        "## [belt.NAME], [table.NAME]\nWhat moves the part under a scan head: a belt (mm) or a rotary table (degrees). "
        "In place of its velocity `profile = [[0, 50], [0.5, 120]]`: seconds and velocities, linear between, constant "
        "before and after. `motionrack run` and `mr_part_set` change the velocity: fault `drive.speed`.\n\n" +
        fields_table(track_fields(), &belt, &turning);
    const parts::SerialPositionSettings sender;
    out +=
        "## [belt.NAME.sender]\nWith the section, even an empty one, a position sender reads the place and gives the "
        "card's serial input words. In "
        "[table.NAME.sender] the same.\n\n" +
        fields_table(sender_fields(), &sender, &sender);
    const RackParts passing;
    out +=
        "## [belt.NAME.parts]\nWith the section, even an empty one, parts pass a light barrier, which starts the card. "
        "In [table.NAME.parts] the "
        "same.\n\n" +
        fields_table(passing_fields(), &passing, &passing);
    const RackScanner scanner;
    const RackLens lens;
    out +=
        "## [scanner.NAME]\nMirrors, lens and laser over a part, which stores the marks; driven by a card of type "
        "rtc5.\n\n" +
        fields_table(scanner_fields(), &scanner, &scanner);
    out +=
        "## [scanner.NAME.lens]\nWith the section, even an empty one, the field is that of two mirrors and an f-theta "
        "lens.\n\n" +
        fields_table(lens_keys, &lens, &lens);
    out += "## [scanner.NAME.galvo]\n" + fields_table(galvo_keys, &scanner.galvo, &scanner.galvo);
    out += "## [scanner.NAME.laser]\n" + fields_table(laser_keys, &scanner.laser, &scanner.laser);
    out += "## [controller]\n" + fields_table(controller_fields(), &rack.controller, &rack.controller);
    out += safety_text(rack.safety) + wires_text();
    out += "## Card types\n\n";
    for (const CardPlugin* plugin : card_plugins()) out += card_type_text(plugin->type);
    out.pop_back();
    return out;
}

}  // namespace motionrack::rack
