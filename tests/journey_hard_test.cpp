// The first journey under difficult conditions: wrong programs, stops on the way, rewinding, very many lines.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/sim/input_log.hpp>
#include <tests/journey.hpp>

namespace motionrack::rack {
namespace {

/// A rack with a job on it, started.
struct Running {
    explicit Running(const RackConfig& config, const JobSettings& settings) : rack(config), job(rack, settings) {
        rack.start();
    }
    Rack rack;
    Job job;
};

JobSettings settings_of(std::string_view program) {
    JobSettings settings;
    settings.program = program;
    settings.program_name = "test";
    return settings;
}

TEST(Journey, AWrongFirstLineMovesNothing) {
    Running running(router(), settings_of("G21 G90\nG1 X50\nG0 X10\n"));  // no feed
    const JobOutcome outcome = running.job.run();
    ASSERT_FALSE(outcome.ended);
    EXPECT_EQ(outcome.ended.error().kind, ErrorKind::invalid_input);
    EXPECT_EQ(outcome.ended.error().location, (TextPosition{2, 1}));
    for (const AxisOutcome& axis : outcome.axes) EXPECT_EQ(axis.pulses_sent, 0) << axis.index;
}

TEST(Journey, AWrongLineLaterEndsTheStreamWhereTheLineBeforeItEnds) {
    Running running(router(), settings_of("G21 G90 F1200\nG1 X12.5 Y7\nG1 X9 X8\nG1 X0\n"));
    const JobOutcome outcome = running.job.run();
    ASSERT_FALSE(outcome.ended);
    EXPECT_EQ(outcome.ended.error().kind, ErrorKind::invalid_input);
    EXPECT_EQ(outcome.ended.error().location.line, 3);
    EXPECT_TRUE(outcome.position_valid);
    EXPECT_EQ(outcome.axes[0].pulses_net, 8000);
    EXPECT_EQ(outcome.axes[1].pulses_net, 4480);
    EXPECT_NE(outcome.ended.error().text().find("X"), std::string::npos) << "the word to blame";
}

/// Requests a stop in the middle of an arc and compares the final positions with the circle.
TEST(Journey, AStopInAnArcDeceleratesToAStopOnTheArc) {
    std::atomic<bool> stop{false};
    JobSettings settings = settings_of("G21 G90 F1800\nG0 X100 Y100\nG2 X100 Y100 I30 J0 P3\nM2\n");
    settings.stop = &stop;
    double asked = 0;
    settings.progress = [&](const JobProgress& progress) {
        if (progress.line != 3 || progress.seconds < 4 || stop) return;
        stop = true;
        asked = progress.seconds;
    };
    Running running(router(), settings);
    const JobOutcome outcome = running.job.run();
    ASSERT_FALSE(outcome.ended);
    EXPECT_EQ(outcome.ended.error().kind, ErrorKind::stopped);
    EXPECT_EQ(outcome.ended.error().location.line, 3);
    ASSERT_GT(asked, 0) << "the stop was asked for on the way";
    // From 30 mm/s at 1000 mm/s2 in less than 0.1 s.
    EXPECT_LT(to_seconds(outcome.time), asked + 0.2);
    const double x = outcome.axes[0].actual_end - 130, y = outcome.axes[1].actual_end - 100;
    EXPECT_NEAR(std::sqrt(x * x + y * y), 30, 3.0 / 640);
    EXPECT_TRUE(outcome.position_valid);
    for (const AxisOutcome& axis : outcome.axes) {
        EXPECT_EQ(axis.lost_pulses, 0) << axis.index;
        EXPECT_EQ(axis.pulses_net, axis.pulse_position - axis.pulse_start) << axis.index;
        EXPECT_EQ(axis.encoder_counts, axis.expected_counts) << axis.index;
    }
    EXPECT_LE(outcome.max_deviation.mm, 3.0 / 640);
}

/// Applies the log to the card, up to `until`.
void act_out(Rack& rack, const std::vector<sim::LoggedInput>& inputs, Instant from, Instant until) {
    std::vector<sim::LoggedInput> part;
    for (const sim::LoggedInput& input : inputs)
        if (input.at > from && input.at <= until) part.push_back(input);
    sim::RegisterDevice& card = *rack.cards().front()->registers();
    sim::replay(rack.kernel(), part, until, [&card](const sim::LoggedInput& input) {
        if (input.kind == sim::InputKind::register_write) card.write(input.offset, input.value);
        if (input.kind == sim::InputKind::register_read) card.read(input.offset);
    });
}

TEST(Journey, RestoredInTheMiddleItEndsIdentically) {
    const JobSettings settings =
        settings_of("G21 G90 F2400\nG1 X20 Y10\nG3 X30 Y20 I0 J10\nG2 X30 Y20 I6 J0 Z75\nG0 X0 Y0\nM2\n");
    Running original(router(), settings);
    ASSERT_TRUE(original.job.run().ended);
    const std::vector<sim::LoggedInput> inputs = original.rack.input_log().inputs();
    const Instant end = original.rack.kernel().now(), middle{end.count() / 2};
    const std::uint64_t history = original.rack.kernel().trace_hash();

    Running again(router(), settings);
    sim::Kernel& kernel = again.rack.kernel();
    act_out(again.rack, inputs, Instant{-1}, middle);
    const sim::Snapshot snapshot = kernel.snapshot();
    const std::uint64_t state_at_middle = kernel.state_hash();
    act_out(again.rack, inputs, middle, end);
    EXPECT_EQ(kernel.trace_hash(), history);
    const std::uint64_t state_at_end = kernel.state_hash();
    EXPECT_NE(state_at_end, state_at_middle);

    kernel.restore(snapshot);
    EXPECT_EQ(kernel.now(), middle);
    EXPECT_EQ(kernel.state_hash(), state_at_middle);
    act_out(again.rack, inputs, middle, end);
    EXPECT_EQ(kernel.trace_hash(), history);
    EXPECT_EQ(kernel.state_hash(), state_at_end);
    for (int channel = 0; channel < 4; ++channel)
        EXPECT_EQ(again.rack.cards().front()->motion()->pulse_counter(channel),
                  original.rack.cards().front()->motion()->pulse_counter(channel))
            << channel;
}

TEST(Journey, AHundredThousandShortLinesEndExactly) {
    std::string program = "G21 G90 G64 P0.01 F3000\nG0 X150 Y100\n";
    char line[64];
    // A closed flower: 0.03 mm a line.
    constexpr int count = 100'000;
    double angle = 0;
    for (int i = 1; i <= count; ++i, angle = 62.83185307179586 * i / count) {
        const double radius = 40 + 8 * std::sin(5 * angle);
        std::snprintf(line, sizeof line, "X%.3f Y%.3f\n", 110 + radius * std::cos(angle),
                      100 + radius * std::sin(angle));
        program += i == 1 ? std::string("G1 ") + line : line;
    }
    program += "G0 X0 Y0\nM2\n";
    JobSettings settings = settings_of(program);
    settings.max_samples = 1000;
    Running running(router(), settings);
    const JobOutcome outcome = running.job.run();
    ASSERT_TRUE(outcome.ended) << outcome.ended.error().text();
    EXPECT_EQ(outcome.run.lines, count + 4);
    EXPECT_GE(outcome.run.plan.moves, count);
    EXPECT_TRUE(outcome.position_valid);
    EXPECT_LE(outcome.max_deviation.mm, 3.0 / 640);
    for (const AxisOutcome& axis : outcome.axes) {
        EXPECT_EQ(axis.pulses_net, 0) << axis.index;
        EXPECT_EQ(axis.encoder_counts, axis.expected_counts) << axis.index;
        EXPECT_LE(axis.top.peak_velocity, axis.limits.max_velocity * 1.001) << axis.index;
    }
    EXPECT_LE(running.job.monitor().samples().size(), 1000u) << "memory does not grow with the program";
}

}  // namespace
}  // namespace motionrack::rack
