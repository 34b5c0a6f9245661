// Sequences of junctions: the choice compared with all possible sequences.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <motionrack/control/path/junction_planner.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

struct ChoiceRow {
    std::vector<LegLimits> legs;
    std::vector<Junction> junctions;  ///< one more than legs, starting with the beginning of the sequence
};

ChoiceRow random_row(unsigned seed, std::size_t legs) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
    ChoiceRow out;
    out.junctions.push_back({});
    for (std::size_t i = 0; i < legs; ++i) {
        out.legs.push_back({between(0.01, 3), between(5, 100), between(500, 3000), between(1e4, 1e5)});
        Junction junction;
        junction.can_pass = i + 1 < legs;
        junction.can_stop = !junction.can_pass || random() % 4 > 0;
        junction.velocity = between(0.1, 30);
        junction.half_blend_length = between(0, 0.3);
        junction.gain = between(0, 0.01);
        out.junctions.push_back(junction);
    }
    return out;
}

/// Returns the duration of all legs, s. `stops`: bit i for a stop at the end of leg i.
double seconds_of_row(const ChoiceRow& row, unsigned stops) {
    double seconds = 0;
    for (std::size_t i = 0; i < row.legs.size(); ++i) {
        const bool begin = i == 0 || (stops >> (i - 1) & 1) != 0, end = (stops >> i & 1) != 0;
        if (!(end ? row.junctions[i + 1].can_stop : row.junctions[i + 1].can_pass))
            return std::numeric_limits<double>::infinity();
        seconds += leg_duration_s(row.legs[i], row.junctions[i], begin, row.junctions[i + 1], end);
    }
    return seconds;
}

unsigned chosen(const ChoiceRow& row) {
    JunctionPlanner choice;
    choice.begin();
    unsigned stops = 0, taken = 0;
    for (std::size_t i = 0; i < row.legs.size(); ++i) {
        choice.add(row.legs[i], row.junctions[i + 1]);
        while (choice.decided() > 0) stops |= static_cast<unsigned>(choice.take()) << taken++;
        EXPECT_LE(i + 1 - taken, JunctionPlanner::max_junctions);
    }
    EXPECT_EQ(taken, row.legs.size());
    return stops;
}

TEST(JunctionPlanner, ChoosesTheFastestOfAllSequences) {
    for (unsigned seed = 1; seed <= 300; ++seed) {
        const ChoiceRow row = random_row(seed, 1 + seed % 9);
        double min_seconds = std::numeric_limits<double>::infinity();
        for (unsigned stops = 0; stops < 1u << row.legs.size(); ++stops)
            min_seconds = std::min(min_seconds, seconds_of_row(row, stops));
        ASSERT_NEAR(seconds_of_row(row, chosen(row)) / min_seconds, 1, 1e-12) << seed;
    }
}

TEST(JunctionPlanner, DecidesTheBeginningOfALongSequenceBeforeItsEndIsKnown) {
    for (unsigned seed = 1; seed <= 20; ++seed) chosen(random_row(seed, 30));
}

TEST(Leg, TooShortForItsBlendsHasNoProfile) {
    const LegLimits leg{0.1, 100, 1000, 20'000};
    Junction turn;
    turn.velocity = 10;
    turn.half_blend_length = 0.1;
    EXPECT_GT(leg_duration_s(leg, turn, false, Junction{}, true), 1e9);
    EXPECT_LT(leg_duration_s(leg, Junction{}, true, Junction{}, true), 0.1);
}

}  // namespace
}  // namespace motionrack::control
