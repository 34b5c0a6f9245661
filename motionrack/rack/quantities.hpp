// What is true of a machine's parts, by name: where a table really is, whatever any counter says.
//
//   "X.position_mm"   NAME.QUANTITY; the quantities are a table, the unit in their names is the axis' own (mm or deg)
#pragma once

#include <motionrack/rack/rack.hpp>
#include <span>
#include <string_view>

namespace motionrack::rack {

/// One thing that can be asked of an axis. "{u}" in the name stands for mm or deg.
struct Quantity {
    std::string_view name;
    std::string_view doc;
    double (*get)(RunningAxis& axis, Instant now);
    /// What brings it to `value`, as microsteps to push the motor by; nullptr: it cannot be set.
    double (*push)(RunningAxis& axis, double value, Instant now);
    bool (*present)(const RunningAxis& axis);
};
std::span<const Quantity> quantities();

/// The same of a stage.
struct StageQuantity {
    std::string_view name;
    std::string_view doc;
    double (*get)(RunningStage& stage, Instant now);
    bool of_loop;  ///< only of a stage whose loop somebody closes
};
std::span<const StageQuantity> stage_quantities();

/// The same of a belt or table, and of a scan head.
struct TrackQuantity {
    std::string_view name;
    std::string_view doc;
    double (*get)(RunningTrack& track, Instant now);
    bool (*present)(const RunningTrack& track);
};
std::span<const TrackQuantity> track_quantities();
struct ScannerQuantity {
    std::string_view name;
    std::string_view doc;
    double (*get)(RunningScanner& scanner);
};
std::span<const ScannerQuantity> scanner_quantities();

/// Errors: bad_input if there is no such part or quantity, with the ones that there are.
Result<double> get_quantity(Rack& rack, std::string_view part_dot_quantity);

/// Pushes the part there by hand; of a belt or table speed_{u}_s can be set, for good or until the fault drive.profile. A motor in step goes to the nearest place of the same electrical phase (a multiple of
/// four full steps away), as a real one under current does: read the quantity to see where it came to. Between runs.
/// Errors: bad_input; refused if it cannot be set, if the value is no number or too far away (see greatest_push).
Result<void> set_quantity(Rack& rack, std::string_view part_dot_quantity, double value);

}  // namespace motionrack::rack
