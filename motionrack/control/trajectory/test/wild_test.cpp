// Some random programs of any shape; ten thousand of them are in deep/.
#include <gtest/gtest.h>

#include <motionrack/control/trajectory/test/offline_trajectory_checks.hpp>
#include <motionrack/control/trajectory/test/oracle.hpp>

namespace motionrack::control {
namespace {

TEST(ARideOfAnything, KeepsAllThatHoldsAtEveryInstant) {
    for (std::uint64_t seed = 100'001; seed <= 100'060; ++seed) {
        const ride_test::WildProgram program = ride_test::WildMaker(seed).program();
        const ride_test::Fault fault = ride_test::fault_of(program);
        ASSERT_EQ(fault.name, "") << "seed " << seed << ": " << fault.text << "\nthe least of it:\n"
                                  << ride_test::text_of(ride_test::reduced(program));
    }
}

/// A step of the reference may be longer than a whole ramp; then it is too slow by this step at each end.
TEST(ARideOfAnything, IsNeverQuickerThanWithAnyJerk) {
    for (std::uint64_t seed = 100'001; seed <= 100'020; ++seed) {
        const ride_test::WildProgram program = ride_test::WildMaker(seed).program();
        for (const ride_test::KeptStretch& kept : ride_test::kept_ride(program.moves, program.limits, program.start)) {
            if (kept.curve.empty()) continue;
            EXPECT_GE(kept.stretch.seconds, ride_test::time_optimal_s(kept.curve, program.limits) * (1 - 2e-3))
                << seed << " line " << kept.stretch.line;
        }
    }
}

}  // namespace
}  // namespace motionrack::control
