// Catalogue of the kinds of part: one line per kind in part_catalogue.cpp, and one file per kind, which has its tables:
// quantities, faults, signals; its keys are in a file beside it.
#pragma once

#include <memory>
#include <motionrack/rack/part.hpp>
#include <motionrack/rack/part_sections.hpp>
#include <motionrack/rack/part_signals.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace motionrack::rack {

class Rack;

/// A quantity that a kind of part may have, whether or not a rack has such a part.
struct DeclaredQuantity {
    std::string_view name;  ///< "{u}" stands for mm or deg
    std::string_view doc;
};

struct PartKind {
    std::string_view name;  ///< "axis"
    /// Appends the rack's parts of this kind, in the order of the rack file. nullptr: the kind has only signals.
    void (*add)(Rack& rack, std::vector<std::unique_ptr<Part>>& parts);
    std::vector<DeclaredQuantity> (*quantities)();   ///< nullptr: each part of the kind has its own
    std::vector<std::string_view> (*fault_names)();  ///< nullptr: none, or each part of the kind has its own
    const PartSections* sections;                    ///< sections of the rack file; nullptr: none
    const PartSignals* signals;                      ///< nullptr: no end of a wire
};

extern const PartKind axis_part_kind;
extern const PartKind card_part_kind;
extern const PartKind probe_part_kind;
extern const PartKind stage_part_kind;
extern const PartKind conveyor_part_kind;
extern const PartKind scanner_part_kind;
extern const PartKind lamp_part_kind;
extern const PartKind estop_part_kind;

std::span<const PartKind* const> part_kinds();

/// Makes all parts of a rack, kind by kind in the order of the catalogue.
std::vector<std::unique_ptr<Part>> make_parts(Rack& rack);

}  // namespace motionrack::rack
