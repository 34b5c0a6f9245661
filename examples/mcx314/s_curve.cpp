#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> s_curve(mcx314::Driver& card) {
    mcx314::CurveData data;
    data.R = 800'000, data.SV = 100, data.V = 4000, data.K = 1010, data.pulses = 50'000, data.s_curve = true;
    MOTIONRACK_CHECK(card.SetMultiple(axis_x | axis_y, 10));
    for (const unsigned axis : {axis_x, axis_y}) {
        data.A = axis == axis_x ? 8000 : 80;                 // out of reach: a full S; 80: straight in the middle
        MOTIONRACK_TRY(data.AO, mcx314::best_offset(data));  // what the fall takes more than the rise
        MOTIONRACK_TRY(const mcx314::CurvePlan plan, mcx314::plan_drive(data));
        fmt::print("A {}: {} S, {:.4f} s and {} pulses up, at most {:.0f} pulses/s2, AO {}\n", data.A,
                   plan.full_s ? "full" : "partial", to_seconds(plan.rise.time()), plan.rise.pulses,
                   plan.peak_acceleration(plan.rise), data.AO);
        MOTIONRACK_CHECK(card.SetAO(axis, data.AO));
        MOTIONRACK_CHECK(card.SCurve_F(axis, data.SV, data.V, data.A, data.K, 50'000));
    }
    MOTIONRACK_CHECK(card.wait_until_done(axis_x | axis_y, whole_seconds(10)));
    fmt::print("X {}, Y {}\n", card.ReadLPS(0), card.ReadLPS(1));
    return {};
}

}  // namespace howto
