// MOTIONRACK_SEED=N sets the first random program, MOTIONRACK_PROGRAMS=N their number.
#include <motionrack/rack/test/lossless_random.hpp>

namespace motionrack::rack {
namespace {

constexpr std::uint64_t shares = 16;
class ThousandsOfPrograms : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Share, ThousandsOfPrograms, testing::Range<std::uint64_t>(0, shares));

TEST_P(ThousandsOfPrograms, NoAxisExceedsItsMaxVelocityStepWhateverIsCommandedOnTheWay) {
    drive_share(GetParam(), shares, 10'000, drive_disturbed);
}

TEST_P(ThousandsOfPrograms, ALateHostCostsTimeAndNoPulse) {
    drive_share(GetParam(), shares, 1'000, drive_late);
}

}  // namespace
}  // namespace motionrack::rack
