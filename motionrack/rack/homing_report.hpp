// Homing results as JSON values: what homing_json() writes.
#pragma once

#include <motionrack/rack/homing.hpp>
#include <nlohmann/json_fwd.hpp>

namespace motionrack::rack {

nlohmann::ordered_json homing_report(const HomingOutcome& outcome);

}  // namespace motionrack::rack
