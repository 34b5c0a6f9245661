// The controller itself loses no step: whatever is wished while a program runs, the pulses on the wires never change
// their rate by more than the motors can follow.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/rack/order_plan.hpp>
#include <tests/journey.hpp>
#include <tests/pulse_referee.hpp>

namespace motionrack::rack {
namespace {

struct Driven {
    JobOutcome outcome;
    test::PulseReferee::Verdict worst;
};

/// `orders`: seconds and what is wished then.
Driven drive_with(const RackConfig& config, const std::string& program,
                  const std::vector<std::pair<double, std::string>>& orders) {
    Rack rack(config);
    std::vector<TimedText> texts;
    for (const auto& [seconds, action] : orders) texts.push_back({Instant{} + from_seconds(seconds), action, action});
    auto plan = OrderPlan::create(rack, texts);
    EXPECT_TRUE(plan);
    JobSettings settings;
    settings.program = program;
    settings.program_name = "test";
    settings.orders = plan->get();
    Job job(rack, settings);
    test::PulseReferee referee(rack);
    rack.start();
    (*plan)->begin();
    Driven out;
    out.outcome = job.run();
    out.worst = referee.verdict();
    return out;
}

std::vector<std::pair<double, std::string>> holds(double first, double every, int count) {
    std::vector<std::pair<double, std::string>> out;
    for (int i = 0; i < count; ++i) {
        out.emplace_back(first + i * every, "hold");
        out.emplace_back(first + (i + 0.5) * every, "resume");
    }
    return out;
}

/// A spiral about the middle of the table, in chords of this length.
std::string spiral(double chord, double length) {
    std::string out = "G21 G90 G64 P0.01\nG0 X170 Y100\nG1 F6000\n";
    double angle = 0;
    for (double s = 0; s < length; s += chord) {
        const double radius = 20 + s / 100;
        angle += chord / radius;
        out += fmt::format("X{:.4f} Y{:.4f}\n", 150 + radius * std::cos(angle), 100 + radius * std::sin(angle));
    }
    return out + "M2\n";
}

std::string collinear(double line, double length) {
    std::string out = "G21 G90 G64 P0.01\nG0 X10 Y10\nG1 F6000\n";
    for (double s = line; s < length; s += line) out += fmt::format("X{:.4f} Y{:.4f}\n", 10 + s * 0.8, 10 + s * 0.6);
    return out + "M2\n";
}

class AHold : public testing::TestWithParam<const char*> {};
std::string profile_of(const testing::TestParamInfo<const char*>& param) {
    return param.param;
}
INSTANTIATE_TEST_SUITE_P(With, AHold, testing::Values("trapezoid", "jerk_limited"), profile_of);

/// No jump above what a start takes, and the end where the program has it.
void expect_lossless(const char* profile, const std::string& program, double x, double y) {
    const Driven held = drive_with(router(profile), program, holds(2.1, 0.613, 4));
    ASSERT_TRUE(held.outcome.ended) << held.outcome.ended.error().text();
    EXPECT_LE(held.worst.parts, 1.15) << "axis " << held.worst.axis << ": " << held.worst.jump.speed << " mm/s at "
                                      << held.worst.jump.seconds << " s";
    EXPECT_NEAR(held.outcome.axes[0].planned_end, x, 0.51 / 640);
    EXPECT_NEAR(held.outcome.axes[1].planned_end, y, 0.51 / 640);
}

TEST_P(AHold, BrakesAlongASpiralOfChordsOfAnyLength) {
    for (const double chord : {0.2, 0.7}) {
        SCOPED_TRACE(chord);
        const std::string program = spiral(chord, 260);
        const std::size_t last = program.rfind('X');
        double x = 0, y = 0;
        ASSERT_EQ(std::sscanf(program.c_str() + last, "X%lf Y%lf", &x, &y), 2);
        expect_lossless(GetParam(), program, x, y);
    }
}

TEST_P(AHold, BrakesAlongCollinearLinesOfAnyLength) {
    for (const double line : {0.5, 1.0, 10.0}) {
        SCOPED_TRACE(line);
        const std::string program = collinear(line, 230);
        const std::size_t last = program.rfind('X');
        double x = 0, y = 0;
        ASSERT_EQ(std::sscanf(program.c_str() + last, "X%lf Y%lf", &x, &y), 2);
        expect_lossless(GetParam(), program, x, y);
    }
}

}  // namespace
}  // namespace motionrack::rack
