// A job that must stop: in every state, from every source, and nothing moves after it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/recorded_job.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <motionrack/rack/test/servo_helpers.hpp>
#include <tests/invariants/watch.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;

const char* const stop_axes =
    "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = 10\n"
    "[axis.X.switches]\nlimit_minus_mm = -5\nlimit_plus_mm = 305\n"
    "[axis.Y]\ncard = \"m\"\nchannel = \"y\"\n[axis.Y.switches]\nlimit_minus_mm = -5\nlimit_plus_mm = 305\n";
const char* const dwelling = "G21 G90 F1200\nG1 X20\nG4 P2\nG1 X80\nM2\n";  // the dwell is from 0.52 s to 2.52 s
const char* const one_move = "G21 G90 F1200\nG1 X80\nM2\n";

struct StoppedRun {
    JobOutcome outcome;
    RackConfig config;
    double observed_s = 0;  ///< the last progress of the run
    double x() const { return outcome.axes[0].actual_end; }
    std::string error() const { return outcome.ended ? std::string() : outcome.ended.error().message; }
};

StoppedRun run_stopped(const std::string& rack, const std::string& program, const std::vector<std::string>& faults,
                       const std::vector<std::string>& orders = {}) {
    JobRequest request;
    request.config = good(rack);
    request.program = program;
    request.program_name = "part.ngc";
    request.faults = *read_faults(faults);
    request.commands = *read_commands(orders);
    auto job = RecordedJob::create(request, {});
    EXPECT_TRUE(job) << job.error().message;
    test::RackWatch watch((*job)->rack());
    StoppedRun out;
    out.config = request.config;
    out.outcome = (*job)->run(nullptr, [&](const JobProgress& progress) {
        watch.poll();
        out.observed_s = progress.seconds;
    });
    return out;
}

void expect_stopped(const StoppedRun& ran, double x, const std::string& words) {
    ASSERT_FALSE(ran.outcome.ended) << "it went on";
    EXPECT_EQ(ran.outcome.ended.error().kind, ErrorKind::machine);
    EXPECT_THAT(ran.error(), HasSubstr(words));
    EXPECT_NEAR(ran.x(), x, 0.01) << "nothing moves after a stop";
    EXPECT_THAT(summary_json(ran.config, ran.outcome), HasSubstr("\"ok\": false"));
}

TEST(LatchedStop, InADwellEndsTheProgramAlsoWhereTheButtonIsReleasedBeforeItsEnd) {
    const StoppedRun ran = run_stopped(stop_axes, dwelling, {"estop=0@1s", "estop=1@1.2s"});
    expect_stopped(ran, 20, "The emergency stop was pressed at 1.000 s");
    EXPECT_THAT(ran.error(), HasSubstr("in line 3"));
    EXPECT_TRUE(ran.outcome.position_valid) << "nothing moved, so no step can be lost";
    EXPECT_THAT(ran.error(), HasSubstr("The positions are kept."));
}

TEST(LatchedStop, InADwellIsDetectedHoweverShortlyTheButtonIsPressed) {
    expect_stopped(run_stopped(stop_axes, dwelling, {"estop=0@1s", "estop=1@1.00001s"}), 20, "emergency stop");
}

TEST(LatchedStop, InADwellOfAJerkLimitedMachineEndsTheProgram) {
    const std::string jerk = std::string(stop_axes) + "[controller]\nprofile = \"jerk_limited\"\n";
    expect_stopped(run_stopped(jerk, dwelling, {"estop=0@1.5s", "estop=1@1.7s"}), 20, "emergency stop");
    expect_stopped(run_stopped(jerk, dwelling, {"estop=0@1.5s", "estop=1@1.7s"}, {"feed=1@0.1s"}), 20,
                   "emergency stop");
}

TEST(LatchedStop, IsObservedUntilItsEffectShowsAlsoInARunThatTakesCommands) {
    const std::vector<std::string> button = {"estop=0@1s"};
    const double ended_s = to_seconds(run_stopped(stop_axes, dwelling, button, {"feed=1@0.1s"}).outcome.time);
    // The second command falls into the time in which the job still observes the motors, and divides it into slices.
    const StoppedRun ran =
        run_stopped(stop_axes, dwelling, button, {"feed=1@0.1s", fmt::format("feed=1@{:.4f}s", ended_s + 0.01)});
    expect_stopped(ran, 20, "emergency stop");
    EXPECT_EQ(to_seconds(ran.outcome.time), ended_s);
    EXPECT_GT(ran.observed_s, ended_s);
}

TEST(LatchedStop, InADwellOfAServoEndsTheProgram) {
    const StoppedRun ran =
        run_stopped(carriage(), "G21 G90\nG0 X200\nG4 P2\nG0 X300\nM2\n", {"estop=0@2s", "estop=1@2.2s"});
    ASSERT_FALSE(ran.outcome.ended);
    EXPECT_THAT(ran.error(), HasSubstr("emergency stop"));
    EXPECT_NEAR(ran.x(), 200, 1);
    EXPECT_TRUE(ran.outcome.position_valid) << "its encoder counts on";
}

TEST(LatchedStop, InAHoldEndsTheProgramAndAResumeMovesNothing) {
    const StoppedRun moved = run_stopped(stop_axes, one_move, {}, {"hold@0.5s", "stop@2s"});
    const StoppedRun ran =
        run_stopped(stop_axes, one_move, {"estop=0@1.2s", "estop=1@1.5s"}, {"hold@0.5s", "resume@2s"});
    expect_stopped(ran, moved.x(), "The emergency stop was pressed at 1.200 s");
    EXPECT_TRUE(ran.outcome.position_valid);
}

TEST(LatchedStop, BetweenHoldAndResumeOfAJerkLimitedMachineEndsTheProgram) {
    const std::string jerk = std::string(stop_axes) + "[controller]\nprofile = \"jerk_limited\"\n";
    const StoppedRun moved = run_stopped(jerk, one_move, {}, {"hold@0.5s", "stop@2s"});
    expect_stopped(run_stopped(jerk, one_move, {"estop=0@1.2s", "estop=1@1.5s"}, {"hold@0.5s", "resume@2s"}), moved.x(),
                   "emergency stop");
}

TEST(LatchedStop, OfADriveAlarmDeceleratesAllAxesOnThePath) {
    const StoppedRun ran = run_stopped(stop_axes, "G21 G90 F1200\nG1 X80 Y70\nM2\n", {"m.yalarm=0@1s"});
    ASSERT_FALSE(ran.outcome.ended);
    EXPECT_THAT(ran.error(), HasSubstr("The drive of Y reported an alarm at 1.000 s"));
    EXPECT_LT(ran.x(), 30);
    EXPECT_NEAR(ran.x() - 10, ran.outcome.axes[1].actual_end, 0.02) << "on the path";
    EXPECT_FALSE(ran.outcome.position_valid) << "a drive that gives up does not follow its pulses";
}

TEST(LatchedStop, OfADriveAlarmInADwellKeepsThePositions) {
    const StoppedRun ran = run_stopped(stop_axes, dwelling, {"m.xalarm=0@1s", "m.xalarm=1@1.1s"});
    expect_stopped(ran, 20, "The drive of X reported an alarm");
    EXPECT_TRUE(ran.outcome.position_valid);
}

TEST(LatchedStop, OfALimitSwitchAtStandstillEndsTheProgram) {
    expect_stopped(run_stopped(stop_axes, dwelling, {"Y.limit_plus=0@1s", "Y.limit_plus=1@1.1s"}), 20,
                   "The + limit switch of Y was reached at 1.000 s");
    const StoppedRun moving = run_stopped(stop_axes, one_move, {"Y.limit_plus=0@1s"});
    ASSERT_FALSE(moving.outcome.ended) << "that of an axis that stands while another one moves";
    EXPECT_LT(moving.x(), 32);
    EXPECT_TRUE(moving.outcome.position_valid);
}

TEST(LatchedStop, OfAWatchdogInADwellEndsTheProgram) {
    const StoppedRun ran =
        run_stopped(carriage(), "G21 G90\nG0 X200\nG4 P4\nG0 X300\nM2\n", {"board.watchdog.hang@2s"});
    ASSERT_FALSE(ran.outcome.ended);
    EXPECT_THAT(ran.error(), HasSubstr("The watchdog of card board restarted it"));
    EXPECT_NEAR(ran.x(), 200, 1);
    EXPECT_FALSE(ran.outcome.position_valid) << "its counter begins anew";
    EXPECT_THAT(ran.error(), HasSubstr("its card was reset and counts from 0"));
}

TEST(LatchedStop, OfTheStopCommandInADwellActsAtOnce) {
    const StoppedRun ran = run_stopped(stop_axes, dwelling, {}, {"stop@1s"});
    ASSERT_FALSE(ran.outcome.ended);
    EXPECT_EQ(ran.outcome.ended.error().kind, ErrorKind::stopped);
    EXPECT_LT(to_seconds(ran.outcome.time), 1.1);
}

TEST(LatchedStop, WithoutARampDropsThePositionOnlyOfAxesThatWereFasterThanTheyCanStop) {
    const StoppedRun fast = run_stopped(stop_axes, "G21 G90 F3000\nG1 X80\nM2\n", {"estop=0@1s"});
    EXPECT_FALSE(fast.outcome.ended);
    EXPECT_FALSE(fast.outcome.position_valid);
    const StoppedRun slow = run_stopped(stop_axes, "G21 G90 F60\nG1 X80\nM2\n", {"estop=0@1s"});
    EXPECT_FALSE(slow.outcome.ended);
    EXPECT_TRUE(slow.outcome.position_valid) << "1 mm/s is below its velocity step: it stops within a step";
}

TEST(LatchedStop, DoesNotEndAProgramIfASwitchBouncesBehindTheAxis) {
    std::string on_its_switch = stop_axes;
    on_its_switch.replace(on_its_switch.find("initial_position_mm = 10"), 24,
                          "min_limit_mm = -6\ninitial_position_mm = -5.5");
    on_its_switch.replace(on_its_switch.find("limit_minus_mm = -5"), 19, "bounce_ms = 10\nlimit_minus_mm = -5");
    const StoppedRun ran = run_stopped(on_its_switch, "G21 G90 F1200\nG1 X20\nM2\n", {});
    EXPECT_TRUE(ran.outcome.ended) << ran.error();
    EXPECT_EQ(ran.x(), 20) << "the way back stays free";
}

TEST(LatchedStop, OfALimitSwitchActiveBehindTheAxisReportsAWiringError) {
    const StoppedRun ran =
        run_stopped(stop_axes, "G21 G90 F1200\nG1 X80\nM2\n", {"X.limit_minus=0@1s", "X.limit_minus=1@1.2s"});
    ASSERT_FALSE(ran.outcome.ended);
    EXPECT_THAT(ran.error(), HasSubstr("The - limit switch of X became active while X moved in + direction"));
    EXPECT_TRUE(ran.outcome.position_valid) << "a ramp loses nothing";
    EXPECT_LT(ran.x(), 32);
}

TEST(LatchedStop, AtALimitSwitchKeepsThePositionOnlyOfAxesDeceleratedWithARamp) {
    const std::string fast = "G21 G90\nG1 X200 F6000\nM2\n";
    const StoppedRun one_piece = run_stopped(stop_axes, fast, {"X.limit_plus=0@1s"});
    ASSERT_FALSE(one_piece.outcome.ended);
    EXPECT_TRUE(one_piece.outcome.position_valid) << "the chip brakes within its piece";
    // Each segment of a jerk-limited path lasts some milliseconds; the chip stops at the end of a segment.
    const std::string jerk = std::string(stop_axes) + "[controller]\nprofile = \"jerk_limited\"\n";
    for (const char* switches : {"X.limit_plus=0@1s", "Y.limit_plus=0@1s"}) {
        const StoppedRun pieces = run_stopped(jerk, fast, {switches});
        ASSERT_FALSE(pieces.outcome.ended) << switches;
        EXPECT_FALSE(pieces.outcome.position_valid) << switches << ": it went from 100 mm/s to 0 at once";
        EXPECT_THAT(pieces.error(), HasSubstr("The position of X is not valid any more: steps may have been lost"));
    }
    const StoppedRun slow = run_stopped(jerk, "G21 G90\nG1 X200 F60\nM2\n", {"X.limit_plus=0@1s"});
    EXPECT_TRUE(slow.outcome.position_valid) << "1 mm/s is below its velocity step";
}

/// While the chip decelerates, moves queued after the line must not change the acceleration.
TEST(LatchedStop, AtALimitSwitchDeceleratesAsTheLimitsOfTheMovingAxisAllow) {
    std::string slow_y = stop_axes;
    slow_y.replace(slow_y.find("channel = \"y\""), 13,
                   "channel = \"y\"\nmax_accel_mm_s2 = 500\nmax_velocity_mm_s = 50");
    for (const char* when : {"0.2s", "0.4s", "0.6s", "0.8s"}) {
        const StoppedRun ran =
            run_stopped(slow_y, "G0 Y40\nG1 X20 Y41 F1200\nG0 X60\nM2\n", {std::string("X.limit_plus=0@") + when});
        ASSERT_FALSE(ran.outcome.ended) << when;
        EXPECT_THAT(ran.error(), HasSubstr("in line 1")) << when;
        EXPECT_LE(ran.outcome.axes[1].top.peak_accel, 500) << when;
        EXPECT_TRUE(ran.outcome.position_valid) << when;
    }
}

TEST(LatchedStop, OfABrokenWireOfACardComesFromItsInput) {
    const std::string program = "G21 G90\nG1 X2000 F12000\nM2\n";
    const StoppedRun behind = run_stopped(carriage(), program, {"board.esl.broken@2s"});
    ASSERT_FALSE(behind.outcome.ended) << "the wire of the end stop behind the axis";
    EXPECT_THAT(behind.error(), HasSubstr("The - limit switch of X became active while X moved in + direction"));
    EXPECT_LT(behind.x(), 600);
    EXPECT_TRUE(behind.outcome.position_valid);
    const StoppedRun dwells =
        run_stopped(carriage(), "G21 G90\nG0 X200\nG4 P2\nG0 X300\nM2\n", {"board.ems.broken@2s"});
    ASSERT_FALSE(dwells.outcome.ended) << "that of the emergency stop, at standstill";
    EXPECT_THAT(dwells.error(), HasSubstr("The emergency stop was pressed at 2.000 s"));
    EXPECT_NEAR(dwells.x(), 200, 1);
}

}  // namespace
}  // namespace motionrack::rack
