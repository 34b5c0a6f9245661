// A part of the running machine, or a card, for callers that know only its name: quantities and faults.
//
//   rack file ──► Rack ──parts()──► Part "X", "motion", "stage_x", "line" ──► quantities, faults of the whole rack
//                                    ▲
//   part_catalogue.cpp: one line per kind of part, which names its tables
#pragma once

#include <cstdint>
#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/sim/kernel.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

enum class ValueKind : std::uint8_t {
    measures,  ///< any number
    whole,     ///< any whole number
    amount,    ///< a whole number >= 0
    yes_no     ///< 1 or 0
};

/// A readable quantity of an existing part.
struct Quantity {
    std::string name;  ///< name with unit: "position_mm"
    std::string_view doc;
    ValueKind values = ValueKind::measures;
    std::function<double(Instant now)> get;  ///< valid as long as the rack exists

    /// Returns true if it is a count, with whole values.
    bool whole() const { return values != ValueKind::measures; }
};

/// Limits of the values to which a quantity can be set.
struct QuantityLimits {
    double min = 0, max = 0;
};

/// Values of a fault.
struct FaultRange {
    std::string unit;      ///< empty: none
    std::string_view doc;  ///< effect of the value
    double min = 0, max = 0;
};

class Part {
  public:
    virtual ~Part() = default;
    /// Name in the rack file: "X", "line".
    virtual const std::string& name() const = 0;
    /// Name as the subject of a sentence: "Axis X".
    virtual std::string subject() const { return name(); }
    /// Returns true for a card: it is not part of the machine, and its quantities follow those of all parts.
    virtual bool is_card() const { return false; }

    // ---- quantities
    /// Existing quantities, in the order of their table.
    virtual std::vector<Quantity> quantities() = 0;
    /// Returns the value of that quantity; nothing if the part does not have it.
    virtual std::optional<double> quantity(std::string_view quantity_name, Instant now) = 0;
    /// Returns nothing if the quantity cannot be set.
    virtual std::optional<QuantityLimits> limits_to_set(std::string_view quantity_name, Instant now);
    /// Returns the fault ("motor.push=12") that sets the quantity; empty: it has the value already. Errors:
    /// invalid_input if the quantity is unknown; refused if it cannot be set, or not to that value.
    virtual Result<std::string> fault_to_set(std::string_view quantity_name, double value, Instant now);
    /// Builds the error that lists the quantities of the part.
    tl::unexpected<Error> no_such_quantity(std::string_view quantity_name);

    // ---- faults
    /// Returns the names of the known faults, COMPONENT.FAULT: "encoder.dirt". The input log uses their index.
    virtual std::vector<std::string_view> fault_names() const = 0;
    /// Returns true if the part has the component of the known fault: an axis may lack the encoder.
    virtual bool can_have(std::string_view fault) const { return (void)fault, true; }
    /// Returns true if the known fault sets the part in motion, which a latched stop prevents.
    virtual bool drives(std::string_view fault) const { return (void)fault, false; }
    virtual FaultRange fault_range(std::string_view fault) const = 0;
    /// Returns the device that accepts the fault.
    virtual sim::DeviceId device_of(std::string_view fault) const = 0;
    /// Injects a fault that the part can have, now. Returns false if the part cannot have it with this value.
    virtual bool inject(sim::Kernel& kernel, std::string_view fault, double value) = 0;

    /// Returns a condition of one of the part's devices as a sentence; nothing for those of other devices.
    virtual std::optional<std::string> describe(const sim::Condition& condition, const sim::Kernel& kernel) const;

  protected:
    /// Returns "X.position_mm".
    std::string full_name(std::string_view quantity_name) const;
};

}  // namespace motionrack::rack
