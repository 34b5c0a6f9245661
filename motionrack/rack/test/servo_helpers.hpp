// Shared helpers of servo axis tests.
#pragma once

#include <string>

namespace motionrack::rack {

/// Returns a rack file of a carriage with 0.01 mm per count and 500 mm/s; `servo`: more keys of its servo, `rest`: more
/// sections.
inline std::string carriage(const std::string& servo = {}, const std::string& rest = {}) {
    return "[card.board]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"board\"\nlead_mm = 10\nencoder_counts_per_rev = "
           "1000\n"
           "max_velocity_mm_s = 500\ninitial_position_mm = 100\nmin_limit_mm = -200\nmax_limit_mm = "
           "2900\n[axis.X.servo]\n" +
           servo +
           "[axis.X.switches]\nlimit_minus_mm = -300\nlimit_plus_mm = 3000\ncam_from_mm = 126\ncam_to_mm = 132\n" +
           rest;
}

}  // namespace motionrack::rack
