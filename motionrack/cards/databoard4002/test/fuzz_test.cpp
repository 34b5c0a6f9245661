// A million random accesses to any port; the invariants are in card_fuzz.hpp.
//
// MOTIONRACK_SEED and MOTIONRACK_ACCESSES in the environment select another and a longer run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <motionrack/cards/databoard4002/test/card_fuzz.hpp>
#include <tests/environment.hpp>

namespace motionrack::databoard4002 {
namespace {

TEST(Databoard4002Fuzz, TheCardSurvivesAnyAccessAtAnyTime) {
    const std::uint64_t seed = seed_from_environment();
    const auto count = static_cast<std::int64_t>(cases("MOTIONRACK_ACCESSES", 1'000'000));
    std::cout << "MOTIONRACK_SEED=" << seed << ", " << count << " accesses" << std::endl;
    fuzz::Verdict verdict;
    for (std::uint64_t card = 0; verdict.accesses < count && verdict.problem.empty(); ++card) {
        motionrack::fuzz::Random random(seed * 1'000'003 + card);
        fuzz::run(random, 10'000, verdict);
    }
    EXPECT_EQ(verdict.problem, "");
    EXPECT_GE(verdict.accesses, count);
    std::cout << verdict.seconds << " s, " << verdict.pulses << " pulses, " << verdict.resets << " resets, "
              << verdict.watchdogs << " by the watchdog" << std::endl;
    if (count >= 1'000'000) {
        EXPECT_GT(verdict.pulses, 1'000'000);
        EXPECT_GT(verdict.resets, 1'000);
        EXPECT_GT(verdict.watchdogs, 20);
    }
}

}  // namespace
}  // namespace motionrack::databoard4002
