// Section [scanner.NAME] of a rack file: its keys, and conflicts between scan heads, conveyors and cards.
#include <fmt/format.h>

#include <array>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_sections.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

constexpr std::array<std::string_view, 3> scanner_tables = {"lens", "galvo", "laser"};

constexpr std::array<Field, 5> scanner_table = {
    required(field<&RackScanner::card>("card", 1, 32, "", "name of the card that drives it"), "required"),
    absent_means(formerly("part_on", field<&RackScanner::conveyor>("conveyor", 1, 32, "",
                                                                   "name of the belt or table that carries the part")),
                 "none: the part does not move"),
    field<&RackScanner::bits_per_mm>("bits_per_mm", 1, 1e6, "", "of the field, without a lens"),
    field<&RackScanner::tolerance_um>("tolerance_um", 0, 10'000, "um",
                                      "maximum distance of a merged piece from the marked path"),
    formerly("greatest_points",
             field<&RackScanner::max_points>("max_points", 16, 4'000'000, "",
                                             "stored points of marks; further points are only counted")),
};

std::span<const Field> scanner_fields() {
    static const std::string card_doc =
        fmt::format("name of the card (type {}) that drives it", card_types_text(drives_scan_heads));
    static const auto table = with_doc(scanner_table, "card", card_doc);
    return table;
}

std::string scanner_doc() {
    return fmt::format("Mirrors, lens and laser over a part, which stores the marks; driven by a card of type {}.",
                       card_types_text(drives_scan_heads));
}

void check_scanner(const RackScanner& scanner, const RackConfig& config, PartReader& reader) {
    if (scanner.conveyor && config.track(*scanner.conveyor) == nullptr)
        reader.refuse("conveyor", fmt::format("unknown belt or table {}.", in_quotes(*scanner.conveyor)));
    is_marking_card(scanner.card, config, reader);
    for (const RackScanner& other : config.scanners)
        if (other.card == scanner.card)
            reader.refuse("card", fmt::format("card {} drives scanner {} already.", scanner.card, other.name));
    if (scanner.lens && reader.node().find("bits_per_mm") != nullptr)
        reader.refuse("bits_per_mm", "with a lens its bits_per_mm stand in the table lens.");
    if (const auto made = parts::MarkingStation::make(scanner.settings()); !made)
        reader.refuse(scanner.lens ? "lens" : "galvo", made.error().message + ".");
}

void read_scanner(const TomlNode& node, RackConfig& config, Problems& problems) {
    if (!is_marking_name(node, config, problems) || !is_table(node, "scanner." + node.key, problems)) return;
    RackScanner scanner;
    scanner.name = node.key;
    const std::string name = "scanner " + node.key;
    PartReader reader(node, {name, "", "", {}}, name, problems);
    bool sound = reader.read(scanner_fields(), &scanner, scanner_tables);
    if (const TomlNode* lens = node.find("lens"))
        sound = reader.read_table(*lens, lens_keys, &scanner.lens.emplace()) && sound;
    if (const TomlNode* galvo = node.find("galvo"))
        sound = reader.read_table(*galvo, galvo_keys, &scanner.galvo) && sound;
    if (const TomlNode* laser = node.find("laser"))
        sound = reader.read_table(*laser, laser_keys, &scanner.laser) && sound;
    if (sound) check_scanner(scanner, config, reader);
    config.scanners.push_back(std::move(scanner));
}

void read_scanners(const TomlNode& scanners, RackConfig& config, Problems& problems) {
    for (const TomlNode& node : scanners.children) read_scanner(node, config, problems);
}

constexpr std::array<std::string_view, 1> scanner_keys = {"scanner"};
constexpr std::array<PartSection, 4> scanner_section_rows = {{
    {"[scanner.NAME]", {}, scanner_fields, default_object<RackScanner>, scanner_doc},
    {"[scanner.NAME.lens]",
     "With the section, even an empty one, the field is that of two mirrors and an f-theta lens.", rows_of<lens_keys>,
     default_object<RackLens>},
    {"[scanner.NAME.galvo]", {}, rows_of<galvo_keys>, default_object<parts::GalvoSettings>},
    {"[scanner.NAME.laser]", {}, rows_of<laser_keys>, default_object<parts::LaserSettings>},
}};

}  // namespace

constinit const PartSections scanner_sections = {scanner_keys, scanner_section_rows, names_in<&RackConfig::scanners>,
                                                 read_scanners};

}  // namespace motionrack::rack
