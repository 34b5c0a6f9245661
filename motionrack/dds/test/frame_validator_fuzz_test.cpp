// Runs the fuzzer of the validator with random numbers.
#include <gtest/gtest.h>

#include <motionrack/dds/test/frame_validator_fuzz.hpp>

namespace motionrack::dds {
namespace {

TEST(FrameValidatorFuzz, KeepsItsInvariantsForAnyFrames) {
    Counts all;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        motionrack::fuzz::Random random(seed);
        fuzz::Run run(random);
        ASSERT_EQ(run.go(3000), "") << "seed " << seed;
        const Counts& c = run.judge().counts();
        all.used += c.used, all.late += c.late, all.lost += c.lost, all.jumps += c.jumps, all.wrong_crc += c.wrong_crc,
            all.stale += c.stale;
        all.malformed += c.malformed, all.wrong_words += c.wrong_words, all.conflicts += c.conflicts,
            all.restarts += c.restarts + c.takeovers;
    }
    for (const std::uint64_t count : {all.used, all.late, all.lost, all.jumps, all.wrong_crc, all.stale, all.malformed,
                                      all.wrong_words, all.conflicts, all.restarts})
        EXPECT_GT(count, 0u) << "the samples reach everything";
}

}  // namespace
}  // namespace motionrack::dds
