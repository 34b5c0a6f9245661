// Random part programs: all kinds of moves and modes, one to four axes, big pieces and tiny ones.
// MOTIONRACK_SEED=N picks the first program, MOTIONRACK_PROGRAMS=N how many of each kind.
#include <cstdlib>
#include <iostream>

#include "journey.hpp"
#include "random_program.hpp"

namespace motionrack::rack {
namespace {

/// Drives them one after the other; returns how many the reader took (an arc may bulge beyond the travel).
int drive_random(const std::string& profile, test::ProgramSize size) {
    const std::uint64_t first = number_from("MOTIONRACK_SEED", 1), count = number_from("MOTIONRACK_PROGRAMS", 40);
    const RackConfig config = router(profile);
    int driven = 0;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const test::RandomProgram program = test::ProgramMaker(seed, size).make();
        if (!control::gcode::check_program(program.text, reader_settings(config), 1).problems.empty()) continue;
        SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed) + "\n" + program.text);
        const Done done = drive(config, program.text);
        // Rounding makes two chords one or one longer: then the next takes the turn of both.
        expect_exact(done.outcome, size == test::ProgramSize::tiny ? 0 : program.chords ? 1.6 : 1.15);
        // The rounding to pulses, the chip's half pulse and the whole centre of an arc; and what chords leave out. With limited jerk
        // corners are cut: see the stream's tests for the programmed path.
        EXPECT_LE(done.outcome.worst.mm, 3.0 / 640 + (program.chords ? 0.0021 : 0)) << "line " << done.outcome.worst.line;
        for (std::size_t i = 0; i < done.outcome.axes.size(); ++i)
            EXPECT_NEAR(done.outcome.axes[i].real_end, program.end[i], 0.51 / config.axes[i].pulses_per_unit()) << i;
        ++driven;
        if (testing::Test::HasFailure() && count < 100) break;
    }
    return driven;
}

class JourneyAtRandom : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(With, JourneyAtRandom, testing::Values("trapezoid", "jerk_limited"), [](const auto& info) { return std::string(info.param); });

TEST_P(JourneyAtRandom, BigMovesEndExactlyStayOnTheirPathAndKeepTheLimits) { EXPECT_GT(drive_random(GetParam(), test::ProgramSize::big), 10); }

TEST_P(JourneyAtRandom, SmallMovesEndExactlyStayOnTheirPathAndKeepTheLimits) { EXPECT_GT(drive_random(GetParam(), test::ProgramSize::small), 10); }

TEST_P(JourneyAtRandom, BigAndSmallMovesMixedEndExactlyStayOnTheirPathAndKeepTheLimits) {
    EXPECT_GT(drive_random(GetParam(), test::ProgramSize::mixed), 10);
}

TEST_P(JourneyAtRandom, TinyMovesEndExactlyStayOnTheirPathAndKeepSpeedAndAcceleration) {
    EXPECT_GT(drive_random(GetParam(), test::ProgramSize::tiny), 10);
}

}  // namespace
}  // namespace motionrack::rack
