// The kinds of part of a rack: one line per kind. Lists of targets and of quantities, the
// sections of the rack file's page and their reading keep this order.
#include <array>
#include <motionrack/rack/part_catalogue.hpp>

namespace motionrack::rack {

std::span<const PartKind* const> part_kinds() {
    static constexpr std::array<const PartKind*, 8> kinds = {
        &axis_part_kind,      //
        &card_part_kind,      //
        &probe_part_kind,     //
        &stage_part_kind,     //
        &conveyor_part_kind,  //
        &scanner_part_kind,   //
        &lamp_part_kind,      //
        &estop_part_kind,
    };
    return kinds;
}

std::vector<std::unique_ptr<Part>> make_parts(Rack& rack) {
    std::vector<std::unique_ptr<Part>> out;
    for (const PartKind* kind : part_kinds())
        if (kind->add != nullptr) kind->add(rack, out);
    return out;
}

}  // namespace motionrack::rack
