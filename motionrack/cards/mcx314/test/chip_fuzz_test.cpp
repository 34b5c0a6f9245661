// Runs the fuzzer with a million random accesses, twice: the invariants hold, and the same numbers give the same
// history.
//
// MOTIONRACK_SEED and MOTIONRACK_ACCESSES in the environment select other and more of them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <motionrack/cards/mcx314/test/chip_fuzz.hpp>
#include <motionrack/cards/mcx314/test/program.hpp>
#include <tests/environment.hpp>

namespace motionrack::mcx314::fuzz {
namespace {

class Dice final : public Feed {
  public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}
    std::uint32_t word() override { return static_cast<std::uint32_t>(random_.next() >> 48); }
    bool empty() const override { return false; }

  private:
    twin::Random random_;
};

Verdict run_all(std::uint64_t seed, std::int64_t accesses, Variant variant) {
    Verdict verdict;
    for (std::uint64_t chip = 0; verdict.accesses < accesses && verdict.problem.empty(); ++chip) {
        Dice dice(seed * 1'000'003 + chip);
        run(dice, std::min<std::int64_t>(20'000, accesses - verdict.accesses), verdict, variant);
        if (!verdict.problem.empty()) verdict.problem += ", chip " + std::to_string(chip);
    }
    return verdict;
}

class ChipFuzz : public testing::TestWithParam<Variant> {};

TEST_P(ChipFuzz, AMillionRandomAccessesAreSurvivedAndReproducible) {
    const std::uint64_t seed = seed_from_environment();
    const std::int64_t accesses = static_cast<std::int64_t>(cases("MOTIONRACK_ACCESSES", 1'000'000));
    std::cout << "MOTIONRACK_SEED=" << seed << ", " << accesses << " accesses" << std::endl;
    const Verdict first = run_all(seed, accesses, GetParam());
    ASSERT_EQ(first.problem, "");
    std::cout << first.pulses << " pulses, " << first.exact_drives << " fixed drives that ended at P" << std::endl;
    EXPECT_GT(first.exact_drives, accesses / 1'000);
    const Verdict second = run_all(seed, accesses, GetParam());
    EXPECT_EQ(first.hash, second.hash);
}

INSTANTIATE_TEST_SUITE_P(Of, ChipFuzz, testing::Values(Variant::mcx314, Variant::mcx314as),
                         [](const auto& each) { return each.param == Variant::mcx314 ? "Mcx314" : "Mcx314As"; });

}  // namespace
}  // namespace motionrack::mcx314::fuzz
