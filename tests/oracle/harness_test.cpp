// Tests the harness of the oracle tests with a card that has one fault: after a step 3 it executes each step 5 wrongly.
#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>

#include <algorithm>
#include <tests/oracle/changes.hpp>
#include <tests/oracle/harness.hpp>
#include <vector>

namespace motionrack::oracle {
namespace {

using testing::ElementsAre;

struct Toy {
    std::vector<int> ops;
    std::size_t snapshot_at = never;
};

void run_both(const Toy& toy, Comparison& both) {
    const auto three = std::find(toy.ops.begin(), toy.ops.end(), 3);
    both.same("wrong", 0, static_cast<int>(std::count(three, toy.ops.end(), 5)));
    both.count("steps", toy.ops.size());
}
std::string listing_of(const Toy& toy) {
    return text_of_steps(toy.ops);
}

TEST(OracleHarness, LeavesOutAllStepsButThoseOfTheFailureAndTheLast) {
    const Toy small =
        shrink(Toy{{1, 2, 3, 4, 1, 5, 6, 7, 9}, 4}, [](const Toy& toy) { return !comparison_of(toy).equal(); });
    EXPECT_THAT(small.ops, ElementsAre(3, 5, 9));
    EXPECT_EQ(small.snapshot_at, 1u) << "that of the first step which is left of those from 4 on";
}

void compare_toys() {
    compare({100, 50}, [](std::uint64_t, std::uint64_t number) {
        return number == 117 ? Toy{{0, 3, 0, 5, 9}} : Toy{{5, 3, 0, 9}};
    });
}

TEST(OracleHarness, PrintsTheShortenedProgramOfADifference) {
    EXPECT_FATAL_FAILURE(compare_toys(), "wrong: twin 0, card 1\n    0 3\n    1 5\n    2 9\nTo run it again: MOTION");
}

TEST(OracleHarness, RunsEachProgramOfItsSeriesOnce) {
    std::vector<std::uint64_t> numbers;
    compare({7, 3}, [&](std::uint64_t, std::uint64_t number) {
        numbers.push_back(number);
        return Toy{{5, 9}};
    });
    EXPECT_THAT(numbers, ElementsAre(7, 8, 9));
}

TEST(OracleHarness, ReportsTheFirstElementsThatDiffer) {
    const std::vector<int> twin = {1, 2, 3}, other = {1, 7, 8}, shorter = {1, 2};
    Comparison both;
    both.same_elements("word", twin, twin);
    EXPECT_TRUE(both.equal());
    both.same_elements("word", twin, other);
    both.same_elements("word", twin, shorter);
    EXPECT_EQ(both.differences(), "word 1: twin 2, card 7\nword 2: twin 3, card none\n");
}

TEST(OracleHarness, DisturbedStateIsRestoredWithWhatWasRecorded) {
    struct {
        int state = 4;
        int snapshot() const { return state; }
        void restore(int saved) { state = saved; }
    } kernel;
    std::vector<int> recorded = {1, 2};
    disturb_and_restore(
        kernel, [&] { kernel.state = 5, recorded = {3}; }, recorded);
    EXPECT_EQ(kernel.state, 4);
    EXPECT_THAT(recorded, ElementsAre(1, 2));
}

TEST(OracleHarness, OnlyTheLastLevelOfAnInstantIsAChange) {
    const std::vector<Change> raw = {{9, 1, 1}, {5, 0, 1}, {9, 0, 0}, {9, 1, 0}, {9, 0, 7}, {12, 0, 7}};
    EXPECT_THAT(settled(raw, {0, 0}), ElementsAre(Change{5, 0, 1}, Change{9, 0, 7}));
}

}  // namespace
}  // namespace motionrack::oracle
