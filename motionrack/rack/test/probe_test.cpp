// Probing on a running rack: the contact position is exact at every feed rate, and the program continues from the
// machine's position.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <motionrack/control/stream_executor.hpp>
#include <motionrack/rack/command_schedule.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/test/config_helpers.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;

constexpr double pulses_per_mm = 640;

std::string rack_text(const std::string& block, const std::string& more = {}) {
    std::string text = "[card.motion]\ntype = \"mcx314\"\nvariant = \"mcx314as\"\n";
    for (const char* axis : {"X\nx", "Y\ny", "Z\nz"}) {
        text += std::string("[axis.") + axis[0] + "]\ncard = \"motion\"\nchannel = \"" + axis[2] +
                "\"\nmotor.pull_out_hz = 200000\n";
        if (axis[0] == 'Z') text += "min_limit_mm = 0\nmax_limit_mm = 80\ninitial_position_mm = 80\n";
    }
    return text + "[probe]\n" + block + more;
}

JobOutcome run_probe(const std::string& rack_text, const std::string& program) {
    Rack rack(good(rack_text));
    JobSettings settings;
    settings.program = program;
    Job job(rack, settings);
    rack.start();
    return job.run();
}

/// Returns the program's events about the probe.
std::vector<std::string> set_probe_result(const JobOutcome& out) {
    std::vector<std::string> texts;
    for (const control::ProgramEvent& event : out.run.events)
        if (event.text.find("probe") == 0) texts.push_back(event.text);
    return texts;
}

std::string at(const char* what, double x, double y, double z) {
    char text[120];
    std::snprintf(text, sizeof text, "probe %s at X %.4f Y %.4f Z %.4f", what, x, y, z);
    return text;
}

/// Rounds mm to whole pulses, like the card.
double whole(double mm) {
    return std::floor(mm * pulses_per_mm + 0.5) / pulses_per_mm;
}

TEST(Probing, LatchesTheSamePulseAtEveryFeed) {
    for (const int feed : {2, 30, 60, 150, 600, 1800, 3000, 6000}) {
        const std::string program =
            "G21 G90\nG38.2 X" + std::string(feed < 10 ? "1" : "250") + " F" + std::to_string(feed) + "\nM2\n";
        const double edge = feed < 10 ? 0.321 : 187.123;
        const JobOutcome out = run_probe(rack_text("x_min_mm = " + std::to_string(edge) + "\n"), program);
        ASSERT_TRUE(out.ended) << out.ended.error().message;
        EXPECT_EQ(set_probe_result(out), std::vector{at("touched", whole(edge), 0, 80)}) << "F" << feed;
        // The axis stops beyond the edge, within the braking distance at 900 mm/s2 and a margin.
        const double velocity = feed / 60.0, way = out.axes[0].actual_end - whole(edge);
        EXPECT_GE(way, 0);
        EXPECT_LE(way, velocity * velocity / 2 / 900 + velocity * 0.03 + 0.01)
            << "F" << feed;  // the axis has 1000 mm/s2 and 20,000 mm/s3
        EXPECT_EQ(out.axes[0].lost_pulses, 0);
    }
}

TEST(Probing, LatchesAllAxesOfASlantedMoveAtTheSameInstant) {
    const JobOutcome out =
        run_probe(rack_text("x_min_mm = 41.7\ny_min_mm = 0\ny_max_mm = 100\nz_min_mm = 0\nz_max_mm = 75\n"),
                  "G21 G90\nG1 Z70 F3000\nG38.2 X90 Y45 Z60 F2400\nM2\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    const auto texts = set_probe_result(out);
    ASSERT_EQ(texts.size(), 1u);
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(texts[0].c_str(), "probe touched at X %lf Y %lf Z %lf", &x, &y, &z), 3) << texts[0];
    EXPECT_NEAR(x, whole(41.7), 1e-4);
    EXPECT_NEAR(y, x / 2, 0.51 / pulses_per_mm + 1e-4);
    EXPECT_NEAR(z, 70 - x / 9, 0.51 / pulses_per_mm + 1e-4);
}

TEST(Probing, LeavesAndTouchesWithinOneProgram) {
    // Typical sequence: fast down, back until release, slowly down again; then up by increments from there.
    const JobOutcome out =
        run_probe(rack_text("z_max_mm = 12.34\n"),
                  "G21 G90\nG38.2 Z0 F1800\nG38.4 Z40 F600\nG38.2 Z0 F30\nG91 G1 Z5 F600\nG90 X10 F3000\nM2\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    const double edge = 80 - std::ceil((80 - 12.34) * pulses_per_mm - 0.5) / pulses_per_mm;
    EXPECT_EQ(set_probe_result(out), (std::vector{at("touched", 0, 0, edge), at("left", 0, 0, edge + 1 / pulses_per_mm),
                                                  at("touched", 0, 0, edge)}));
    EXPECT_NEAR(out.axes[2].actual_end, edge + 5, 0.01);
    EXPECT_EQ(out.axes[0].actual_end, 10);
    EXPECT_EQ(out.run.moves, 5);
}

/// Moves down in steps until the probe makes contact, three times along X, and stores the results. Then moves above the
/// lowest position, and X to a position from a sub. Subs, loops and conditions depend on the probe results.
constexpr const char* measures =
    "G21 G90 G94\n#<least> = 1000\no<down> sub (step)\n  G91\n  o10 do\n    G38.3 Z-#1 F1200\n  o10 while [#5070 EQ "
    "0]\n  G90\n"
    "o<down> endsub [#5063]\n#<k> = 0\no20 while [#<k> LT 3]\n  o<down> call [7.5 + #<k>]\n  #[100 + #<k>] = "
    "#<_value>\n"
    "  o21 if [#<_value> LT #<least>]\n    #<least> = #<_value>\n  o21 endif\n  G0 Z60\n  #<k> = [#<k> + 1]\n  G0 "
    "X[#<k> * 10]\no20 endwhile\n"
    "G0 Z[#<least> + 5]\no30 if [ABS[#100 - #102] LT 0.0001]\n  G41.1 D4\n  G1 X50 Y20 F1200\n  X80\n  G40 G0 X90 "
    "Y10\no30 endif\n"
    "(DEBUG, lowest #<least>)\nM2\n";

void expect_measured(const JobOutcome& out) {
    ASSERT_TRUE(out.ended) << out.ended.error().text();
    EXPECT_TRUE(out.run.ended);
    const double edge = 80 - std::ceil((80 - 12.34) * pulses_per_mm - 0.5) / pulses_per_mm;
    EXPECT_NEAR(out.axes[2].actual_end, edge + 5, 0.002);
    EXPECT_NEAR(out.axes[0].actual_end, 90, 0.002);
    EXPECT_NEAR(out.axes[1].actual_end, 10, 0.002);
    int hits = 0;
    for (const control::ProgramProbe& probe : out.run.probes) {
        hits += probe.outcome.hit;
        EXPECT_NEAR(probe.outcome.at[2], probe.outcome.hit ? edge : probe.outcome.at[2], 1e-9);
    }
    EXPECT_EQ(hits, 3);
    EXPECT_GT(out.run.probes.size(), 10u);
}

TEST(Probing, LoopsSubsAndConditionsDependOnTheProbeResult) {
    expect_measured(run_probe(rack_text("z_max_mm = 12.34\n"), measures));
}

TEST(Probing, LoopsSubsAndConditionsDependOnTheProbeResultAfterAFeedHold) {
    Rack rack(good(rack_text("z_max_mm = 12.34\n")));
    auto orders = CommandSchedule::create(
        rack, {{milliseconds(1000), "hold", "hold@1"}, {milliseconds(2000), "resume", "resume@2"}});
    ASSERT_TRUE(orders) << orders.error().message;
    JobSettings settings;
    settings.program = measures;
    settings.commands = orders->get();
    Job job(rack, settings);
    rack.start();
    (*orders)->begin();
    expect_measured(job.run());
}

TEST(Probing, AThinPlateIsDetectedEvenIfTheAxisOvershootsIt) {
    const JobOutcome out =
        run_probe(rack_text("x_min_mm = 100\nx_max_mm = 100.01\n"), "G21 G90\nG38.2 X250 F6000\nG1 X120 F600\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_EQ(set_probe_result(out), std::vector{at("touched", 100, 0, 80)});
    EXPECT_EQ(out.axes[0].actual_end, 120);
}

TEST(Probing, WithoutContactTheMoveReachesItsEndAndOnlyG38Point2AndPoint4AreErrors) {
    const std::string rack = rack_text("x_min_mm = 200\n");
    const JobOutcome may = run_probe(rack, "G21 G90\nG38.3 X50 F600\nG1 X60\n");
    ASSERT_TRUE(may.ended) << may.ended.error().message;
    EXPECT_EQ(
        set_probe_result(may),
        std::vector<std::string>{"probe did not touch before the end of its move at X 50.0000 Y 0.0000 Z 80.0000"});
    EXPECT_EQ(may.axes[0].actual_end, 60);
    const JobOutcome must = run_probe(rack, "G21 G90\nG38.2 X50 F600\nG1 X60\n");
    ASSERT_FALSE(must.ended);
    EXPECT_EQ(must.ended.error().kind, ErrorKind::machine);
    EXPECT_THAT(must.ended.error().message, HasSubstr("In line 2 the probe did not touch"));
    EXPECT_EQ(must.axes[0].actual_end, 50);
}

TEST(Probing, IsRejectedIfTheProbeIsAlreadyInTheTargetState) {
    const JobOutcome touches = run_probe(rack_text("x_min_mm = 10\n"), "G21 G90\nG0 X20\nG38.2 X50 F600\n");
    ASSERT_FALSE(touches.ended);
    EXPECT_THAT(touches.ended.error().message, HasSubstr("is closed before the move"));
    EXPECT_EQ(touches.axes[0].actual_end, 20);
    const JobOutcome free = run_probe(rack_text("x_min_mm = 10\n"), "G21 G90\nG38.5 X50 F600\n");
    ASSERT_FALSE(free.ended);
    EXPECT_THAT(free.ended.error().message, HasSubstr("is open before the move"));
}

TEST(Probing, WorksWithLimitedJerk) {
    const JobOutcome out = run_probe(rack_text("x_min_mm = 187.123\n", "[controller]\nprofile = \"jerk_limited\"\n"),
                                     "G21 G90\nG1 X20 Y20 F3000\nG38.2 X250 F3000\nG91 G1 Y-5\nX-10\nM2\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_EQ(set_probe_result(out), std::vector{at("touched", whole(187.123), 20, 80)});
    EXPECT_NEAR(out.axes[1].actual_end, 15, 0.002);
}

std::string bad(const std::string& text) {
    return all_texts(read_rack_text(text).errors);
}

TEST(Probing, ReportsErrorsOfTheProbeInARackFile) {
    EXPECT_THAT(bad("[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[probe]\n"),
                HasSubstr("cannot catch positions"));
    EXPECT_THAT(bad(rack_text("x_min_mm = 5\nx_max_mm = 4\n")), HasSubstr("its first end must be below the other"));
}

TEST(Probing, ErrorsOfBoundsNameTheLineOfTheKey) {
    const RackReading order = read_rack_text(rack_text("x_max_mm = 4\nx_min_mm = 5\n"));
    ASSERT_EQ(order.errors.size(), 1u) << all_texts(order.errors);
    const std::string text = rack_text("");
    const int heading = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    EXPECT_EQ(order.errors[0].location, (TextPosition{heading + 2, 12}));

    const std::string no_axis =
        "[card.m]\ntype = \"mcx314\"\nvariant = \"mcx314as\"\n"
        "[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[probe]\nx_min_mm = 1\ny_max_mm = 4\n";
    const RackReading missing = read_rack_text(no_axis);
    ASSERT_EQ(missing.errors.size(), 1u) << all_texts(missing.errors);
    EXPECT_EQ(missing.errors[0].location, (TextPosition{9, 12}));
}

/// Feeds lines one by one, each only when there is room.
struct Fed {
    Rack rack;
    std::unique_ptr<control::StreamExecutor> stream;
    Result<control::ExecutionState> state;

    explicit Fed(const RackConfig& config) : rack(config) {
        rack.start();
        control::StreamExecutorSettings settings;
        settings.gcode = reader_settings(config);
        settings.jerk_limited = config.jerk_limited();
        settings.accel_reserve = accel_reserve_of(rack);
        stream = std::make_unique<control::StreamExecutor>(**rack.path_axes(), rack.cards().front()->host(), settings);
        rack.set_stop_flag(stream->stop_flag());
        rack.on_slice(milliseconds(1), [this] {
            if (on_slice) on_slice();
        });
    }
    void drive(const std::vector<std::string>& lines) {
        std::size_t next = 0;
        do {
            while (next < lines.size() && stream->has_room()) {
                const auto read = stream->line(lines[next], static_cast<int>(next) + 1);
                ASSERT_TRUE(read) << read.error().text();
                ++next;
            }
            state = stream->drive(next < lines.size());
            if (state && *state == control::ExecutionState::waiting) rack.cards().front()->host().pass(milliseconds(1));
            if (state && *state == control::ExecutionState::feed_hold) held_at.push_back(x()), stream->resume();
            if (state && *state == control::ExecutionState::paused) paused_at.push_back(x()), stream->resume();
        } while (state && (*state != control::ExecutionState::idle || next < lines.size()));
    }
    double x() { return rack.axes()[0].machine->position(rack.kernel().now()); }
    std::function<void()> on_slice;
    std::vector<double> held_at, paused_at;  ///< positions of X
};

class ProbingByLines : public testing::TestWithParam<const char*> {
  protected:
    RackConfig config(const std::string& block) {
        return good(rack_text(block, std::string("[controller]\nprofile = \"") + GetParam() + "\"\n"));
    }
};
INSTANTIATE_TEST_SUITE_P(With, ProbingByLines, testing::Values("trapezoid", "jerk_limited"),
                         [](const auto& each) { return std::string(each.param); });

TEST_P(ProbingByLines, TheNextLineStartsAtTheStopPosition) {
    Fed fed(config("x_min_mm = 187.123\n"));
    fed.drive({"G21 G90", "G1 X10 F3000", "G38.2 X250", "G91 G1 X-2", "X-3", "G90 X20"});
    ASSERT_TRUE(fed.state) << fed.state.error().message;
    const control::ProbeReport& probe = fed.stream->last_probe();
    EXPECT_TRUE(probe.begun && probe.outcome.hit && !probe.failed());
    EXPECT_EQ(probe.count, 1);
    EXPECT_EQ(probe.outcome.at[0], whole(187.123));
    EXPECT_EQ(fed.stream->interpreter().frame().probe[0], whole(187.123));
    EXPECT_EQ(fed.x(), 20);
}

TEST_P(ProbingByLines, AMissIsAnErrorOfSomeCodesOnly) {
    Fed fed(config("x_min_mm = 200\n"));
    fed.drive({"G21 G90", "G38.3 X50 F3000", "G1 X60"});
    ASSERT_TRUE(fed.state);
    EXPECT_EQ(fed.x(), 60);
    EXPECT_FALSE(fed.stream->last_probe().outcome.hit);
    fed.drive({"G38.2 X100"});
    ASSERT_FALSE(fed.state);
    EXPECT_TRUE(fed.stream->last_probe().failed() && fed.stream->last_probe().begun);
    EXPECT_EQ(fed.x(), 100);
    fed.drive({"G1 X250", "G38.2 X260"});
    ASSERT_FALSE(fed.state);
    EXPECT_TRUE(fed.stream->last_probe().failed() && !fed.stream->last_probe().begun);
    EXPECT_EQ(fed.stream->last_probe().count, 3);
    fed.drive({"G1 X20"});
    EXPECT_TRUE(fed.state);
    EXPECT_EQ(fed.x(), 20);
}

TEST_P(ProbingByLines, AStopEndsItAndAFeedHoldWaitsForItsEnd) {
    Fed stopped(config("x_min_mm = 200\n"));
    bool done = false;
    stopped.on_slice = [&] {
        if (!std::exchange(done, done || stopped.x() > 50) && stopped.x() > 50) stopped.stream->stop();
    };
    stopped.drive({"G21 G90", "G38.2 X250 F3000"});
    ASSERT_TRUE(stopped.state) << stopped.state.error().message;
    EXPECT_LT(stopped.x(), 60);
    EXPECT_EQ(stopped.stream->last_probe().count, 0);
    stopped.drive({"G1 X10"});
    EXPECT_EQ(stopped.x(), 10);

    Fed held(config("x_min_mm = 100\n"));
    bool asked = false;
    held.on_slice = [&] {
        if (!asked && held.x() > 50) held.stream->hold(), asked = true;
    };
    held.drive({"G21 G90", "G38.2 X250 F3000", "G1 X20"});
    ASSERT_TRUE(held.state) << held.state.error().message;
    EXPECT_TRUE(held.stream->last_probe().outcome.hit);
    EXPECT_EQ(held.x(), 20);
}

TEST_P(ProbingByLines, AFeedHoldInItHoldsTheLineBehindItAndNoLaterOne) {
    for (const bool is_alone : {true, false}) {
        SCOPED_TRACE(is_alone);
        Fed fed(config("x_min_mm = 100\n"));
        bool asked = false;
        fed.on_slice = [&] {
            if (!asked && fed.x() > 50) fed.stream->hold(), asked = true;
        };
        fed.drive(is_alone ? std::vector<std::string>{"G21 G90", "G38.2 X250 F3000"}
                           : std::vector<std::string>{"G21 G90", "G38.2 X250 F3000", "G1 X20", "G1 X15"});
        EXPECT_TRUE(asked);
        fed.drive({"G1 X10"});
        ASSERT_TRUE(fed.state) << fed.state.error().message;
        EXPECT_EQ(fed.held_at.size(), is_alone ? 0u : 1u);
        if (!is_alone) {
            EXPECT_GT(fed.held_at.at(0), 100);
        }
        EXPECT_EQ(fed.x(), 10);
    }
}

TEST_P(ProbingByLines, InSingleBlockALineFollowsAfterAPause) {
    Fed fed(config("x_min_mm = 100\n"));
    fed.stream->set_single_block(true);
    fed.drive({"G21 G90", "G38.2 X250 F3000", "G1 X20", "G1 X10"});
    ASSERT_TRUE(fed.state) << fed.state.error().message;
    ASSERT_EQ(fed.paused_at.size(), 2u);
    EXPECT_GT(fed.paused_at[0], 100);
    EXPECT_EQ(fed.paused_at[1], 20);
    fed.drive({"G38.3 X30"});
    fed.drive({"G1 X15"});
    EXPECT_EQ(fed.paused_at.size(), 2u) << "no line waited at its end";
    EXPECT_EQ(fed.x(), 15);
}

TEST_P(ProbingByLines, AStopThatMeetsItsEndLeavesRoomForLines) {
    for (const double beyond : {0.01, 0.4, 0.8, 1.1, 1.2}) {
        SCOPED_TRACE(beyond);
        Fed fed(config("x_min_mm = 100\n"));
        bool asked = false;
        fed.on_slice = [&] {
            if (!asked && fed.x() > 100 + beyond) fed.stream->stop(), asked = true;
        };
        fed.drive({"G21 G90", "G38.2 X250 F3000"});
        ASSERT_TRUE(fed.state) << fed.state.error().message;
        ASSERT_TRUE(fed.stream->has_room());
        fed.drive({"G1 X10"});
        EXPECT_EQ(fed.x(), 10);
    }
}

TEST(Probing, NeedsAProbe) {
    std::string text = rack_text("");
    text.erase(text.find("[probe]"));
    const JobOutcome out = run_probe(text, "G38.2 X10 F60\n");
    ASSERT_FALSE(out.ended);
    EXPECT_THAT(out.ended.error().message, HasSubstr("this machine has no probe input"));
}

}  // namespace
}  // namespace motionrack::rack
