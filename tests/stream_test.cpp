// A program that arrives line by line, with holds, overrides and resumes at random instants: it reaches the same end,
// on its path, within all limits. MOTIONRACK_SEED=N selects the first program, MOTIONRACK_PROGRAMS=N their number.
#include <cstdlib>
#include <motionrack/control/program_feed.hpp>
#include <motionrack/control/stream_executor.hpp>
#include <random>
#include <vector>

#include "journey.hpp"
#include "random_program.hpp"

namespace motionrack::rack {
namespace {

using control::ExecutionState;
using control::StreamExecutor;

/// A rack whose axes a StreamExecutor drives, with a monitor.
struct Watched {
    Rack rack;
    Monitor monitor;
    control::AxisGroup* axes = nullptr;
    std::unique_ptr<StreamExecutor> stream;
    std::vector<control::Geometry> programmed;
    double tolerance = 0;  ///< mm, tolerance of blended corners or merged short moves
    std::function<void()> on_slice;

    explicit Watched(const RackConfig& config)
        : rack(config), monitor(rack.kernel(), watched_axes(rack), milliseconds(1), 1'000'000) {
        rack.start();
        axes = *rack.path_axes();
        control::StreamExecutorSettings settings;
        settings.gcode = reader_settings(config);
        settings.jerk_limited = config.jerk_limited();
        settings.accel_reserve = rack.axes().front().card->accel_reserve();
        stream = std::make_unique<StreamExecutor>(*axes, host(), settings);
        stream->on_move([this](const control::Move& move, const control::Point& start) {
            if (move.kind == control::MoveKind::dwell) return;
            programmed.push_back(control::geometry_of(move, start));
            if (move.path == control::PathControl::continuous)
                tolerance = std::max(tolerance, (rack.config().jerk_limited() ? 1 : 0.25) * move.tolerance_mm);
        });
        rack.set_stop_flag(stream->stop_flag());
        rack.on_slice(milliseconds(1), [this] {
            monitor.drain();
            if (on_slice) on_slice();
        });
        monitor.begin();
    }
    Interrupt& host() { return rack.cards().front()->host(); }
    double seconds() const { return to_seconds(rack.kernel().now()); }

    double max_deviation() const {
        double worst = 0;
        for (const MonitorSample& sample : monitor.samples()) {
            double nearest = 1e9;
            for (const control::Geometry& path : programmed)
                nearest = std::min(
                    nearest, control::distance_to(path, sample.position[0], sample.position[1], sample.position[2]));
            worst = std::max(worst, nearest);
        }
        return worst;
    }
    void expect_limits(double jump = 1.15) {
        monitor.finish();
        for (RunningAxis& axis : rack.axes()) {
            const int i = axis.config.index();
            const control::AxisLimits limits = rack.config().limits()[static_cast<std::size_t>(i)];
            const AxisStatistics& top = monitor.statistics(i);
            // An auxiliary segment starts with the velocity of the previous one, in which an axis may have a little
            // more.
            EXPECT_LE(top.peak_velocity, limits.max_velocity * 1.005) << i;
            EXPECT_LE(top.peak_accel, limits.max_accel * 1.02) << i;
            EXPECT_LE(top.peak_velocity_step, limits.max_velocity_step * jump) << i;
            EXPECT_EQ(axis.turned_by().count(rack.kernel().now()), axis.machine->rotor().count(rack.kernel().now()))
                << i;
        }
    }
};

class StreamExecutorTest : public testing::TestWithParam<const char*> {};
class StreamExecutorDisturbedAtRandom : public StreamExecutorTest {};

const auto profiles = testing::Values("trapezoid", "jerk_limited");
std::string name_of(const testing::TestParamInfo<const char*>& info) {
    return info.param;
}
INSTANTIATE_TEST_SUITE_P(With, StreamExecutorTest, profiles, name_of);
INSTANTIATE_TEST_SUITE_P(With, StreamExecutorDisturbedAtRandom, profiles, name_of);

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
        out.push_back(text.substr(begin, end - begin));
    return out;
}

/// Feeds a program line by line until all of it is executed.
void drive_all(Watched& w, const std::string& program, const std::function<void()>& between = {}) {
    const std::vector<std::string> lines = lines_of(program);
    std::size_t next = 0;
    while (next < lines.size() || w.stream->has_work()) {
        while (next < lines.size() && w.stream->has_room()) {
            const auto read = w.stream->line(lines[next], static_cast<std::int32_t>(next + 1));
            ASSERT_TRUE(read) << read.error().text();
            ++next;
        }
        const Result<ExecutionState> state = w.stream->drive(next < lines.size());
        ASSERT_TRUE(state) << state.error().text();
        if (*state == ExecutionState::waiting || *state == ExecutionState::feed_hold ||
            *state == ExecutionState::paused)
            w.host().pass(milliseconds(1));
        if (between) between();
    }
}

TEST_P(StreamExecutorTest, ExecutesAProgramAsAJobDoes) {
    const test::RandomProgram program = test::ProgramMaker(7, test::ProgramSize::big).make();
    Watched w(router(GetParam()));
    drive_all(w, program.text);
    w.expect_limits();
    const Done job = drive(router(GetParam()), program.text);
    EXPECT_NEAR(w.seconds(), to_seconds(job.outcome.time), 0.03 * w.seconds());
    for (std::size_t i = 0; i < w.rack.axes().size(); ++i)
        EXPECT_EQ(w.rack.axes()[i].card->pulse_counter(w.rack.axes()[i].channel), job.outcome.axes[i].pulse_position);
    EXPECT_LE(w.max_deviation(), w.tolerance + 3.0 / 640 + 0.0021);
}

void disturb(const std::string& profile, std::uint64_t seed, test::ProgramSize size) {
    const test::RandomProgram program = test::ProgramMaker(seed, size).make();
    const RackConfig config = router(profile);
    if (!control::gcode::check_program(program.text, reader_settings(config), 1).problems.empty()) return;
    SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed) + "\n" + program.text);
    Watched w(config);
    std::mt19937_64 random(seed);
    const auto chance = [&](int n) { return random() % static_cast<unsigned>(n) == 0; };
    int holds = 0;
    w.on_slice = [&] {
        if (chance(150))
            w.stream->set_overrides(static_cast<double>(1 + random() % 200) / 100,
                                    static_cast<double>(25 + random() % 76) / 100);
        if (chance(200) && holds < 40) w.stream->hold(), ++holds;
        if ((w.stream->state() == ExecutionState::feed_hold || w.stream->state() == ExecutionState::paused) &&
            chance(20))
            w.stream->resume();
    };
    drive_all(w, program.text);
    w.expect_limits(size == test::ProgramSize::tiny ? 1000 : program.chords ? 1.6 : 1.15);
    EXPECT_LE(w.max_deviation(), w.tolerance + 3.5 / 640 + (program.chords ? 0.0021 : 0));
    for (std::size_t i = 0; i < program.end.size(); ++i) {
        const RunningAxis& axis = w.rack.axes()[i];
        EXPECT_NEAR(axis.machine->position(w.rack.kernel().now()), program.end[i], 0.51 / axis.config.pulses_per_unit())
            << i;
    }
}

void disturb_many(const std::string& profile, test::ProgramSize size) {
    const std::uint64_t first = seed_from_environment(), count = cases("MOTIONRACK_PROGRAMS", thorough() ? 10 : 5);
    for (std::uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed)
        disturb(profile, seed, size);
}

TEST_P(StreamExecutorDisturbedAtRandom, EndsExactlyOnItsPathWithinTheLimitsInBigMoves) {
    disturb_many(GetParam(), test::ProgramSize::big);
}
TEST_P(StreamExecutorDisturbedAtRandom, EndsExactlyOnItsPathWithinTheLimitsInSmallMoves) {
    disturb_many(GetParam(), test::ProgramSize::small);
}
TEST_P(StreamExecutorDisturbedAtRandom, EndsExactlyOnItsPathWithinTheLimitsInBigAndSmallMoves) {
    disturb_many(GetParam(), test::ProgramSize::mixed);
}
TEST_P(StreamExecutorDisturbedAtRandom, EndsExactlyOnItsPathInTinyMoves) {
    disturb_many(GetParam(), test::ProgramSize::tiny);
}

TEST_P(StreamExecutorTest, StopsOnItsPathOnFeedHoldAndResumesFromThere) {
    Watched w(router(GetParam()));
    bool asked = false;
    double held_at = -1;
    w.on_slice = [&] {
        if (!asked && w.rack.axes()[0].machine->position(w.rack.kernel().now()) > 30) w.stream->hold(), asked = true;
        if (w.stream->state() == ExecutionState::feed_hold) {
            const double x = w.rack.axes()[0].machine->position(w.rack.kernel().now());
            if (held_at < 0) held_at = x;
            EXPECT_DOUBLE_EQ(x, held_at);
        }
    };
    int waits = 0;
    drive_all(w, "G21 G90\nG1 X100 F3000\nG1 Y20\n", [&] {
        if (w.stream->state() == ExecutionState::feed_hold && ++waits == 100) w.stream->resume();
    });
    EXPECT_GT(held_at, 30);
    EXPECT_LT(held_at, 45);
    EXPECT_EQ(waits, 100);
    EXPECT_NEAR(w.rack.axes()[0].machine->position(w.rack.kernel().now()), 100, 1e-9);
    w.expect_limits();
}

TEST_P(StreamExecutorTest, FeedHoldOnAnArcBeforeARotaryMoveEndsTheArc) {
    const std::string program = "G21 G90 G61\nG3 X2 Y2 I0 J2 F600\nG1 A20 F3000\nG1 X0 F600\n";
    for (double at = 0.02; at < 0.5; at += 0.02) {
        SCOPED_TRACE(at);
        Watched w(router(GetParam()));
        bool asked = false;
        w.on_slice = [&] {
            if (!asked && w.seconds() > at) w.stream->hold(), asked = true;
            if (w.stream->state() == ExecutionState::feed_hold) w.stream->resume();
        };
        drive_all(w, program);
        w.expect_limits();
        EXPECT_LE(w.max_deviation(), w.tolerance + 2.5 / 640);
        EXPECT_NEAR(w.rack.axes()[3].machine->position(w.rack.kernel().now()), 20, 0.01);
    }
}

/// The second program dwells half a pulse beside its place, which lies on the path behind the dwell.
TEST_P(StreamExecutorTest, ResumesADwellForItsRemainingTime) {
    for (const char* program : {"G21 G90 F3000\nG1 X5\nG4 P2\nG1 X10\n", "G21 G90 F3000\nG1 X5.0007\nG4 P2\nG1 X0\n"}) {
        SCOPED_TRACE(program);
        Watched undisturbed(router(GetParam())), held(router(GetParam()));
        drive_all(undisturbed, program);
        bool asked = false;
        held.on_slice = [&] {
            if (!asked && held.seconds() > 1.2) held.stream->hold(), asked = true;
        };
        int waits = 0;
        drive_all(held, program, [&] {
            if (held.stream->state() == ExecutionState::feed_hold && ++waits == 500) held.stream->resume();
        });
        EXPECT_EQ(waits, 500);
        EXPECT_NEAR(held.seconds(), undisturbed.seconds() + 0.5, 0.15);
    }
}

TEST_P(StreamExecutorTest, StoppedDiscardsTheRestAndTheNextLineBeginsAtTheStopPosition) {
    Watched w(router(GetParam()));
    bool asked = false;
    w.on_slice = [&] {
        if (!asked && w.seconds() > 1) w.stream->stop(), asked = true;
    };
    drive_all(w, "G21 G90\nG1 X100 F3000\nG1 Y20\n");
    const double x = w.rack.axes()[0].machine->position(w.rack.kernel().now());
    EXPECT_GT(x, 40);
    EXPECT_LT(x, 60);
    drive_all(w, "G91 G1 X1 F3000\n");
    EXPECT_NEAR(w.rack.axes()[0].machine->position(w.rack.kernel().now()), x + 1, 0.51 / 640);
    EXPECT_DOUBLE_EQ(w.rack.axes()[1].machine->position(w.rack.kernel().now()), 0);
    w.expect_limits();
}

TEST_P(StreamExecutorTest, AppliesAnOverrideWithinAboutATenthOfASecond) {
    Watched w(router(GetParam()));
    double asked_at = -1, slow_at = -1;
    w.on_slice = [&] {
        if (asked_at < 0 && w.seconds() > 2) w.stream->set_overrides(0.5, 1), asked_at = w.seconds();
        if (asked_at > 0 && slow_at < 0 && w.rack.axes()[0].machine->velocity() < 5.2) slow_at = w.seconds();
    };
    drive_all(w, "G21 G90\nG1 X100 F600\n");
    EXPECT_LT(slow_at - asked_at, 0.45);
    EXPECT_NEAR(w.seconds(), 2 + 80 / 5.0, 1.0);
}

/// Executes a program in the complete language; returns its duration, s.
double seconds_of(Watched& w, const std::string& program) {
    control::gcode::ProgramFlow program_flow(program, w.stream->fresh_settings(), "part.ngc");
    const double begun = w.seconds();
    for (bool more = true; more || w.stream->has_work();) {
        for (std::string_view line; more && w.stream->has_room() && (more = program_flow.next(line));) {
            const auto read = w.stream->line(line, program_flow.number(), program_flow);
            EXPECT_TRUE(read) << read.error().text();
        }
        const Result<ExecutionState> state = w.stream->drive(more);
        if (!state) ADD_FAILURE() << state.error().text();
        if (*state == ExecutionState::waiting) w.host().pass(milliseconds(1));
    }
    return w.seconds() - begun;
}

TEST_P(StreamExecutorTest, IgnoresOverridesAfterM49) {
    const auto seconds = [](const std::string& program, double feed, double rapid) {
        Watched w(router(GetParam()));
        w.stream->set_overrides(feed, rapid);
        const double took = seconds_of(w, program);
        w.expect_limits();
        return took;
    };
    const std::string cut = "G1 X20 F600\nG0 X60\nG3 X70 Y10 J10 I0\n", after = "G1 X75 F600\n";
    const double alone = seconds(cut, 1, 1), all = seconds(cut + after, 1, 1);
    EXPECT_GT(seconds(cut, 0.25, 0.1), 3 * alone);
    EXPECT_NEAR(seconds("M49\n" + cut, 0.25, 0.1), alone, 0.05);
    EXPECT_NEAR(seconds("M50 P0\n" + cut, 2, 0.5), alone, 0.05);
    EXPECT_NEAR(seconds("M49\n" + cut + "M48\n" + after, 0.25, 0.1), alone + 4 * (all - alone), 0.3);
    EXPECT_NEAR(seconds("M49\n" + cut + "M2\nG1 X0\n", 0.25, 0.1), alone, 0.05);
}

TEST(ProgramFeed, EndsAProgramWhoseDrillingCyclesHaveNoEnd) {
    Watched w(router());
    control::gcode::Settings settings = w.stream->fresh_settings();
    settings.max_steps = 100;
    const std::string drills = "G21 G90 F600 G99\no1 repeat [1000]\nG81 X1 Z1 R2 L200\no1 endrepeat\nM2\n";
    control::ProgramFeed feed(*w.stream, drills, settings, "part.ngc");
    const auto fed = feed.feed();
    ASSERT_FALSE(fed);
    EXPECT_NE(fed.error().message.find("most of them of drilling cycles"), std::string::npos) << fed.error().text();
    EXPECT_EQ(fed.error().location.line, 4);
    EXPECT_FALSE(feed.more());
}

TEST_P(StreamExecutorTest, StandsStillForOutputsAtOnceAndContinuesThroughThoseOfAMove) {
    const auto run = [](const std::string& between) {
        Watched w(router(GetParam()));
        std::vector<double> at;
        w.stream->on_event([&](const control::gcode::CanonCall& step, std::int64_t) {
            if (step.kind == control::gcode::CanonCallKind::output)
                at.push_back(w.rack.axes()[0].machine->position(w.rack.kernel().now()));
        });
        double min_velocity = 1e9;
        w.on_slice = [&] {
            const double x = w.rack.axes()[0].machine->position(w.rack.kernel().now());
            if (x > 8 && x < 12) min_velocity = std::min(min_velocity, w.rack.axes()[0].machine->velocity());
        };
        seconds_of(w, "G21 G90 F1200\nG1 X10\n" + between + "\nG1 X20\nM2\n");
        EXPECT_EQ(at.size(), 1u);
        return std::pair(min_velocity, at.at(0));
    };
    const auto [at_once, at_once_place] = run("M64 P1");
    EXPECT_LT(at_once, 5);
    EXPECT_NEAR(at_once_place, 10, 0.8);
    const auto [with_move, with_move_place] = run("M62 P1");
    EXPECT_GT(with_move, 15);
    // With limited jerk the two lines are one segment of the path, and the event is reported behind it.
    if (std::string_view(GetParam()) == "jerk_limited")
        EXPECT_NEAR(with_move_place, 20, 0.8);
    else
        EXPECT_NEAR(with_move_place, 10, 0.8);
}

TEST_P(StreamExecutorTest, PausesAtM0UntilAResume) {
    Watched w(router(GetParam()));
    std::vector<control::gcode::CanonCallKind> seen;
    w.stream->on_event([&](const control::gcode::CanonCall& step, std::int64_t) { seen.push_back(step.kind); });
    int waits = 0;
    drive_all(w, "G21 G90 F3000\nG1 X10 M3 S1000\nM0\nG1 X20\nM2\n", [&] {
        if (w.stream->state() != ExecutionState::paused) return;
        EXPECT_NEAR(w.rack.axes()[0].machine->position(w.rack.kernel().now()), 10, 1e-9);
        if (++waits == 50) w.stream->resume();
    });
    EXPECT_EQ(waits, 50);
    EXPECT_EQ(seen.back(), control::gcode::CanonCallKind::end);
    EXPECT_NEAR(w.rack.axes()[0].machine->position(w.rack.kernel().now()), 20, 1e-9);
}

TEST_P(StreamExecutorTest, InSingleBlockPausesAfterEachLine) {
    Watched w(router(GetParam()));
    w.stream->set_single_block(true);
    std::vector<double> stood;
    drive_all(w, "G21 G90 F3000\nG1 X10\nG1 X20\nG1 X30\n", [&] {
        if (w.stream->state() != ExecutionState::paused) return;
        stood.push_back(w.rack.axes()[0].machine->position(w.rack.kernel().now()));
        w.stream->resume();
    });
    EXPECT_EQ(stood, (std::vector<double>{10, 20}));
    EXPECT_NEAR(w.rack.axes()[0].machine->position(w.rack.kernel().now()), 30, 1e-9);
}

TEST_P(StreamExecutorTest, WithASlowSenderStopsBetweenLinesAndLosesNothing) {
    Watched w(router(GetParam()));
    const std::vector<std::string> lines = lines_of("G21 G90 G64 P0.05 F3000\nG1 X10\nG1 X20 Y3\nG1 X30 Y0\n");
    for (std::size_t i = 0; i < lines.size(); ++i) {
        ASSERT_TRUE(w.stream->line(lines[i], static_cast<int>(i) + 1));
        for (int k = 0; k < 1000; ++k) {
            const Result<ExecutionState> state = w.stream->drive(k < 20);
            ASSERT_TRUE(state);
            if (*state == ExecutionState::idle || *state == ExecutionState::waiting) w.host().pass(milliseconds(1));
        }
        EXPECT_EQ(w.stream->state(), ExecutionState::idle);
    }
    EXPECT_NEAR(w.rack.axes()[0].machine->position(w.rack.kernel().now()), 30, 1e-9);
    w.expect_limits();
}

}  // namespace
}  // namespace motionrack::rack
