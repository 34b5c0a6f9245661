#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> asymmetric(mcx314::Driver& card) {
    mcx314::CurveData data;
    data.R = 800'000, data.SV = 100, data.V = 4000, data.A = 400, data.D = 100, data.pulses = 60'000;
    data.asymmetric = true;
    MOTIONRACK_TRY(const std::int64_t point, mcx314::best_dec_point(data));
    fmt::print("deceleration begins after {} of 60000 pulses\n", point);

    MOTIONRACK_CHECK(card.SetMultiple(axis_x, 10));
    MOTIONRACK_CHECK(card.SetAsymmetric(axis_x, true));  // decelerations take D
    MOTIONRACK_CHECK(card.SetD(axis_x, 100));
    MOTIONRACK_CHECK(card.ManualDec(axis_x, point));
    MOTIONRACK_CHECK(card.TCurve_F(axis_x, 100, 4000, 400, 60'000));
    MOTIONRACK_CHECK(card.wait_until_done(axis_x, whole_seconds(10)));
    fmt::print("LP {}\n", card.ReadLPS(0));

    data.dec_point = point;
    MOTIONRACK_TRY(const mcx314::CurvePlan plan, mcx314::plan_drive(data));
    fmt::print("up {:.4f} s, down {:.4f} s, {} pulses left at SV\n", to_seconds(plan.rise.time()),
               to_seconds(plan.fall.time()), plan.creep.pulses);
    return {};
}

}  // namespace howto
