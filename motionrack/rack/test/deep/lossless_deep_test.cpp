// MOTIONRACK_SEED=N picks the first random program, MOTIONRACK_PROGRAMS=N how many there are.
#include <motionrack/rack/test/lossless_random.hpp>

namespace motionrack::rack {
namespace {

constexpr std::uint64_t shares = 16;
class ThousandsOfPrograms : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Share, ThousandsOfPrograms, testing::Range<std::uint64_t>(0, shares));

TEST_P(ThousandsOfPrograms, NoAxisJumpsWhateverIsWishedOnTheWay) {
    const std::uint64_t first = seed_from_environment(), count = from_environment("MOTIONRACK_PROGRAMS", 10'000);
    for (std::uint64_t i = GetParam(); i < count && !HasFailure(); i += shares) drive_one(first + i);
}

}  // namespace
}  // namespace motionrack::rack
