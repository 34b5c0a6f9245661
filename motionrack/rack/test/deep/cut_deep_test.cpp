// The event trace does not depend on how time is divided into calls: a thousand seeds per kind of rack.
// MOTIONRACK_SEED=N sets the first seed, MOTIONRACK_CUTS=N their number.
#include <motionrack/rack/test/cut.hpp>
#include <tuple>

namespace motionrack::rack::cut {
namespace {

constexpr std::uint64_t shares = 4;

class ThousandCuts : public testing::TestWithParam<std::tuple<Bench, std::uint64_t>> {};

std::string name_of_share(const testing::TestParamInfo<ThousandCuts::ParamType>& one) {
    return std::string(std::get<0>(one.param).name) + "_" + std::to_string(std::get<1>(one.param));
}

const auto all_shares = testing::Range<std::uint64_t>(0, shares);
INSTANTIATE_TEST_SUITE_P(OfEachCard, ThousandCuts, testing::Combine(testing::ValuesIn(benches()), all_shares),
                         name_of_share);
INSTANTIATE_TEST_SUITE_P(OfTheMcx314, ThousandCuts, testing::Combine(testing::ValuesIn(mcx314_benches()), all_shares),
                         name_of_share);

TEST_P(ThousandCuts, ThroughTimeChangeNothing) {
    const auto& [bench, share] = GetParam();
    const std::uint64_t first = seed_from_environment(), count = cases("MOTIONRACK_CUTS", 1'000);
    for (std::uint64_t i = share; i < count && !HasFatalFailure(); i += shares)
        expect_the_same_however_it_is_cut(bench, first + i);
}

}  // namespace
}  // namespace motionrack::rack::cut
