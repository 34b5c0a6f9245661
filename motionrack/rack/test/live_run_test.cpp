// Report of a run with commands: it equals that of a run without commands.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/test/lossless_support.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;

/// A command after the end of the run: it makes the job accept commands and changes nothing.
const std::pair<double, std::string> after_the_end = {1e5, "feed=1"};

class LiveRunReport : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(With, LiveRunReport, testing::Values("trapezoid", "jerk_limited"),
                         [](const auto& each) { return std::string(each.param); });

std::vector<std::string> events_of(const JobOutcome& outcome) {
    std::vector<std::string> out;
    for (const control::ProgramEvent& event : outcome.run.events)
        out.push_back(fmt::format("{} {}", event.line, event.text));
    return out;
}

TEST_P(LiveRunReport, HasTheEventsTheDwellsAndTheMovesOfTheProgram) {
    const std::string program =
        "G21 G90 G61 T2 M6\n(MSG,clamp the part)\nS12000 M3\nM8\nG0 X10 Y5\nG4 P0.25\nG1 X30 F3000\nM64 P1\n"
        "G1 X20 Y10 (a comment)\nM0\nM5 M9\nG0 X0 Y0\nG1 X0 Y0 F600\nM2\nG1 X5\n";
    const RackConfig config = router(GetParam());
    const JobOutcome plain = drive_with(config, program, {}).outcome,
                     live = drive_with(config, program, {after_the_end}).outcome;
    ASSERT_TRUE(plain.ended) << plain.ended.error().text();
    ASSERT_TRUE(live.ended) << live.ended.error().text();
    EXPECT_GE(plain.run.events.size(), 10u);
    EXPECT_EQ(events_of(live), events_of(plain));
    EXPECT_EQ(live.run.events_left_out, 0);
    EXPECT_EQ(live.run.plan.dwells, 1);
    EXPECT_EQ(live.run.moves, plain.run.moves);
    EXPECT_EQ(live.run.lines, plain.run.lines);
    EXPECT_TRUE(live.run.ended);
}

TEST(LiveRun, NamesTheMoveBeforeEachEventAndCountsTheSegmentsOfAllPaths) {
    const RackConfig config = router();
    const std::string first = "S1000 M3\nG1 X2 F600\nM0\n";
    const JobOutcome one = drive_with(config, first, {after_the_end}).outcome,
                     two = drive_with(config, first + "G1 X4\nM2\n", {after_the_end}).outcome;
    ASSERT_TRUE(two.ended) << two.ended.error().text();
    // Each move of 0.2 s has two slices.
    for (const control::ProgramEvent& event : two.run.events) {
        const std::int64_t expected = event.line == 1 ? -1 : event.line == 3 ? 1 : 3;
        EXPECT_EQ(event.after_move, expected) << event.text;
    }
    EXPECT_EQ(two.run.events.back().line, 5);
    EXPECT_GT(one.chip_segments, 0);
    EXPECT_EQ(two.chip_segments, 2 * one.chip_segments);
}

TEST_P(LiveRunReport, SaysOfAStopOnRequestWhereTheAxesStopped) {
    const Driven stopped =
        drive_with(router(GetParam()), "G21 G90\nG1 X100 F3000\nM2\n", {{1.0, "stop"}, after_the_end});
    ASSERT_FALSE(stopped.outcome.ended);
    EXPECT_EQ(stopped.outcome.ended.error().kind, ErrorKind::stopped);
    EXPECT_THAT(stopped.outcome.ended.error().message,
                HasSubstr("Stopped on request in line 2; the axes stopped along the path at X "));
    EXPECT_EQ(stopped.outcome.ended.error().location.line, 2);
}

TEST(LiveRun, DrivesARapidFromRestToRestAsARunWithoutCommandsDoes) {
    const std::string program = "G21 G90\nG0 X100 Y40\nM2\n";
    const JobOutcome plain = drive_with(router(), program, {}).outcome,
                     live = drive_with(router(), program, {after_the_end}).outcome;
    ASSERT_TRUE(live.ended) << live.ended.error().text();
    EXPECT_EQ(live.chip_segments, plain.chip_segments);
    EXPECT_EQ(live.time, plain.time);
    EXPECT_EQ(live.trace_hash, plain.trace_hash);
}

TEST(LiveRun, SlowsARapidDownOnItsWayAndEndsItExactly) {
    const std::string program = "G21 G90\nG0 X200\nM2\n";
    const JobOutcome plain = drive_with(router(), program, {}).outcome;
    const double asked = to_seconds(plain.time) / 2, slow = 0.25 * plain.axes[0].limits.max_velocity;
    double slow_at = -1, fastest_after = 0;
    const auto look = [&](Rack& rack) {
        const double now = to_seconds(rack.kernel().now()), velocity = rack.axes()[0].machine->velocity();
        if (now > asked && slow_at < 0 && velocity <= slow * 1.01) slow_at = now;
        if (slow_at > 0) fastest_after = std::max(fastest_after, velocity);
    };
    const Driven driven = drive_with(router(), program, {{asked, "rapid=0.25"}, after_the_end}, look);
    expect_end(driven, 200, 0);
    expect_lossless(driven);
    EXPECT_GT(slow_at, asked);
    EXPECT_LT(slow_at, asked + 0.5);
    EXPECT_LE(fastest_after, slow * 1.01);
    EXPECT_GT(fastest_after, slow * 0.9);
    EXPECT_GT(driven.outcome.time, plain.time + whole_seconds(1));
}

TEST(LiveRun, WithLimitedJerkPlansALongProgramAsARunWithoutCommandsDoes) {
    std::string program = "G21 G90 G64 P0.01\nG0 X190 Y100\nG1 F6000\n";
    for (int i = 1; i <= 4'000; ++i)  // more lines than the queue of slices has
        program += fmt::format("X{:.4f} Y{:.4f}\n", 150 + 40 * std::cos(i * 0.0075), 100 + 40 * std::sin(i * 0.0075));
    program += "M2\n";
    const JobOutcome plain = drive_with(router("jerk_limited"), program, {}).outcome,
                     live = drive_with(router("jerk_limited"), program, {after_the_end}).outcome;
    ASSERT_TRUE(live.ended) << live.ended.error().text();
    EXPECT_EQ(live.time, plain.time);
    EXPECT_EQ(live.trace_hash, plain.trace_hash);
}

}  // namespace
}  // namespace motionrack::rack
