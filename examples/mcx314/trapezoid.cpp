#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> trapezoid(mcx314::Driver& card) {
    MOTIONRACK_CHECK(card.SetMultiple(axis_x, 10));  // V and SV in steps of 10 pulses/s, A in steps of 1,250 pulses/s2
    MOTIONRACK_CHECK(card.TCurve_F(axis_x, 100, 4000, 200, 80'000));
    MOTIONRACK_CHECK(card.wait_until_done(axis_x, whole_seconds(10)));
    fmt::print("LP {}\n", card.ReadLPS(0));

    mcx314::CurveData data;  // the same without moving anything
    data.R = 800'000;
    data.SV = 100, data.V = 4000, data.A = 200, data.pulses = 80'000;
    MOTIONRACK_TRY(const mcx314::CurvePlan plan, mcx314::plan_drive(data));
    fmt::print("rise {:.4f} s, {} pulses; cruise {:.4f} s, {} pulses; fall {:.4f} s, {} pulses\n",
               to_seconds(plan.rise.time()), plan.rise.pulses, to_seconds(plan.cruise.time()), plan.cruise.pulses,
               to_seconds(plan.fall.time()), plan.fall.pulses);
    fmt::print("in all {:.4f} s, at most {:.0f} pulses/s\n", to_seconds(plan.time()), plan.top_hz());
    return {};
}

}  // namespace howto
