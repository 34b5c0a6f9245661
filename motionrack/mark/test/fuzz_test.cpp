// Runs the fuzz targets with their seeds and many damaged copies of them; mark_fuzz.hpp lists the invariants.
//
// The environment variables MOTIONRACK_SEED and MOTIONRACK_JOBS select another and a longer run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <motionrack/mark/test/mark_fuzz.hpp>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <tests/environment.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>
#include <vector>

namespace motionrack::mark {
namespace {

std::vector<std::string> corpus(const char* name) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(source_root / "tests/fuzz/corpus" / name))
        paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> out;
    for (const auto& path : paths) out.push_back(text_of(path));
    return out;
}

/// Damages a text one to four times: changes, removes or duplicates a few bytes, or inserts some from another seed.
std::string damaged(std::string text, const std::vector<std::string>& seeds, motionrack::fuzz::Random& random) {
    for (std::uint32_t n = random.below(4) + 1; n > 0 && !text.empty(); --n) {
        const std::size_t at = random.below(static_cast<std::uint32_t>(text.size())), length = random.below(12) + 1;
        switch (random.below(5)) {
            case 0:
                text[at] = static_cast<char>(random.word());
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(random.below(static_cast<std::uint32_t>(text.size())), length));
                break;
            case 3:
                text[at] = "0123456789.-eE+ '\"<>=[]\n"[random.below(24)];
                break;
            default: {
                const std::string& other = seeds[random.below(static_cast<std::uint32_t>(seeds.size()))];
                if (!other.empty())
                    text.insert(at, other.substr(random.below(static_cast<std::uint32_t>(other.size())), 3 * length));
            }
        }
    }
    return text;
}

void run(const char* name, std::string (*check)(std::string_view), std::uint64_t jobs) {
    const std::vector<std::string> seeds = corpus(name);
    ASSERT_GE(seeds.size(), 5u);
    for (const std::string& seed : seeds) ASSERT_EQ(check(seed), "") << seed;
    const std::uint64_t seed = seed_from_environment();
    jobs = cases("MOTIONRACK_JOBS", jobs);
    std::cout << "MOTIONRACK_SEED=" << seed << ", " << jobs << " jobs" << std::endl;
    for (std::uint64_t i = 0; i < jobs; ++i) {
        motionrack::fuzz::Random random(seed * 1'000'003 + i);
        const std::string text = damaged(seeds[random.below(static_cast<std::uint32_t>(seeds.size()))], seeds, random);
        ASSERT_EQ(check(text), "") << "job " << i << ":\n" << text;
    }
}

TEST(MarkFuzz, DamagedDrawingsAreReadOrRefusedWithTheirLocation) {
    run("drawing", fuzz::check_drawing, 4'000);
}
TEST(MarkFuzz, DamagedJobsAreRunOrRefusedWithTheirLocation) {
    run("mark_job", fuzz::check_job, 400);
}

}  // namespace
}  // namespace motionrack::mark
