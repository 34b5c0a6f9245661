// Faults by name that can be injected into a running rack.
//
//   inject_fault(rack, "encoder.broken_a", "X")        from this instant
//   inject_fault(rack, "encoder.broken_a=0", "X")      repaired
//   inject_fault(rack, "motor.lose_steps=64", "X")     with a number
#pragma once

#include <motionrack/rack/rack.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// Injects the fault `fault` ("NAME" or "NAME=VALUE"; the default value is 1) into `target`: an axis, a stage, a belt,
/// a table or a card of the rack. Call between runs. Errors: invalid_input (unknown target or fault, listing the
/// available ones), refused (the rack lacks the faulty component, or the value is out of range).
Result<void> inject_fault(Rack& rack, std::string_view fault, std::string_view target);

/// Returns the result of inject_fault for name and value without injecting it; the rack may not be started yet.
Result<void> check_fault(Rack& rack, std::string_view fault, std::string_view target);

/// Largest push of a motor by a fault, in microsteps.
inline constexpr double max_push = 1e7;

/// Names of the faults of an axis, for stepping motors and servos.
std::vector<std::string_view> fault_names();

/// A target in the rack and its faults.
struct FaultTarget {
    std::string name;  ///< target name for inject_fault
    std::vector<std::string_view> faults;
};
std::vector<FaultTarget> fault_targets(Rack& rack);

/// A fault and its values.
struct FaultValue {
    std::string target;
    std::string_view name;
    std::string unit;      ///< unit of the value; empty: none
    std::string_view doc;  ///< effect of the value
    double min = 0, max = 0;
};
/// All faults, target by target.
std::vector<FaultValue> fault_values(Rack& rack);

}  // namespace motionrack::rack
