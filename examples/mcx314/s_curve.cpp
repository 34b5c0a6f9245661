#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> s_curve(mcx314::Driver& card) {
    const unsigned both = axis_x | axis_y;
    MOTIONRACK_CHECK(card.SetMultiple(both, 10));
    MOTIONRACK_CHECK(card.SCurve_F(axis_x, 100, 4000, 8000, 1010, 50'000));  // A out of reach: a full S
    MOTIONRACK_CHECK(card.SCurve_F(axis_y, 100, 4000, 80, 1010, 50'000));    // A at 80: straight in the middle
    MOTIONRACK_CHECK(card.wait_until_done(both, whole_seconds(10)));
    fmt::print("X {}, Y {}\n", card.ReadLPS(0), card.ReadLPS(1));

    mcx314::CurveData data;
    data.R = 800'000, data.SV = 100, data.V = 4000, data.K = 1010, data.pulses = 50'000, data.s_curve = true;
    for (const std::int64_t a : {8000, 80}) {
        data.A = a;
        MOTIONRACK_TRY(const mcx314::CurvePlan plan, mcx314::plan_drive(data));
        fmt::print("A {}: {} S, {:.4f} s up, {} pulses, at most {:.0f} pulses/s2\n", a, plan.full_s ? "full" : "partial",
                   to_seconds(plan.rise.time()), plan.rise.pulses, plan.peak_acceleration(plan.rise));
    }
    return {};
}

}  // namespace howto
