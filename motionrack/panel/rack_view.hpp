// The rack as JSON: what it is made of, which never changes while it runs; and what scan heads have marked.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace motionrack::panel {

nlohmann::json rack_facts(operate::Machine& machine);

/// What lies under a scan head, thinned to `most` points. Errors: invalid_input, with the scan heads that there are. On
/// the motion thread.
Result<nlohmann::json> workpiece_now(operate::Machine& machine, const std::string& scanner, std::size_t most);

}  // namespace motionrack::panel
