// Section [probe]: a touch probe and the workpiece that it touches.
#include <fmt/format.h>

#include <array>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_sections.hpp>

namespace motionrack::rack {

namespace {

constexpr std::array<Field, 6> probe_table = {
    absent_means(formerly("x_from_mm", field<&RackProbe::x_min>("x_min_mm", -1e7, 1e7, "mm",
                                                                "start of the workpiece that the probe touches")),
                 "no bound"),
    absent_means(formerly("x_to_mm", field<&RackProbe::x_max>("x_max_mm", -1e7, 1e7, "mm", "to here")), "no bound"),
    absent_means(formerly("y_from_mm", field<&RackProbe::y_min>("y_min_mm", -1e7, 1e7, "mm", "from here")), "no bound"),
    absent_means(formerly("y_to_mm", field<&RackProbe::y_max>("y_max_mm", -1e7, 1e7, "mm", "to here")), "no bound"),
    absent_means(formerly("z_from_mm", field<&RackProbe::z_min>("z_min_mm", -1e7, 1e7, "mm", "from here")), "no bound"),
    absent_means(formerly("z_to_mm", field<&RackProbe::z_max>("z_max_mm", -1e7, 1e7, "mm", "to here")), "no bound"),
};

void read_probe(const TomlNode& node, RackConfig& config, Problems& problems) {
    RackProbe probe;
    read_fields(node, probe_table, &probe, {"probe", "", "", {}}, problems);
    for (int axis = 0; axis < 3; ++axis) {
        const char letter = control::axis_letters[static_cast<std::size_t>(axis)];
        const char small = static_cast<char>(letter - 'A' + 'a');
        const std::string key = fmt::format("{}_min_mm", small);
        const std::optional<double> lower = probe.lower(axis), upper = probe.upper(axis);
        if (lower && upper && *lower >= *upper) {
            problems.error(
                node.location_of(key),
                fmt::format(
                    "The workpiece of the probe goes from {} to {} mm along {}; its first end must be below the other.",
                    *lower, *upper, letter));
        }
        if ((lower || upper) && config.axis(letter) == nullptr) {
            problems.error(node.location_of(lower ? key : fmt::format("{}_max_mm", small)),
                           fmt::format("The workpiece of the probe has an end along {}, but the rack has no axis {}.",
                                       letter, letter));
        }
    }
    for (const RackAxis& axis : config.axes) {
        const RackCard* card = config.card(axis.card);
        if (card == nullptr || card->type.empty()) continue;  // already reported
        if (const CardType* type = find_card_type(card->type); can_latch(*type) && type->latches(*card)) continue;
        const CardType& needed = *find_card_type(card_types_that(can_latch).front());
        problems.error(node.key_location, fmt::format("The rack has a probe, but card {} of axis {} cannot catch "
                                                      "positions; it must be of type {} with {}.",
                                                      card->name, axis.letter, needed.name, needed.latches_with));
        break;
    }
    config.probe = probe;
}

std::string probe_doc() {
    const CardType& type = *find_card_type(card_types_that(can_latch).front());
    return fmt::format(
        "A touch probe for G38.2 to G38.5 and the workpiece that it touches, in machine coordinates. Without this "
        "section the rack has no probe. Where an axis has one bound or none the workpiece is unbounded there; without "
        "any bound the probe touches nothing. The axes must be on a card of type {} with `{}`; by default its wire "
        "`probe` leads to the input `{}` of each of their channels.",
        type.name, type.latches_with, type.probe_pin);
}

constexpr std::array<std::string_view, 1> probe_keys = {"probe"};
constexpr std::array<PartSection, 1> probe_section_rows = {{
    {"[probe]", {}, rows_of<probe_table>, default_object<RackProbe>, probe_doc},
}};

}  // namespace

constinit const PartSections probe_sections = {probe_keys, probe_section_rows, nullptr, read_probe};

}  // namespace motionrack::rack
