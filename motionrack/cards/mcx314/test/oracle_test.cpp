// The event-driven chip against the tick-by-tick twin: random register programs must give the same result for the host
// (every read, the interrupt line), for a motor (tick and direction of every pulse) and for listeners of counts only.
//
// MOTIONRACK_SEED and MOTIONRACK_PROGRAMS in the environment select other and more programs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <motionrack/cards/mcx314/test/chip_rig.hpp>
#include <motionrack/cards/mcx314/test/shrink.hpp>
#include <string>
#include <tests/environment.hpp>

namespace motionrack::mcx314::twin {
namespace {

constexpr ChipOptions as{Variant::mcx314as};

// Number of compared items.
struct Compared {
    std::int64_t ticks = 0, pulses = 0, ops = 0, requests = 0, changes = 0;
};

std::string fault(const Program& program, const Way& way, Compared* compared = nullptr) {
    const Outcome twin = run_on_twin(program, way.follow);
    if (compared) {
        compared->ticks += program.ops.back().tick;
        compared->pulses += static_cast<std::int64_t>(twin.pulses.size());
        compared->ops += static_cast<std::int64_t>(program.ops.size());
        compared->requests += static_cast<std::int64_t>(twin.requests.size());
        compared->changes += static_cast<std::int64_t>(twin.changes.size());
    }
    return difference(program, twin, run_on_chip(program, way), way);
}

// Runs `count` programs from number `first` on, in the mode given by `way_of(number)`; stops at the first difference.
template <class WayOf>
void compare(std::uint64_t first, std::uint64_t count, const ChipOptions& options, const WayOf& way_of) {
    const std::uint64_t seed = seed_from_environment();
    std::cout << "MOTIONRACK_SEED=" << seed << ", programs " << first << " .. " << first + count - 1 << std::endl;
    Compared compared;
    for (std::uint64_t number = first; number < first + count; ++number) {
        const Program program = make_program(seed, number, options);
        const Way way = way_of(program);
        if (fault(program, way, &compared).empty()) continue;
        const Program small = shrink(program, [&](const Program& p) { return !fault(p, way).empty(); });
        FAIL() << "the chip and its twin differ" << (way.listen ? "" : " (nobody listens to edges)") << '\n'
               << fault(small, way) << to_text(small);
    }
    std::cout << compared.ops << " accesses and wire changes, " << compared.ticks << " ticks, " << compared.pulses
              << " pulses, " << compared.requests << " changes of the interrupt line, " << compared.changes
              << " of output pins" << std::endl;
}

TEST(Mcx314Oracle, RandomProgramsGiveTheSameReadingsOnTheChipAndItsTwin) {
    compare(0, trials("MOTIONRACK_PROGRAMS", 1'500, 10'000), {}, [](const Program& p) {
        return Way{p.number % 2 == 0, p.number % 4 >= 2, false, 0, 0};
    });
}

TEST(Mcx314Oracle, RandomProgramsOfTheAsGiveTheSameReadingsOnTheChipAndItsTwin) {
    compare(10'000'000, trials("MOTIONRACK_PROGRAMS", 1'000, 6'000), as, [](const Program& p) {
        return Way{p.number % 2 == 0, p.number % 4 >= 2, false, 0, 0};
    });
}

TEST(Mcx314Oracle, RandomProgramsGiveTheSameReadingsUnderOtherInterpretationsOfTheSources) {
    const auto way = [](const Program& p) {
        return Way{p.number % 2 == 0, p.number % 4 >= 2, p.number % 3 == 0, 0, 0};
    };
    std::uint64_t first = 20'000'000;
    const std::uint64_t count = trials("MOTIONRACK_PROGRAMS", 80, 500);
    for (const Variant variant : {Variant::mcx314, Variant::mcx314as}) {
        compare(first += 1000, count, {variant, SlowDrive::at_sv, SoftwareLimit::beyond, 0}, way);
        compare(first += 1000, count, {variant, SlowDrive::at_v, SoftwareLimit::at, 300}, way);
        compare(first += 1000, count, {variant, SlowDrive::at_sv, SoftwareLimit::at, 8}, way);
    }
}

TEST(Mcx314Oracle, FollowedOutputPinsChangeAtTheSameInstants) {
    const auto followed = [](const Program& p) { return Way{p.number % 2 == 0, false, true, 0, 0}; };
    const std::uint64_t count = trials("MOTIONRACK_PROGRAMS", 100, 600);
    compare(3'000'000, count, {}, followed);
    compare(13'000'000, count, as, followed);
}

TEST(Mcx314Oracle, ARunDividedIntoSlicesGivesTheSameReadings) {
    const auto in_slices = [](const Program& p) {
        return Way{p.number % 2 == 0, p.number % 4 >= 2, p.number % 3 == 0, p.number, 0};
    };
    const std::uint64_t count = trials("MOTIONRACK_PROGRAMS", 80, 400);
    compare(1'000'000, count, {}, in_slices);
    compare(11'000'000, count, as, in_slices);
}

TEST(Mcx314Oracle, ARestoredSnapshotContinuesIdentically) {
    const auto restored = [](const Program& p) {
        return Way{p.number % 2 == 0, false, p.number % 3 == 0, 0, 1 + p.number % (p.ops.size() - 1)};
    };
    const std::uint64_t count = trials("MOTIONRACK_PROGRAMS", 80, 400);
    compare(2'000'000, count, {}, restored);
    compare(12'000'000, count, as, restored);
}

}  // namespace
}  // namespace motionrack::mcx314::twin
