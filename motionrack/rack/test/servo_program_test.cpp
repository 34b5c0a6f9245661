// Programs on cards that position each axis by itself, and invalid rack files for them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/job_report.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <motionrack/rack/test/servo_helpers.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;

JobOutcome run(const std::string& rack_text, const std::string& program, RackConfig* config = nullptr) {
    const RackConfig read = good(rack_text);
    if (config != nullptr) *config = read;
    Rack rack(read);
    JobSettings settings;
    settings.program = program;
    Job job(rack, settings);
    rack.start();
    return job.run();
}

TEST(ServoProgram, RunsMoveByMoveAndLosesNoCount) {
    RackConfig config;
    const std::string text = carriage("position_window_mm = 0.25\n");
    const JobOutcome out = run(text, "G21 G90\nG0 X2560\nG4 P1\nG1 X1280 F12000\nG4 P0.5\nG1 X0 F6000\nM2\n", &config);
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    ASSERT_EQ(out.axes.size(), 1u);
    const AxisOutcome& x = out.axes[0];
    EXPECT_TRUE(x.servo);
    EXPECT_EQ(x.planned_end, 0);
    EXPECT_NEAR(x.actual_end, 0, 0.3);
    EXPECT_EQ(x.encoder_counts, std::llround((x.actual_end - 100) * 100)) << "the card's counter is the machine";
    EXPECT_NEAR(x.top.peak_velocity, 499, 2);
    EXPECT_GT(to_seconds(out.time), 2460 / 500.0 + 1 + 1280 / 200.0 + 0.5 + 1280 / 100.0);
    EXPECT_LT(to_seconds(out.time), 2460 / 500.0 + 1 + 1280 / 200.0 + 0.5 + 1280 / 100.0 + 2);
    EXPECT_THAT(summary_of(config, out), HasSubstr("servos are at most 0."));
    EXPECT_EQ(run(text, "G0 X300\n").trace_hash, run(text, "G0 X300\n").trace_hash);
}

TEST(ServoProgram, SeveralCardsEachMoveTheirOwnAxis) {
    const std::string two =
        carriage() +
        "[card.lift]\ntype = \"databoard4002\"\ncard_number = 14\n[axis.Z]\ncard = \"lift\"\nlead_mm = "
        "5\nencoder_counts_per_rev = 2000\n"
        "max_velocity_mm_s = 100\nmax_accel_mm_s2 = 400\nmax_limit_mm = "
        "500\n[axis.Z.servo]\nvelocity_per_volt_mm_s = 20\ncoulomb_friction_mm_s2 = 20\n";
    const JobOutcome out = run(two, "G90\nG0 X600 Z200\nG1 Z50 F3000\nG1 X0 F6000\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_NEAR(out.axes[0].actual_end, 0, 0.3);
    EXPECT_NEAR(out.axes[1].actual_end, 50, 0.3);
    EXPECT_NEAR(out.axes[1].top.peak_velocity, 100, 1);
    const JobOutcome both = run(two, "G90 F600\nG1 X600 Z200\n");
    ASSERT_FALSE(both.ended);
    EXPECT_EQ(both.ended.error().location.line, 2);
    EXPECT_THAT(both.ended.error().message,
                HasSubstr("G1 moves X, Z together, but the axes of this rack position one by one"));
    const JobOutcome arc = run(two, "G90 F600\nG2 X50 I10\n");
    ASSERT_FALSE(arc.ended);
    EXPECT_THAT(arc.ended.error().message, HasSubstr("G2 is an arc"));
}

TEST(ServoProgram, ASteppingMotorAtTheFrequencyOutputLosesNoSteps) {
    const JobOutcome out =
        run("[card.board]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"board\"\nmotor_steps_per_rev = 200\nmicrosteps "
            "= 5\n"
            "lead_mm = 10\nencoder_counts_per_rev = 1000\nmax_velocity_mm_s = 100\nmax_velocity_step_mm_s = "
            "5\nmax_limit_mm = 500\n",
            "G0 X300\nG1 X100 F1200\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_EQ(out.axes[0].lost_pulses, 0);
    EXPECT_NEAR(out.axes[0].actual_end, 100, 0.011);
    EXPECT_NEAR(out.axes[0].top.peak_velocity, 100, 1);
    EXPECT_TRUE(out.position_valid);
}

TEST(ServoProgram, AMixOfPathsAndPositioningIsRefused) {
    const JobOutcome out =
        run(carriage() + "[card.m]\ntype = \"mcx314\"\n[axis.Y]\ncard = \"m\"\nchannel = \"x\"\n", "G0 X1\n");
    ASSERT_FALSE(out.ended);
    EXPECT_THAT(out.ended.error().message, HasSubstr("one card"));
}

// ---- rack files

TEST(ServoRackFile, ReportsWhatIsWrong) {
    const struct {
        std::string text;
        const char* says;
    } wrong[] = {
        {carriage("coulomb_friction_mm_s2 = 6000\n"), "could never start"},
        {carriage("saturation_velocity_mm_s = 20000\n"), "it may be 1000000"},
        {carriage("", "[axis.X.motor]\nstart_stop_hz = 100\n"), "so motor has no effect"},
        {carriage("", "[axis.Y]\ncard = \"board\"\n"), "both on card board"},
        {carriage("", "[wires]\n\"X.drive\" = \"board.sign\"\n"), "X.drive is a voltage and board.sign a logic level"},
        {carriage("", "[wires]\n\"board.esr\" = \"board.vout\"\n"),
         "board.esr is a logic level and board.vout a voltage"},
        {carriage("", "[wires]\n\"X.step\" = \"board.fout\"\n"), "needs a stepping motor"},
        {"[card.b]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"b\"\nencoder_counts_per_rev = 0\n", "positions by it"},
        {"[card.b]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"b\"\n[axis.X.switches]\ncam_from_mm = 3\n",
         "a cam needs both ends"},
        {"[card.b]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"b\"\nmax_limit_mm = 20000\n", "8388607 at most"},
        {"[card.b]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"b\"\nmax_velocity_mm_s = 600\n",
         "follow 400000 counts/s"},
    };
    for (const auto& each : wrong) {
        const RackReading reading = read_rack_text(each.text);
        EXPECT_FALSE(reading.config) << each.text;
        EXPECT_THAT(all_texts(reading.errors), HasSubstr(each.says)) << each.text;
        EXPECT_EQ(reading.errors.size(), 1u) << all_texts(reading.errors);
    }
    EXPECT_THAT(all_texts(read_rack_text(carriage("time_constant_ms = 100\ncoulomb_friction_mm_s2 = 30\n")).warnings),
                HasSubstr("stop short of its target"));
    EXPECT_THAT(all_texts(read_rack_text(carriage("load_inertia_ratio = 9\n")).warnings),
                HasSubstr("overshoot its target"));
    EXPECT_THAT(all_texts(read_rack_text(carriage("velocity_per_volt_mm_s = 40\n")).warnings),
                HasSubstr("of its servo at 10 V"));
    EXPECT_TRUE(read_rack_text(*rack_template("carriage")).warnings.empty());
}

}  // namespace
}  // namespace motionrack::rack
