#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> s_curve(mcx314::Driver& card) {
    MOTIONRACK_CHECK(card.SetMultiple(axis_x | axis_y, 10));
    for (const unsigned axis : {axis_x, axis_y}) {
        const std::int64_t a = axis == axis_x ? 8000 : 80;  // out of reach: a full S; 80: straight in the middle
        MOTIONRACK_TRY(const mcx314::CurvePlan plan, card.plan(axis == axis_x ? 0 : 1, 100, 4000, a, 1010, 50'000));
        fmt::print("A {}: {} S, {:.4f} s and {} pulses up, at most {:.0f} pulses/s2, ends at {:.0f} pulses/s\n", a,
                   plan.full_s ? "full" : "partial", to_seconds(plan.rise.time()), plan.rise.pulses,
                   plan.peak_acceleration(plan.rise), plan.hz(plan.end_v));
        MOTIONRACK_CHECK(card.SCurve_F(axis, 100, 4000, a, 1010, 50'000));
    }
    MOTIONRACK_CHECK(card.wait_until_done(axis_x | axis_y, whole_seconds(10)));
    fmt::print("X {}, Y {}\n", card.ReadLPS(0), card.ReadLPS(1));
    return {};
}

}  // namespace howto
