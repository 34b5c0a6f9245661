#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> arc(mcx314::Driver& card) {
    const unsigned axes = axis_x | axis_y;
    MOTIONRACK_CHECK(card.SetMultiple(axes, 10));
    mcx314::CIRCLEDATA circle;
    circle.SV = 100, circle.V = 500, circle.A = 50;
    circle.C = {-3000, 0};                             // centre and finish as seen from the start
    circle.P = {-3000, 3000};                          // a quarter, counter-clockwise
    MOTIONRACK_CHECK(card.CircleCCW_T(circle, axes));  // the library finds where to decelerate
    MOTIONRACK_CHECK(card.wait_until_done(axes, whole_seconds(30)));
    fmt::print("quarter: X {}, Y {}\n", card.ReadLPS(0), card.ReadLPS(1));

    circle.P = {0, 0};  // a full circle
    circle.C = {0, -1000};
    MOTIONRACK_CHECK(card.CircleCW_C(circle, axes));
    MOTIONRACK_CHECK(card.wait_until_done(axes, whole_seconds(30)));
    fmt::print("circle:  X {}, Y {}\n", card.ReadLPS(0), card.ReadLPS(1));

    circle.P = {10'000, 20'000};  // not on a circle around (5000, 0)
    circle.C = {5000, 0};
    const auto refused = card.CircleCW_C(circle, axes);
    fmt::print("{}\n", refused ? "?" : refused.error().text());
    return {};
}

}  // namespace howto
