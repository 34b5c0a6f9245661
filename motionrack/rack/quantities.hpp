// Quantities: true values of a machine's parts, by name, independent of any counter; for example the true position of a
// table.
//
//   "X.position_mm"   NAME.QUANTITY; the quantities form a table, and the unit in a name is the axis' own (mm or deg)
#pragma once

#include <motionrack/rack/part.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

struct QuantitiesOfPart {
    std::string part;  ///< "X", "line"
    std::vector<Quantity> quantities;
};
/// Quantities of the whole rack: axes, stages, belts and tables, scan heads.
std::vector<QuantitiesOfPart> quantities_of(Rack& rack);

/// A name for get_quantity and its range of values.
struct QuantityRange {
    std::string name;         ///< "X.position_mm"
    std::string_view doc;     ///< description
    std::string_view unit;    ///< "mm", "deg/s"; empty: none
    double min = 0, max = 0;  ///< limits of its values, infinite if unbounded; for a settable quantity the present
                              ///< limits of set_quantity
    bool can_set = false;
};
/// All quantities: those of quantities_of, then those of cards.
std::vector<QuantityRange> quantity_ranges(Rack& rack);
/// Returns the unit at the end of a quantity's name: "mm/s" for "speed_mm_s".
std::string_view unit_of_quantity(std::string_view name);

/// Quantities of a kind of part ("axis"), whether or not a rack has them. For reference pages. Empty: an unknown kind.
std::vector<DeclaredQuantity> declared_quantities(std::string_view kind);

/// Errors: invalid_input if the part or quantity is unknown, listing the available ones.
Result<double> get_quantity(Rack& rack, std::string_view part_dot_quantity);

/// Pushes an axis manually to `value`. On a belt or table, sets speed_{u}_s, permanently or until the fault
/// drive.profile. A motor in step goes to the nearest position of the same electrical phase (a multiple of four full
/// steps away), like a real motor under current. Read the quantity to get the position reached. Call between runs.
/// Errors: invalid_input; refused if it cannot be set, or if the value is not a number or too far away (see max_push).
Result<void> set_quantity(Rack& rack, std::string_view part_dot_quantity, double value);

}  // namespace motionrack::rack
