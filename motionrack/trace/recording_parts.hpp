// What the writer and the reader of recordings share.
#pragma once

#include <motionrack/trace/recording.hpp>
#include <string>
#include <string_view>

namespace motionrack::trace {

/// "X" -> "x": how an axis' groups are called.
std::string axis_folder(std::string_view name);

/// All of a head but the texts of program and rack, as JSON.
std::string head_json(const RecordingHead& head);
/// Errors: bad_input.
Result<RecordingHead> head_from_json(std::string_view text);

}  // namespace motionrack::trace
