// Thousands of machines, each from a seed. MOTIONRACK_SEED=N sets the first, MOTIONRACK_MACHINES=N the maximum number,
// MOTIONRACK_SWARM_SECONDS=N the maximum duration.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <motionrack/trace/test/scratch.hpp>
#include <string>
#include <tests/environment.hpp>
#include <tests/swarm/life.hpp>

namespace motionrack::swarm {
namespace {

SeedEnd driven(std::uint64_t seed) {
    const trace::Scratch scratch;
    const std::string folder = scratch.path("journals");
    std::filesystem::create_directory(folder);
    return drive_seed(seed, folder);
}

/// Divides the seeds among shards: each of four programs runs five parts in sequence.
constexpr std::uint64_t parts = 20, parts_of_a_shard = 5;

class Swarm : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Part, Swarm, testing::Range<std::uint64_t>(0, parts));

TEST_P(Swarm, KeepsTheInvariantsOfEveryRun) {
    const std::uint64_t first = seed_from_environment(), count = cases("MOTIONRACK_MACHINES", 2'000);
    const std::chrono::duration<double> time{static_cast<double>(from_environment("MOTIONRACK_SWARM_SECONDS", 0)) /
                                             parts_of_a_shard};
    const auto begun = std::chrono::steady_clock::now();
    int taken = 0, faults = 0;
    std::uint64_t i = GetParam();
    for (; i < count; i += parts) {
        if (time.count() > 0 && std::chrono::steady_clock::now() - begun > time) break;
        const SeedEnd end = driven(first + i);
        taken += end.taken;
        faults += end.faults;
        ASSERT_FALSE(end.finding) << fmt::format(
            "at {:.6f} s: {}: {}\n({})\n{}\nIt is run again with: MOTIONRACK_SEED={} MOTIONRACK_MACHINES=1 ./test -R "
            "swarm",
            to_seconds(end.finding->at), name_of(end.finding->rule), end.finding->text, end.what,
            fmt::join(end.story, "\n"), first + i);
    }
    if (time.count() > 0) std::cout << "machines up to seed " << first + i << '\n';
    if (i < 10 * parts) return;
    EXPECT_GT(taken, 0);
    EXPECT_GT(faults, 0);
}

TEST(SwarmSeed, GivesTheSameEventTraceTwice) {
    const std::uint64_t first = seed_from_environment();
    for (std::uint64_t seed = first; seed < first + 20; ++seed) {
        const SeedEnd once = driven(seed), again = driven(seed);
        EXPECT_EQ(once.history, again.history) << "MOTIONRACK_SEED=" << seed << " (" << once.what << ")";
        EXPECT_EQ(once.repeats, again.repeats);
        if (!once.repeats) continue;
        EXPECT_EQ(once.what, again.what);
        EXPECT_EQ(once.taken, again.taken);
    }
}

}  // namespace
}  // namespace motionrack::swarm
