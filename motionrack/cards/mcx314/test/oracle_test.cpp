// Compares the event-driven chip with the tick-by-tick twin: random register programs must give the same result for the
// host (every read, the interrupt line), for a motor (tick and direction of every pulse) and for listeners of counts
// only.
//
// tests/oracle/harness.hpp names the variables of the environment that select other and more programs.
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/test/chip_rig.hpp>
#include <tests/oracle/harness.hpp>

namespace motionrack::mcx314::twin {
namespace {

using oracle::programs;

constexpr ChipOptions as{Variant::mcx314as};

/// Compares `count` programs from number `first` on, each in the modes that `set_way(program)` chooses.
template <class SetWay>
void compare(std::uint64_t first, std::uint64_t count, const ChipOptions& options, const SetWay& set_way) {
    oracle::compare({first, count}, [&](std::uint64_t seed, std::uint64_t number) {
        Program program = make_program(seed, number, options);
        set_way(program);
        return program;
    });
}

TEST(Mcx314Oracle, RandomProgramsGiveTheSameReadingsOnTheChipAndItsTwin) {
    compare(0, programs(1'500, 10'000), {}, [](Program& p) {
        p.way = {p.number % 2 == 0, p.number % 4 >= 2, false, 0};
    });
}

TEST(Mcx314Oracle, RandomProgramsOfTheAsGiveTheSameReadingsOnTheChipAndItsTwin) {
    compare(10'000'000, programs(1'000, 6'000), as, [](Program& p) {
        p.way = {p.number % 2 == 0, p.number % 4 >= 2, false, 0};
    });
}

TEST(Mcx314Oracle, RandomProgramsGiveTheSameReadingsUnderOtherInterpretationsOfTheSources) {
    const auto way = [](Program& p) { p.way = {p.number % 2 == 0, p.number % 4 >= 2, p.number % 3 == 0, 0}; };
    std::uint64_t first = 20'000'000;
    const std::uint64_t count = programs(80, 500);
    for (const Variant variant : {Variant::mcx314, Variant::mcx314as}) {
        compare(first += 1000, count, {variant, SlowDrive::at_sv, SoftwareLimit::beyond, 0}, way);
        compare(first += 1000, count, {variant, SlowDrive::at_v, SoftwareLimit::at, 300}, way);
        compare(first += 1000, count, {variant, SlowDrive::at_sv, SoftwareLimit::at, 8}, way);
    }
}

TEST(Mcx314Oracle, FollowedOutputPinsChangeAtTheSameInstants) {
    const auto followed = [](Program& p) { p.way = {p.number % 2 == 0, false, true, 0}; };
    const std::uint64_t count = programs(100, 600);
    compare(3'000'000, count, {}, followed);
    compare(13'000'000, count, as, followed);
}

TEST(Mcx314Oracle, ARunDividedIntoSlicesGivesTheSameReadings) {
    const auto in_slices = [](Program& p) {
        p.way = {p.number % 2 == 0, p.number % 4 >= 2, p.number % 3 == 0, p.number};
    };
    const std::uint64_t count = programs(80, 400);
    compare(1'000'000, count, {}, in_slices);
    compare(11'000'000, count, as, in_slices);
}

TEST(Mcx314Oracle, ARestoredSnapshotContinuesIdentically) {
    const auto restored = [](Program& p) {
        p.way = {p.number % 2 == 0, false, p.number % 3 == 0, 0};
        p.snapshot_at = p.number % (p.ops.size() - 1);
    };
    const std::uint64_t count = programs(80, 400);
    compare(2'000'000, count, {}, restored);
    compare(12'000'000, count, as, restored);
}

}  // namespace
}  // namespace motionrack::mcx314::twin
