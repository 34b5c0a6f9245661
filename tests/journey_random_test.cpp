// Random part programs: all kinds of moves and modes, one to four axes, large and tiny moves. MOTIONRACK_SEED=N selects
// the first program, MOTIONRACK_PROGRAMS=N the number of each kind.
#include <fmt/format.h>

#include <cstdlib>
#include <random>
#include <tests/goes_on.hpp>

#include "journey.hpp"
#include "random_program.hpp"

namespace motionrack::rack {
namespace {

/// Sums the rounding to pulses, the chip's half pulse, the integer centre of an arc, and the chord error. Adds the
/// share of the path tolerance for blended corners (limited jerk) or merged short moves.
double max_deviation(const RackConfig& config, const test::RandomProgram& program, const JobOutcome& outcome) {
    return 3.0 / 640 + (program.chords ? 0.0021 : 0) + (config.jerk_limited() ? 1 : 0.25) * outcome.tolerance_mm;
}

/// Executes them one after the other; returns the share that the reader accepted (an arc may leave the travel).
double drive_random(const std::string& profile, test::ProgramSize size) {
    const std::uint64_t first = seed_from_environment(), everyday = thorough() ? 40 : 10,
                        count = cases("MOTIONRACK_PROGRAMS", everyday);
    const RackConfig config = router(profile);
    std::uint64_t driven = 0, made = 0;
    for (; goes_on(made, count, everyday, 4 * driven > made); ++made) {
        const std::uint64_t seed = first + made;
        const test::RandomProgram program = test::ProgramMaker(seed, size).make();
        if (!control::gcode::check_program(program.text, reader_settings(config), 1).problems.empty()) continue;
        SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed) + "\n" + program.text);
        const Done done = drive(config, program.text);
        // Rounding merges two chords or lengthens one: the next one then has the corners of both.
        expect_exact(done.outcome, size == test::ProgramSize::tiny ? 0 : program.chords ? 1.6 : 1.15);
        EXPECT_LE(done.outcome.max_deviation.mm, max_deviation(config, program, done.outcome))
            << "line " << done.outcome.max_deviation.line;
        for (std::size_t i = 0; i < done.outcome.axes.size(); ++i)
            EXPECT_NEAR(done.outcome.axes[i].actual_end, program.end[i], 0.51 / config.axes[i].pulses_per_unit()) << i;
        ++driven;
        if (testing::Test::HasFailure() && count < 100) break;
    }
    return static_cast<double>(driven) / static_cast<double>(made);
}

class JourneyAtRandom : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(With, JourneyAtRandom, testing::Values("trapezoid", "jerk_limited"),
                         [](const auto& each) { return std::string(each.param); });

TEST_P(JourneyAtRandom, BigMovesEndExactlyStayOnTheirPathAndKeepTheLimits) {
    EXPECT_GT(drive_random(GetParam(), test::ProgramSize::big), 0.25);
}

TEST_P(JourneyAtRandom, SmallMovesEndExactlyStayOnTheirPathAndKeepTheLimits) {
    EXPECT_GT(drive_random(GetParam(), test::ProgramSize::small), 0.25);
}

TEST_P(JourneyAtRandom, BigAndSmallMovesMixedEndExactlyStayOnTheirPathAndKeepTheLimits) {
    EXPECT_GT(drive_random(GetParam(), test::ProgramSize::mixed), 0.25);
}

TEST_P(JourneyAtRandom, TinyMovesEndExactlyStayOnTheirPathAndKeepVelocityAndAcceleration) {
    EXPECT_GT(drive_random(GetParam(), test::ProgramSize::tiny), 0.25);
}

TEST_P(JourneyAtRandom, StoppedAtAnyInstantTheyStopOnTheirPathAndKeepTheLimits) {
    const std::uint64_t first = seed_from_environment(), everyday = thorough() ? 40 : 20,
                        count = cases("MOTIONRACK_PROGRAMS", everyday);
    const RackConfig config = router(GetParam());
    std::uint64_t stopped = 0, made = 0;
    for (; goes_on(made, count, everyday, 4 * stopped > made); ++made) {
        const std::uint64_t seed = first + made;
        const test::RandomProgram program = test::ProgramMaker(seed, test::ProgramSize::mixed).make();
        if (!control::gcode::check_program(program.text, reader_settings(config), 1).problems.empty()) continue;
        SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed) + "\n" + program.text);
        const double at = 0.3 + static_cast<double>(seed % 37);
        std::atomic<bool> stop{false};
        const Done done =
            drive(config, program.text, &stop, [&](const Rack& rack) { stop = to_seconds(rack.kernel().now()) >= at; });
        expect_limits(done.outcome, program.chords ? 1.6 : 1.15);
        EXPECT_LE(done.outcome.max_deviation.mm, max_deviation(config, program, done.outcome))
            << "line " << done.outcome.max_deviation.line;
        if (done.outcome.ended) continue;
        EXPECT_EQ(done.outcome.ended.error().kind, ErrorKind::stopped) << done.outcome.ended.error().text();
        // The next junction in the chip's queue, and the longest deceleration from the maximum velocity.
        EXPECT_LE(to_seconds(done.outcome.time), at + 2.5);
        ++stopped;
        if (testing::Test::HasFailure()) break;
    }
    EXPECT_GE(4 * stopped, made) << "most last longer than until their stop";
}

/// Makes lines with X, Y, Z and A each.
std::string four_axes(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto somewhere = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 10'000) / 10'000;
    };
    std::string out = "G21 G90 G94 G64 P0.05 F1200\n";
    double a = 0;
    for (int i = 0; i < 40; ++i) {
        a += somewhere(-40, 40);
        out += fmt::format("G1 X{:.3f} Y{:.3f} Z{:.3f} A{:.3f}\n", somewhere(90, 110), somewhere(90, 110),
                           somewhere(50, 70), a);
    }
    return out + "M2\n";
}

void drive_four_axes(std::uint64_t first, std::uint64_t count) {
    const RackConfig config = router("jerk_limited");
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const std::string program = four_axes(seed);
        SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed) + "\n" + program);
        const Done done = drive(config, program);
        expect_exact(done.outcome, 0);
        EXPECT_NEAR(to_seconds(done.outcome.time) / done.outcome.run.plan.seconds, 1, 0.01);
        if (testing::Test::HasFailure()) break;
    }
}

TEST(FourAxesTogether, TakeTheTimeOfThePlanWithLimitedJerkAndLoseNoStep) {
    drive_four_axes(seed_from_environment(), cases("MOTIONRACK_PROGRAMS", thorough() ? 40 : 20));
}

TEST(FourAxesTogether, LoseNoStepWhereTheFourthSlowsDownAheadOfTheOthers) {
    drive_four_axes(406820574, 1);
}

}  // namespace
}  // namespace motionrack::rack
