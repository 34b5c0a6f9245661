// Section [probe]: a touch probe and the workpiece that it touches.
#include <fmt/format.h>

#include <motionrack/rack/config_parts.hpp>

namespace motionrack::rack {

void read_probe(const TomlNode& node, RackConfig& config, Problems& problems) {
    RackProbe probe;
    const auto refused = read_fields(node, probe_fields(), &probe, {"probe", "", "", {}}, problems);
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
        if (card->type == "mcx314" && card->mcx314.variant == Mcx314Variant::mcx314as) continue;
        problems.error(node.key_location, fmt::format("The rack has a probe, but card {} of axis {} cannot catch "
                                                      "positions; it must be of type mcx314 with variant = "
                                                      "\"mcx314as\".",
                                                      card->name, axis.letter));
        break;
    }
    config.probe = probe;
}

}  // namespace motionrack::rack
