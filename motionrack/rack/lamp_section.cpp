// Section [lamp.NAME] of a rack file: its keys.
#include <fmt/format.h>

#include <array>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_sections.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

constexpr std::array<Field, 1> lamp_table = {
    field<&RackLamp::active_low>("active_low", 0, 1, "", "it shines while its input is low, not while it is high"),
};

void read_lamp(const TomlNode& node, RackConfig& config, Problems& problems) {
    if (!is_free_name(config, node.key)) {
        problems.error(node.key_location,
                       fmt::format("{} cannot be a lamp's name: 2 to 32 letters, digits and '_', not beginning with a "
                                   "digit, not the name of a card or another part, not estop.",
                                   in_quotes(node.key)));
        return;
    }
    if (!is_table(node, "lamp." + node.key, problems)) return;
    RackLamp lamp;
    lamp.name = node.key;
    const std::string name = "lamp " + node.key;
    PartReader(node, {name, "", "", {}}, name, problems).read(lamp_table, &lamp);
    config.lamps.push_back(std::move(lamp));
}

void read_lamps(const TomlNode& lamps, RackConfig& config, Problems& problems) {
    for (const TomlNode& node : lamps.children) read_lamp(node, config, problems);
}

constexpr std::array<std::string_view, 1> lamp_keys = {"lamp"};
constexpr std::array<PartSection, 1> lamp_section_rows = {{
    {"[lamp.NAME]",
     "A signal lamp. What drives its input `NAME.in` is named in [wires]; without a wire the input is low.",
     rows_of<lamp_table>, default_object<RackLamp>},
}};

}  // namespace

constinit const PartSections lamp_sections = {lamp_keys, lamp_section_rows, names_in<&RackConfig::lamps>, read_lamps};

}  // namespace motionrack::rack
