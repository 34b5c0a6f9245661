// The rack as JSON: its components, which are constant while it runs, and the marks of scan heads.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace motionrack::panel {

nlohmann::json rack_facts(operate::Machine& machine);

/// Returns the work piece under a scan head, reduced to `max_kept` points. Errors: invalid_input, listing the scan
/// heads. Call on the motion thread.
Result<nlohmann::json> workpiece_now(operate::Machine& machine, const std::string& scanner, std::size_t max_kept);

}  // namespace motionrack::panel
