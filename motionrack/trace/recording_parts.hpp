// Shared parts of the recording writer and reader.
#pragma once

#include <motionrack/trace/recording.hpp>
#include <string>
#include <string_view>

namespace motionrack::trace {

/// "X" -> "x": group name of an axis.
std::string axis_folder(std::string_view name);

/// Calls `field(name, member)` for the numbers of an axis with their names in the file.
template <class Axis, class Field>
void each_number_of_axis(Axis& axis, Field field) {
    field("pulses_per_unit", axis.pulses_per_unit);
    field("counts_per_unit", axis.counts_per_unit);
    field("origin", axis.origin);
    field("min_position", axis.min_position);
    field("max_position", axis.max_position);
    field("max_velocity", axis.max_velocity);
    field("max_acceleration", axis.max_accel);
}

/// Name of the value column beside the time column of a signal.
const char* value_column(SignalKind kind);

/// Head as JSON, without the texts of program and rack.
std::string head_json(const RecordingHead& head);
/// Parses the text of head_json(). Errors: invalid_input.
Result<RecordingHead> head_from_json(std::string_view text);

}  // namespace motionrack::trace
