// The racks of the swarm: steppers and servos, some with a door, a second channel of the emergency stop, a belt and a
// laser.
#pragma once

#include <motionrack/rack/config.hpp>
#include <string>
#include <tests/swarm/draws.hpp>

namespace motionrack::swarm {

/// Draws a rack and adds its description to `what`.
rack::RackConfig draw_rack(Draws& draws, std::string& what);

}  // namespace motionrack::swarm
