#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> line(mcx314::Driver& card) {
    const unsigned axes = axis_x | axis_y | axis_z;
    MOTIONRACK_CHECK(card.SetMultiple(axes, 10));
    mcx314::LINEDATA to;
    to.SV = 100, to.V = 3000, to.A = 200;  // of the longest axis, here Z
    to.P = {10'000, -20'000, 30'000};
    MOTIONRACK_CHECK(card.Line3D_T(to, axes));
    card.interrupt().pass(milliseconds(500));
    MOTIONRACK_TRY(const auto speeds, card.axis_speeds());
    fmt::print("on the way: X {:.0f}, Y {:.0f}, Z {:.0f} pulses/s\n", speeds[0], speeds[1], speeds[2]);
    MOTIONRACK_CHECK(card.wait_until_done(axes, whole_seconds(10)));
    fmt::print("X {}, Y {}, Z {}\n", card.ReadLPS(0), card.ReadLPS(1), card.ReadLPS(2));
    return {};
}

}  // namespace howto
