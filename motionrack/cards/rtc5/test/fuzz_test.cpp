// Runs the fuzzer with random commands and arbitrary numbers; card_fuzz.hpp lists the invariants.
//
// MOTIONRACK_SEED and MOTIONRACK_JOBS in the environment select another and a longer run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <motionrack/cards/rtc5/test/card_fuzz.hpp>
#include <tests/environment.hpp>

namespace motionrack::rtc5 {
namespace {

TEST(Rtc5Fuzz, SurvivesCommandsWithArbitraryArguments) {
    const std::uint64_t seed = seed_from_environment(), jobs = cases("MOTIONRACK_JOBS", 60);
    std::cout << "MOTIONRACK_SEED=" << seed << ", " << jobs << " jobs" << std::endl;
    fuzz::Verdict verdict;
    for (std::uint64_t i = 0; i < jobs && verdict.problem.empty(); ++i) {
        motionrack::fuzz::Random random(seed * 1'000'003 + i);
        fuzz::run(random, 600, verdict);
        EXPECT_EQ(verdict.problem, "") << "job " << i;
    }
    std::cout << verdict.commands << " commands, " << verdict.refused << " refused, " << verdict.ticks << " ticks, "
              << verdict.files << " files" << std::endl;
    const auto drawn = static_cast<std::int64_t>(jobs);
    EXPECT_GT(verdict.commands - verdict.refused, 66 * drawn);
    EXPECT_GT(verdict.refused, 166 * drawn);
}

}  // namespace
}  // namespace motionrack::rtc5
