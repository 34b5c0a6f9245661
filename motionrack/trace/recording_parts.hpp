// What the writer and the reader of recordings share.
#pragma once

#include <motionrack/trace/recording.hpp>
#include <string>
#include <string_view>

namespace motionrack::trace {

/// "X" -> "x": how an axis' groups are called.
std::string axis_folder(std::string_view name);

/// Calls `field(name, member)` for the numbers of an axis, under the names that they have in the file.
template <class Axis, class Field>
void each_number_of_axis(Axis& axis, Field field) {
    field("pulses_per_unit", axis.pulses_per_unit);
    field("counts_per_unit", axis.counts_per_unit);
    field("origin", axis.origin);
    field("min_position", axis.min_position);
    field("max_position", axis.max_position);
    field("max_speed", axis.max_velocity);
    field("max_acceleration", axis.max_accel);
}

/// The column of a signal's values beside that of its times.
const char* value_column(SignalKind kind);

/// All of a head but the texts of program and rack, as JSON.
std::string head_json(const RecordingHead& head);
/// Errors: invalid_input.
Result<RecordingHead> head_from_json(std::string_view text);

}  // namespace motionrack::trace
