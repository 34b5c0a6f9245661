// Ten thousand random programs of any shape, a thousand in each test; minutes in all. MOTIONRACK_SEED=N sets the first
// program, MOTIONRACK_PROGRAMS=N the number in each test.
#include <gtest/gtest.h>

#include <motionrack/control/trajectory/test/offline_trajectory_checks.hpp>
#include <tests/environment.hpp>

namespace motionrack::control {
namespace {

class RandomOfflineTrajectory : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomOfflineTrajectory, KeepsLimitsAndToleranceAtEveryInstant) {
    const std::uint64_t count = cases("MOTIONRACK_PROGRAMS", 1'000);
    const std::uint64_t first = seed_from_environment() + GetParam() * count;
    int faults = 0;
    for (std::uint64_t seed = first; seed < first + count && faults < 5; ++seed) {
        const trajectory_test::WildProgram program = trajectory_test::WildMaker(seed).program();
        const trajectory_test::Fault fault = trajectory_test::fault_of(program);
        EXPECT_EQ(fault.name, "") << "seed " << seed << ": " << fault.text << "\nthe least of it:\n"
                                  << trajectory_test::text_of(trajectory_test::reduced(program));
        faults += !fault.name.empty();
    }
}

INSTANTIATE_TEST_SUITE_P(Thousand, RandomOfflineTrajectory, testing::Range<std::uint64_t>(0, 10));

}  // namespace
}  // namespace motionrack::control
