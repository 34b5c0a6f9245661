// What is true of a machine's parts, by name: where a table really is, whatever any counter says.
//
//   "X.position_mm"   NAME.QUANTITY; the quantities are a table, the unit in their names is the axis' own (mm or deg)
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motionrack::rack {

/// One thing that can be asked of a part that is there.
struct Quantity {
    std::string name;  ///< with its unit: "position_mm"
    std::string_view doc;
    bool whole = false;                      ///< it counts something: its values are whole
    std::function<double(Instant now)> get;  ///< as long as the rack lives
};
struct QuantitiesOfPart {
    std::string part;  ///< "X", "line"
    std::vector<Quantity> quantities;
};
/// Of everything in the rack: axes, stages, belts and tables, scan heads.
std::vector<QuantitiesOfPart> quantities_of(Rack& rack);

/// A name that get_quantity takes, and what its values can be.
struct QuantityRange {
    std::string name;         ///< "X.position_mm"
    std::string_view doc;     ///< what it is
    std::string_view unit;    ///< "mm", "deg/s"; empty: it has none
    double min = 0, max = 0;  ///< of its values, infinite where nothing bounds them; of one that can be set what
                              ///< set_quantity takes now
    bool can_set = false;
};
/// All that there are: of quantities_of, then of cards.
std::vector<QuantityRange> quantity_ranges(Rack& rack);
/// The unit that the name of a quantity ends in: "mm/s" of "speed_mm_s".
std::string_view unit_of_quantity(std::string_view name);

enum class PartKind : std::uint8_t { axis, stage, track, scanner };
/// As they are declared, whether a rack has them or not: name and meaning, "{u}" for mm or deg. For pages of reference.
std::vector<std::pair<std::string_view, std::string_view>> declared_quantities(PartKind kind);

/// Errors: invalid_input if there is no such part or quantity, with the ones that there are.
Result<double> get_quantity(Rack& rack, std::string_view part_dot_quantity);

/// Pushes an axis there by hand; of a belt or table speed_{u}_s can be set, for good or until the fault drive.profile.
/// A motor in step goes to the nearest place of the same electrical phase (a multiple of four full steps away), as a
/// real one under current does: read the quantity to see where it came to. Between runs. Errors: invalid_input; refused
/// if it cannot be set, if the value is no number or too far away (see max_push).
Result<void> set_quantity(Rack& rack, std::string_view part_dot_quantity, double value);

}  // namespace motionrack::rack
