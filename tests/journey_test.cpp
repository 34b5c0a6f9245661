// The whole first journey: from G-code to pulses on the card and the correct position of the machine.
#include "journey.hpp"

#include <gtest/gtest.h>

#include <motionrack/rack/recorder.hpp>

namespace motionrack::rack {
namespace {

TEST(Journey, FourAxesTogetherEndExactly) {
    const Done done = drive(router(),
                            "G21 G90 F1500\nG0 X100 Y100 Z40\nG1 X120 Y110 Z30 A90\nG1 X100 Y100 Z40 A-45\nG2 X100 "
                            "Y100 Z35 I10 J0 A180 P2\nM2\n");
    expect_exact(done.outcome, 0);
    EXPECT_DOUBLE_EQ(done.outcome.axes[3].actual_end, 180.0);
    EXPECT_LE(done.outcome.max_deviation.mm, 0.01);
}

TEST(Journey, AnAuxiliaryAxisThatIsThenInterpolatedEndsExactly) {
    const Done done = drive(router(), "G21 G90\nG1 X4 Y3 Z75 A20 F600\nG1 X0 A0\nM2\n");
    expect_exact(done.outcome, 0);
    EXPECT_DOUBLE_EQ(done.outcome.axes[3].actual_end, 0.0);
}

TEST(Journey, AnAuxiliaryAxisThatReversesEndsExactly) {
    const Done done =
        drive(router(),
              "G21 G90\nG0 X150 Y100 Z40\nG2 X149.169 Y101.298 Z50.522 A-5.12 R1.281 F2032\nG1 X75.358 Y82.564 A-89.69 "
              "F2698\n"
              "G3 X233.471 Y146.362 Z24.944 A86.80 R254.569 F111\nG1 X233.123 Y144.372 Z51.462 A67.19 F485\nM2\n");
    expect_exact(done.outcome, 0);
    EXPECT_NEAR(done.outcome.axes[3].actual_end, 67.19, 1e-9);
}

TEST(Journey, AHelixBeforeACornerDeceleratesForIt) {
    const Done done = drive(router(),
                            "G21 G90 G64 P0.005\nG0 X150 Y100 Z40\nG2 X120 Y110 Z30 R40 F4000\nG1 X150 Y100 F4000\nG3 "
                            "X140 Y90 Z35 R20\nG1 X160\nM2\n");
    expect_exact(done.outcome, 0);
    EXPECT_LE(done.outcome.max_deviation.mm, 0.007);
}

TEST(Journey, TheSameProgramGivesTheSameEventTrace) {
    const std::string program = "G21 G90 F2400\nG1 X20 Y10\nG3 X30 Y20 I0 J10\nG1 X0 Y0 Z70\nM2\n";
    const Done first = drive(router(), program), second = drive(router(), program);
    EXPECT_EQ(first.outcome.trace_hash, second.outcome.trace_hash);
    EXPECT_EQ(first.outcome.time, second.outcome.time);
    EXPECT_EQ(first.state_hash, second.state_hash);
}

TEST(Journey, ManyShortLinesRunAtFullFeed) {
    std::string program = "G21 G90 G64 P0.01 F3000\n";
    char line[64];
    for (int i = 1; i <= 5000; ++i) {
        std::snprintf(line, sizeof line, "G1 X%.3f Y%.3f\n", 0.05 * i, 100 - 0.00004 * (i - 2500) * (i - 2500) / 2.5);
        program += line;
    }
    const Done done = drive(router(), program);
    expect_exact(done.outcome, 0);
    EXPECT_LE(done.outcome.max_deviation.mm, 0.01);
    EXPECT_GT(done.outcome.path_mm / to_seconds(done.outcome.time), 40.0) << "mm/s of 50";
}

TEST(Journey, ALimitSwitchStopsTheJobAndReportsWhere) {
    RackConfig config = router();
    config.axes[0].switches.limit_plus = 40;
    const Done done = drive(config, "G21 G90\nG1 X100 F3000\nG1 X0\n");
    ASSERT_FALSE(done.outcome.ended);
    EXPECT_EQ(done.outcome.ended.error().kind, ErrorKind::machine);
    EXPECT_EQ(done.outcome.ended.error().location.line, 2);
    EXPECT_NE(done.outcome.ended.error().message.find("axis X: the + limit switch"), std::string::npos);
    EXPECT_GT(done.outcome.axes[0].actual_end, 40.0);
    EXPECT_LT(done.outcome.axes[0].actual_end, 43.0);
    EXPECT_EQ(done.outcome.axes[0].lost_pulses, 0);
}

TEST(Journey, AWeakMotorLosesStepsAndTheJobReportsIt) {
    RackConfig config = router();
    config.axes[0].motor.pull_out_hz = 30'000;  // 47 mm/s
    config.axes[0].following_error_alarm = 0;
    const Done done = drive(config, "G21 G90\nG0 X200\nM2\n");
    EXPECT_FALSE(done.outcome.position_valid);
    EXPECT_NE(done.outcome.axes[0].lost_pulses, 0);
    EXPECT_EQ(done.outcome.axes[0].lost_pulses % 64, 0) << "whole electrical cycles";
    ASSERT_FALSE(done.outcome.warnings.empty());
    EXPECT_NE(done.outcome.warnings.front().text.find("out of step"), std::string::npos);
    EXPECT_EQ(done.outcome.axes[0].pulse_position, 128'000) << "the card believes it is there";
}

TEST(Journey, AStopDeceleratesToAStopOnThePath) {
    const std::atomic<bool> stop{true};
    const Done done = drive(router(), "G21 G90\nG1 X100 Y50 F3000\nM2\n", &stop);
    ASSERT_FALSE(done.outcome.ended);
    EXPECT_EQ(done.outcome.ended.error().kind, ErrorKind::stopped);
    EXPECT_TRUE(done.outcome.position_valid);
}

TEST(Journey, AReplayOfTheInputsGivesTheSameEventTrace) {
    const std::string program = "G21 G90 F2400\nG1 X5 Y3\nG2 X9 Y7 I4 J0\nM2\n";
    Rack recorded(router());
    JobSettings settings;
    settings.program = program;
    Job job(recorded, settings);
    recorded.start();
    ASSERT_TRUE(job.run().ended);

    Rack replayed(router());
    JobSettings same = settings;
    Job watcher(replayed, same);  // the same devices in the same order
    replayed.start();
    sim::RegisterDevice& card = *replayed.cards().front()->registers();
    sim::replay(replayed.kernel(), recorded.input_log().inputs(), recorded.kernel().now(),
                [&card](const sim::LoggedInput& input) {
                    if (input.kind == sim::InputKind::register_write) card.write(input.offset, input.value);
                    if (input.kind == sim::InputKind::register_read) card.read(input.offset);
                });
    EXPECT_EQ(replayed.kernel().trace_hash(), recorded.kernel().trace_hash());
    for (int channel = 0; channel < 4; ++channel)
        EXPECT_EQ(replayed.cards().front()->motion()->pulse_counter(channel),
                  recorded.cards().front()->motion()->pulse_counter(channel));
}

}  // namespace
}  // namespace motionrack::rack
