// The event trace does not depend on how time is divided into calls: for each card, driven at random, with its machine.
#include <motionrack/rack/test/cut.hpp>

namespace motionrack::rack::cut {
namespace {

class Cut : public testing::TestWithParam<Bench> {};
INSTANTIATE_TEST_SUITE_P(OfEachCard, Cut, testing::ValuesIn(benches()),
                         [](const auto& one) { return std::string(one.param.name); });
INSTANTIATE_TEST_SUITE_P(OfTheMcx314, Cut, testing::ValuesIn(mcx314_benches()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(Cut, OfTimeDoesNotChangeTheEventTrace) {
    const std::uint64_t first = seed_from_environment(), count = cases("MOTIONRACK_CUTS", 30);
    for (std::uint64_t i = 0; i < count && !HasFatalFailure(); ++i)
        expect_the_same_however_it_is_cut(GetParam(), first + i);
}

// While the chip skips an arc at constant vector speed, a motor watches another range of the axis. The chip must then
// compute the bound of the skip (the end of the octant) again; it is valid until then.
TEST(CutThroughAnArc, AtConstantVectorSpeedDoesNotChangeTheEventTraceIfAMotorWatchesAnotherRange) {
    expect_the_same_however_it_is_cut(mcx314_benches().back(), 709850194);
}

}  // namespace
}  // namespace motionrack::rack::cut
