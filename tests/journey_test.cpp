// The first journey, whole: G-code in, pulses on the card, the machine where it should be.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <random>

namespace motionrack::rack {
namespace {

RackConfig router() { return *read_rack_text(*rack_template("router")).config; }

control::gcode::Settings reader_of(const RackConfig& config) {
    control::gcode::Settings settings;
    settings.limits = config.limits();
    for (const RackAxis& axis : config.axes) settings.start[static_cast<std::size_t>(axis.index())] = axis.start_position;
    return settings;
}

struct Done {
    JobOutcome outcome;
    std::uint64_t state_hash = 0;
};

Done drive(const RackConfig& config, const std::string& program, const std::atomic<bool>* stop = nullptr) {
    Rack rack(config);
    JobSettings settings;
    settings.program = program;
    settings.program_name = "test";
    settings.stop = stop;
    Job job(rack, settings);
    rack.start();
    Done done;
    done.outcome = job.run();
    done.state_hash = rack.kernel().state_hash();
    return done;
}

/// `jumps`: false where pieces are so short that a pulse more or less in one is itself a jump of its mean rate.
void expect_exact(const JobOutcome& outcome, bool jumps = true) {
    ASSERT_TRUE(outcome.ended) << outcome.ended.error().text();
    EXPECT_TRUE(outcome.position_trusted);
    for (const AxisOutcome& axis : outcome.axes) {
        EXPECT_EQ(axis.pulses_net, axis.pulse_position - axis.pulse_start) << axis.index;
        EXPECT_EQ(axis.counts_read, axis.counts_expected) << axis.index;
        EXPECT_EQ(axis.lost_pulses, 0) << axis.index;
        EXPECT_LE(axis.top.top_speed, axis.limits.max_speed * 1.001) << axis.index;
        // What four samples can tell: one speed step of the chip more or less.
        EXPECT_LE(axis.top.top_accel, axis.limits.max_accel * 1.02) << axis.index;
        if (jumps) EXPECT_LE(axis.top.top_jump, axis.limits.start_speed * 1.15) << axis.index;
    }
}

std::uint64_t seed() {
    const char* text = std::getenv("MOTIONRACK_SEED");
    const std::uint64_t value = text ? std::strtoull(text, nullptr, 0) : 1;
    std::cout << "MOTIONRACK_SEED=" << value << std::endl;
    return value;
}

/// Lines and arcs anywhere on the table; arcs by radius, always possible.
std::string random_program(std::mt19937_64& random, bool exact_path) {
    auto number = [&](double low, double high) { return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53; };
    std::string program = exact_path ? "G21 G90 G61\n" : "G21 G90 G64 P0.05\n";
    program += "G0 X150 Y100 Z40\n";
    double x = 150, y = 100;
    char line[128];
    for (int i = 0; i < 30; ++i) {
        const int kind = static_cast<int>(random() % 4);
        const double nx = std::round(number(60, 240) * 1000) / 1000, ny = std::round(number(50, 150) * 1000) / 1000;
        const double feed = std::round(number(300, 5000));
        if (kind == 0) {
            std::snprintf(line, sizeof line, "G0 X%.3f Y%.3f\n", nx, ny);
        } else if (kind == 1) {
            std::snprintf(line, sizeof line, "G1 X%.3f Y%.3f F%.0f\n", nx, ny, feed);
        } else if (kind == 2) {
            std::snprintf(line, sizeof line, "G1 X%.3f Y%.3f Z%.3f F%.0f\n", nx, ny, std::round(number(10, 70) * 100) / 100, feed);
        } else {
            const double half = std::sqrt((nx - x) * (nx - x) + (ny - y) * (ny - y)) / 2;
            if (half < 1) continue;
            std::snprintf(line, sizeof line, "G%d X%.3f Y%.3f R%.3f F%.0f\n", random() % 2 ? 2 : 3, nx, ny, half * number(1.2, 2.0) + 0.01, feed);
        }
        program += line;
        x = nx, y = ny;
    }
    return program + "M2\n";
}

TEST(Journey, RandomProgramsEndExactlyAndStayOnTheirPath) {
    std::mt19937_64 random(seed());
    const RackConfig config = router();
    int driven = 0;
    for (int i = 0; i < 60; ++i) {
        const bool exact_path = i % 2 == 0;
        const std::string program = random_program(random, exact_path);
        if (!control::gcode::check_program(program, reader_of(config), 1).problems.empty()) continue;  // an arc beyond the travel
        const Done done = drive(config, program);
        SCOPED_TRACE(program);
        expect_exact(done.outcome);
        // On the path but for the rounding to pulses, the chip's half pulse and the whole centre of an arc; the tolerance is 0.05 mm.
        EXPECT_LE(done.outcome.worst.mm, 3.0 / 640) << done.outcome.worst.line;
        ++driven;
        if (HasFailure()) return;
    }
    EXPECT_GT(driven, 15);
}

TEST(Journey, FourAxesTogetherEndExactly) {
    const Done done = drive(router(), "G21 G90 F1500\nG0 X100 Y100 Z40\nG1 X120 Y110 Z30 A90\nG1 X100 Y100 Z40 A-45\nG2 X100 Y100 Z35 I10 J0 A180 P2\nM2\n");
    expect_exact(done.outcome, false);
    EXPECT_DOUBLE_EQ(done.outcome.axes[3].real_end, 180.0);
    EXPECT_LE(done.outcome.worst.mm, 0.01);
}

TEST(Journey, ASteeredAxisThatIsThenInterpolatedEndsExactly) {
    const Done done = drive(router(), "G21 G90\nG1 X4 Y3 Z75 A20 F600\nG1 X0 A0\nM2\n");
    expect_exact(done.outcome, false);
    EXPECT_DOUBLE_EQ(done.outcome.axes[3].real_end, 0.0);
}

TEST(Journey, ASteeredAxisThatTurnsRoundEndsExactly) {
    const Done done = drive(router(),
                            "G21 G90\nG0 X150 Y100 Z40\nG2 X149.169 Y101.298 Z50.522 A-5.12 R1.281 F2032\nG1 X75.358 Y82.564 A-89.69 F2698\n"
                            "G3 X233.471 Y146.362 Z24.944 A86.80 R254.569 F111\nG1 X233.123 Y144.372 Z51.462 A67.19 F485\nM2\n");
    expect_exact(done.outcome, false);
    EXPECT_NEAR(done.outcome.axes[3].real_end, 67.19, 1e-9);
}

TEST(Journey, AHelixBeforeACornerSlowsDownForIt) {
    const Done done = drive(router(), "G21 G90 G64 P0.005\nG0 X150 Y100 Z40\nG2 X120 Y110 Z30 R40 F4000\nG1 X150 Y100 F4000\nG3 X140 Y90 Z35 R20\nG1 X160\nM2\n");
    expect_exact(done.outcome, false);
    EXPECT_LE(done.outcome.worst.mm, 0.007);
}

TEST(Journey, TheSameProgramGivesTheSameHistory) {
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
    expect_exact(done.outcome, false);
    EXPECT_LE(done.outcome.worst.mm, 0.01);
    EXPECT_GT(done.outcome.path_mm / to_seconds(done.outcome.time), 40.0) << "mm/s of 50";
}

TEST(Journey, ALimitSwitchStopsTheJobAndSaysWhere) {
    RackConfig config = router();
    config.axes[0].switches.limit_plus = 40;
    const Done done = drive(config, "G21 G90\nG1 X100 F3000\nG1 X0\n");
    ASSERT_FALSE(done.outcome.ended);
    EXPECT_EQ(done.outcome.ended.error().trouble, Trouble::machine);
    EXPECT_EQ(done.outcome.ended.error().place.line, 2);
    EXPECT_NE(done.outcome.ended.error().message.find("axis X: the + limit switch"), std::string::npos);
    EXPECT_GT(done.outcome.axes[0].real_end, 40.0);
    EXPECT_LT(done.outcome.axes[0].real_end, 43.0);
    EXPECT_EQ(done.outcome.axes[0].lost_pulses, 0);
}

TEST(Journey, AWeakMotorLosesStepsAndTheJobSaysSo) {
    RackConfig config = router();
    config.axes[0].motor.pull_out_hz = 30'000;  // 47 mm/s
    const Done done = drive(config, "G21 G90\nG0 X200\nM2\n");
    EXPECT_FALSE(done.outcome.position_trusted);
    EXPECT_NE(done.outcome.axes[0].lost_pulses, 0);
    EXPECT_EQ(done.outcome.axes[0].lost_pulses % 64, 0) << "whole electrical cycles";
    ASSERT_FALSE(done.outcome.warnings.empty());
    EXPECT_NE(done.outcome.warnings.front().text.find("out of step"), std::string::npos);
    EXPECT_EQ(done.outcome.axes[0].pulse_position, 128'000) << "the card believes it is there";
}

TEST(Journey, AStopComesToRestOnThePath) {
    const std::atomic<bool> stop{true};
    const Done done = drive(router(), "G21 G90\nG1 X100 Y50 F3000\nM2\n", &stop);
    ASSERT_FALSE(done.outcome.ended);
    EXPECT_EQ(done.outcome.ended.error().trouble, Trouble::stopped);
    EXPECT_TRUE(done.outcome.position_trusted);
}

TEST(Journey, WhatCameFromOutsideReplaysToTheSameHistory) {
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
    sim::replay(replayed.kernel(), recorded.input_log().inputs(), recorded.kernel().now(), [&card](const sim::Input& input) {
        if (input.kind == sim::InputKind::register_write) card.write(input.offset, input.value);
        if (input.kind == sim::InputKind::register_read) card.read(input.offset);
    });
    EXPECT_EQ(replayed.kernel().trace_hash(), recorded.kernel().trace_hash());
    for (int channel = 0; channel < 4; ++channel)
        EXPECT_EQ(replayed.cards().front()->pulse_counter(channel), recorded.cards().front()->pulse_counter(channel));
}

}  // namespace
}  // namespace motionrack::rack
