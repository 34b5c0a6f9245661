// Faults by name: what can be broken on purpose in a running rack.
//
//   inject_fault(rack, "encoder.broken_a", "X")        from now on
//   inject_fault(rack, "encoder.broken_a=0", "X")      mended
//   inject_fault(rack, "motor.lose_steps=64", "X")     with a number
#pragma once

#include <motionrack/rack/rack.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// The fault `fault` ("NAME" or "NAME=VALUE"; without a value: 1) of `target`, an axis, a stage, a belt, a table or a
/// card of the rack. Between runs. Errors: invalid_input (no such target or fault, with the ones that there are),
/// refused (the part is missing, the value).
Result<void> inject_fault(Rack& rack, std::string_view fault, std::string_view target);

/// What inject_fault would say of names and value; the rack need not be started.
Result<void> check_fault(Rack& rack, std::string_view fault, std::string_view target);

/// The greatest number of a fault, in microsteps: how far a motor can be pushed at once.
inline constexpr double max_push = 1e7;

/// Names of the faults that an axis can have, whatever turns it.
std::vector<std::string_view> fault_names();

/// Everything in the rack that can be broken, and how.
struct FaultTarget {
    std::string name;  ///< of inject_fault
    std::vector<std::string_view> faults;
};
std::vector<FaultTarget> fault_targets(Rack& rack);

/// One of these faults, and the values that it takes.
struct FaultValue {
    std::string target;
    std::string_view name;
    std::string unit;      ///< of the value; empty: it has none
    std::string_view doc;  ///< what the value does
    double min = 0, max = 0;
};
/// All of them, target by target.
std::vector<FaultValue> fault_values(Rack& rack);

}  // namespace motionrack::rack
