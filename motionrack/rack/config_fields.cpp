// Keys of a rack file, each declared once: name, range, unit, meaning. Defaults are those of the structs in config.hpp.
// Those of parts are in the file of the part (*_section.cpp).
#include <motionrack/rack/config_parts.hpp>

namespace motionrack::rack {
namespace {

constexpr std::array<Field, 1> rack_table = {
    field<&RackConfig::name>("name", 1, 200, "", "name of the rack in reports"),
};

constexpr std::array<std::string_view, 2> profiles = {"trapezoid", "jerk_limited"};

constexpr std::array<Field, 3> controller_table = {
    with_choices(field<&RackController::profile>("profile", 1, 32, "", "velocity profile of paths"), profiles),
    field<&RackController::default_path_tolerance_mm>("default_path_tolerance_mm", 0, 100, "mm",
                                                      "path tolerance of G64 without P"),
    field<&RackController::arc_tolerance_mm>("arc_tolerance_mm", 0.000001, 10, "mm",
                                             "maximum deviation of short lines from an arc"),
};

constexpr std::array<Field, 3> safety_table = {
    field<&RackSafety::estop_channels>("estop_channels", 1, 2, "",
                                       "contacts of the emergency stop; 2: the wires `estop1` and `estop2`, of which "
                                       "the first that opens stops the machine"),
    field<&RackSafety::estop_discrepancy_ms>(
        "estop_discrepancy_ms", 1, 60'000, "ms",
        "how long two contacts may differ; after that no reset is accepted until they are alike"),
    field<&RackSafety::door>("door", 0, 1, "",
                             "a door with the wire `door`, low while it is open: the feed is held, the spindle goes "
                             "off, and nothing begins to move"),
};

}  // namespace

std::span<const Field> rack_fields() {
    return rack_table;
}
std::span<const Field> card_fields() {
    static const std::array<Field, 2> table = {
        required(with_choices(field<&RackCard::type>("type", 1, 32, "", "the kind of card"), card_type_names()),
                 "required"),
        absent_means(field<&RackCard::slot>("slot", 0, slot_count - 1, "", "position of the card in the rack"),
                     "the lowest free slot"),
    };
    return table;
}
std::span<const Field> controller_fields() {
    return controller_table;
}

std::span<const Field> safety_fields() {
    return safety_table;
}

}  // namespace motionrack::rack
