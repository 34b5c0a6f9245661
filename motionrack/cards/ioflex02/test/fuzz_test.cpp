// Half a million random accesses; the invariants are in card_fuzz.hpp. Equal inputs give equal histories.
//
// MOTIONRACK_SEED and MOTIONRACK_ACCESSES in the environment select another and a longer run.
#include <gtest/gtest.h>

#include <iostream>
#include <motionrack/cards/ioflex02/test/card_fuzz.hpp>
#include <motionrack/cards/ioflex02/test/rig.hpp>

namespace motionrack::ioflex02 {
namespace {

TEST(Ioflex02Fuzz, TheCardSurvivesAnyAccessAtAnyTime) {
    const std::uint64_t seed = seed_from_environment();
    const auto count = static_cast<std::int64_t>(cases("MOTIONRACK_ACCESSES", 500'000));
    std::cout << "MOTIONRACK_SEED=" << seed << ", " << count << " accesses" << std::endl;
    fuzz::Verdict verdict;
    for (std::uint64_t card = 0; verdict.accesses < count && verdict.problem.empty(); ++card) {
        motionrack::fuzz::Random random(seed * 1'000'003 + card);
        fuzz::run(random, 5'000, verdict);
    }
    EXPECT_EQ(verdict.problem, "");
    EXPECT_GE(verdict.accesses, count);
    std::cout << verdict.seconds << " s, " << verdict.counts << " counts, " << verdict.images << " images taken, "
              << verdict.refused << " refused" << std::endl;
    if (count < 500'000) return;
    EXPECT_GT(verdict.counts, 20'000);
    EXPECT_GT(verdict.illegal, 1'000);
    EXPECT_GT(verdict.images, 500);
    EXPECT_GT(verdict.refused, 500);
}

TEST(Ioflex02Fuzz, EqualInputsGiveEqualEventTracesHoweverOftenTheyAreObserved) {
    std::mt19937_64 random(seed_from_environment(2004));
    Rig one, two;
    one.start();
    two.start();
    for (int i = 0; i < 20'000; ++i) {
        const std::string pin(map::pins[random() % 32].name);
        const int level = static_cast<int>(random() % 2), value = static_cast<int>(random() % 256);
        const auto at = static_cast<std::uint32_t>(2 * (random() % 0x34));
        const Duration time{static_cast<std::int64_t>(random() % 5'000)};
        for (Rig* rig : {&one, &two}) {
            rig->set(pin, level);
            if (value % 8 == 0) rig->write(at == 0 ? 0x10 : at, value);
            if (rig == &two && value % 16 < 8)
                for (std::uint32_t peeked = 0; peeked < window; peeked += 2) rig->card.peek(peeked);
            rig->run(time);
        }
    }
    EXPECT_EQ(one.kernel.state_hash(), two.kernel.state_hash());
    EXPECT_EQ(one.kernel.trace_hash(), two.kernel.trace_hash());
    for (const sim::Condition& c : one.kernel.conditions())
        ASSERT_EQ(describe(c, "c1").find("condition "), std::string::npos);
}

}  // namespace
}  // namespace motionrack::ioflex02
