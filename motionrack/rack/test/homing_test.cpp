// Homing the axes of a rack: requests from the file, several axes, refusals, reports.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/template.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::rack {
namespace {

using testing::HasSubstr;

constexpr const char* two_axes = R"(
[card.motion]
type = "mcx314"
[axis.X]
card = "motion"
channel = "x"
initial_position_mm = 40
[axis.X.switches]
limit_minus_mm = -8
limit_plus_mm = 302
home_mm = 2
[axis.X.homing]
method = 4
home_offset_mm = 0
[axis.Y]
card = "motion"
channel = "y"
initial_position_mm = 7
[axis.Y.switches]
limit_minus_mm = -8
limit_plus_mm = 302
home_mm = 1
)";

RackConfig config_of(const std::string& text) {
    const RackReading reading = read_rack_text(text);
    EXPECT_TRUE(reading.config) << (reading.errors.empty() ? "" : reading.errors[0].message);
    return *reading.config;
}

HomingOutcome homed(const std::string& text, const HomingSettings& settings = {}) {
    Rack rack(config_of(text));
    rack.start();
    return home_axes(rack, settings);
}

TEST(RackHomes, AllAxesWithASwitchTogetherAndSetsTheirCounters) {
    const HomingOutcome out = homed(two_axes);
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_TRUE(out.all_homed());
    ASSERT_EQ(out.axes.size(), 2u);
    const HomedAxis &x = out.axes[0], &y = out.axes[1];
    EXPECT_NEAR(y.counter_position, 1, 1e-9);
    EXPECT_NEAR(y.machine_position, 1, 1e-9);
    EXPECT_NEAR(y.measured_position, 1, 1e-9);
    EXPECT_NEAR(x.machine_position, 0, 1e-9) << "the index is at whole turns of 5 mm, the switch at 2 mm";
    EXPECT_NEAR(*x.outcome.switch_to_index, 2, 1e-9);
    EXPECT_NEAR(x.counter_position, 0, 1e-9);
    EXPECT_LT(y.outcome.took_s, x.outcome.took_s);
    EXPECT_NEAR(out.seconds, x.outcome.took_s, 0.005);
}

TEST(RackHomes, UsesTheHomeOffsetOfTheFile) {
    const HomingOutcome out =
        homed(std::string(two_axes) +
              "[axis.Y.homing]\nhome_offset_mm = -3.5\nsearch_velocity_mm_s = 10\nlatch_velocity_mm_s = 0.25\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_NEAR(out.axes[1].counter_position, -3.5, 0.5 / 640);
    EXPECT_NEAR(out.axes[1].machine_position, 1, 1e-9);
    EXPECT_DOUBLE_EQ(out.axes[1].order.search_velocity, 10);
    for (const control::HomingEdge& edge : out.axes[1].outcome.edges) EXPECT_LE(edge.velocity, 10.01);
}

TEST(RackHomes, UpwardsItFindsWhereTheSwitchIsReleased) {
    const HomingOutcome out = homed(std::string(two_axes) + "[axis.Y.homing]\nsearch_direction = \"plus\"\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_NEAR(out.axes[1].machine_position, 1.05, 1.01 / 640);
    EXPECT_NEAR(out.axes[1].counter_position, 1.05, 1.01 / 640);
}

TEST(RackHomes, LowerSequenceNumbersGoFirst) {
    const HomingOutcome out = homed(std::string(two_axes) + "[axis.Y.homing]\nsequence = 2\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_DOUBLE_EQ(out.axes[0].began_s, 0);
    EXPECT_GE(out.axes[1].began_s, out.axes[0].outcome.took_s);
    EXPECT_NEAR(out.seconds, out.axes[0].outcome.took_s + out.axes[1].outcome.took_s, 0.005);
}

TEST(RackHomes, StartsNoLaterSequenceAfterAFailure) {
    // The index is at the switch position, which method 4 rejects.
    std::string text = std::string(two_axes) + "[axis.Y.homing]\nsequence = 1\n";
    text.replace(text.find("home_mm = 2"), 11, "home_mm = 0");
    const HomingOutcome out = homed(text);
    ASSERT_FALSE(out.ended);
    EXPECT_EQ(out.ended.error().kind, ErrorKind::machine);
    EXPECT_THAT(out.ended.error().message, HasSubstr("Shift the switch by half a motor revolution"));
    EXPECT_FALSE(out.axes[1].begun);
    EXPECT_DOUBLE_EQ(out.axes[1].machine_position, 7);
    EXPECT_THAT(homing_text(out), HasSubstr("not begun"));
}

TEST(RackHomes, RejectsImpossibleRequests) {
    const auto message = [](const std::string& text, const HomingSettings& settings = {}) {
        const HomingOutcome out = homed(text, settings);
        EXPECT_FALSE(out.ended);
        EXPECT_EQ(out.ended.error().kind, ErrorKind::refused);
        return out.ended.error().message;
    };
    HomingSettings unknown;
    unknown.axes = "XQ";
    EXPECT_THAT(message(two_axes, unknown), HasSubstr("no axis 'Q'; its axes are X, Y"));
    EXPECT_THAT(message(std::string(two_axes) + "[wires]\n\"motion.xin0\" = \"open\"\n"),
                HasSubstr("not wired to a stop input of its channel (xin0, xin1, xin2, xin3 of card motion)"));
    EXPECT_THAT(message(std::string(two_axes) + "[wires]\n\"motion.xin2\" = \"open\"\n"),
                HasSubstr("method 4 needs the encoder's index"));
    EXPECT_THAT(message(std::string(two_axes) + "[axis.Y.homing]\nsearch_velocity_mm_s = 101\n"),
                HasSubstr("the velocity is 101 mm/s; it must be above 0 and up to 100"));
    EXPECT_THAT(message("card.c1 = \"mcx314\""), HasSubstr("No axis of the rack has a home switch"));
}

TEST(RackHomes, ThroughAnotherStopInputToo) {
    const HomingOutcome out =
        homed(std::string(two_axes) + "[wires]\n\"motion.yin0\" = \"open\"\n\"motion.yin3\" = \"Y.home\"\n");
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_EQ(out.axes[1].order.switch_input, 3);
    EXPECT_NEAR(out.axes[1].machine_position, 1, 1e-9);
}

TEST(RackHomes, StopsOnRequestAndKeepsTheResultsSoFar) {
    std::atomic<bool> stop{false};
    HomingSettings settings;
    settings.stop = &stop;
    settings.progress = [&](const HomingProgress& p) { stop = p.seconds > 0.3; };
    const HomingOutcome out = homed(two_axes, settings);
    ASSERT_FALSE(out.ended);
    EXPECT_EQ(out.ended.error().kind, ErrorKind::stopped);
    EXPECT_FALSE(out.all_homed());
    EXPECT_GT(out.axes[0].samples.seconds.size(), 300u);
    EXPECT_LT(out.seconds, 1.0);
}

TEST(RackHomes, AProgramRunsAfterwardsOnTheSameCard) {
    Rack rack(config_of(two_axes));
    rack.start();
    ASSERT_TRUE(home_axes(rack, {}).all_homed());
    const Result<control::AxisGroup*> path = rack.path_axes();
    EXPECT_TRUE(path);
    HomingSettings again;
    again.axes = "Y";
    again.method = 1;
    EXPECT_TRUE(home_axes(rack, again).all_homed());
}

TEST(RackHomes, ToTheIndexOfTheFirstHomingOnly) {
    Rack rack(config_of(two_axes));
    rack.start();
    SeenIndexes seen;
    HomingSettings settings;
    settings.axes = "X";
    settings.seen_indexes = &seen;
    ASSERT_TRUE(home_axes(rack, settings).all_homed());
    EXPECT_NEAR(seen[0].value_or(0), 2, 1e-9) << "learned";
    EXPECT_TRUE(home_axes(rack, settings).all_homed()) << "the same again";
    seen[0] = 4;  // as if an earlier homing had seen its index there
    const HomingOutcome moved = home_axes(rack, settings);
    ASSERT_FALSE(moved.ended);
    EXPECT_THAT(moved.ended.error().message, HasSubstr("2.0000 mm behind the switch; it must be 4.0000 mm"));
    EXPECT_FALSE(moved.all_homed());
    EXPECT_EQ(seen[0], 4) << "a search that failed teaches nothing";
}

TEST(RackHomes, UsesTheDeclaredPositionOfTheIndex) {
    std::string text = two_axes;
    const auto place = text.find("home_offset_mm = 0");
    text.replace(place, 18, "index_after_mm = 2.1");  // not 2 mm, but within a quarter revolution
    const HomingOutcome out = homed(text);
    ASSERT_TRUE(out.ended) << out.ended.error().message;
    EXPECT_NEAR(out.axes[0].counter_position, 2 - 2.1, 0.5 / 640);
}

TEST(RackHomes, NoAxisToAnIndexOfUnknownPosition) {
    std::string text = two_axes;
    text.erase(text.find("home_offset_mm = 0"), 18);
    const RackReading reading = read_rack_text(text);
    ASSERT_TRUE(reading.config);
    std::string warnings;
    for (const Error& warning : reading.warnings) warnings += warning.message + "\n";
    EXPECT_THAT(warnings, HasSubstr("Axis X needs home_offset_mm or index_after_mm to home to its index"));
    const HomingOutcome out = homed(text);
    ASSERT_FALSE(out.ended);
    EXPECT_THAT(out.ended.error().message, HasSubstr("give it home_offset_mm (position of the index)"));
}

TEST(RackHomes, WarnsOfAnIndexPositionThatItsCardDoesNotCheck) {
    const RackReading reading = read_rack_text(
        "[card.board]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"board\"\n[axis.X.servo]\n[axis.X.switches]\n"
        "cam_from_mm = 20\ncam_to_mm = 25\n[axis.X.homing]\nmethod = 4\nindex_after_mm = 1\n");
    ASSERT_TRUE(reading.config);
    std::string warnings;
    for (const Error& warning : reading.warnings) warnings += warning.message + "\n";
    EXPECT_THAT(warnings, HasSubstr("index_after_mm of axis X is ignored"));
}

TEST(RackHomes, TheGroupStartsAtThePositionsOfTheAxesAndViceVersa) {
    Rack rack(config_of(two_axes));
    rack.start();
    ASSERT_TRUE(home_axes(rack, {}).all_homed());
    control::Axis* y = *rack.axes()[1].card->axis(rack.config(), 'Y');
    ASSERT_TRUE(y->move_by(12.5, 20));
    ASSERT_TRUE(y->wait(whole_seconds(10)));
    const std::int64_t counts = rack.axes()[1].card->encoder_counter(rack.axes()[1].channel);
    control::AxisGroup* path = *rack.path_axes_here();
    EXPECT_NEAR(path->commanded_position()[1], 13.5, 0.5 / 640);
    EXPECT_EQ(rack.axes()[1].card->encoder_counter(rack.axes()[1].channel), counts);
    y = *rack.axes()[1].card->axis(rack.config(), 'Y');
    EXPECT_TRUE(y->position_valid());
    EXPECT_NEAR(y->position(), 13.5, 0.5 / 640);
    EXPECT_NEAR(y->measured_position(), 13.5, 0.5 / 640);
    EXPECT_EQ(rack.axes()[1].card->encoder_counter(rack.axes()[1].channel), counts);
}

TEST(RackHomes, AnAxisThatTheGroupNeverHadHasNoValidPosition) {
    Rack rack(config_of(two_axes));
    rack.start();
    control::Axis* y = *rack.axes()[1].card->axis(rack.config(), 'Y');
    EXPECT_FALSE(y->position_valid());
    ASSERT_TRUE(rack.path_axes_here());
    y = *rack.axes()[1].card->axis(rack.config(), 'Y');
    EXPECT_FALSE(y->position_valid());
}

TEST(RackHomes, TextJsonAndPictureReportTheSameResults) {
    const HomingOutcome out = homed(two_axes);
    const std::string text = homing_text(out);
    EXPECT_THAT(text, HasSubstr("axis X  method 4, - direction"));
    EXPECT_THAT(text, HasSubstr("INDEX_WAIT"));
    EXPECT_THAT(text, HasSubstr("from the switch to the index  2.0000 mm"));
    EXPECT_THAT(text, HasSubstr("all homed in"));
    const nlohmann::json json = nlohmann::json::parse(homing_json(out));
    EXPECT_TRUE(json["homed"]);
    EXPECT_TRUE(json["error"].is_null());
    EXPECT_EQ(json["axes"].size(), 2u);
    EXPECT_EQ(json["axes"][0]["states"].back()["state"], "HOMED");
    EXPECT_NEAR(json["axes"][0]["switch_to_index"].get<double>(), 2, 1e-9);
    const std::string picture = homing_picture(out.axes[0]);
    EXPECT_THAT(picture, HasSubstr("SEARCH "));
    EXPECT_THAT(picture, HasSubstr("Axis X is homed, method 4"));
    EXPECT_THAT(picture, testing::Not(HasSubstr("nan")));
}

TEST(RackHomes, EveryTemplateHomesItsAxes) {
    for (const char* name : {"router", "stage", "single"}) {
        Rack rack(config_of(*rack_template(name)));
        rack.start();
        const HomingOutcome out = home_axes(rack, {});
        EXPECT_TRUE(out.ended) << name << ": " << (out.ended ? "" : out.ended.error().message);
    }
}

TEST(RackHomes, ChecksWarnOfAHomingThatWillBeRefused) {
    const RackReading reading = read_rack_text(
        std::string(two_axes) + "[axis.Y.homing]\nsearch_velocity_mm_s = 101\nlatch_velocity_mm_s = 3\n");
    ASSERT_TRUE(reading.config);
    ASSERT_EQ(reading.warnings.size(), 2u);
    EXPECT_THAT(reading.warnings[0].message,
                HasSubstr("search_velocity_mm_s of axis Y is 101, above its max_velocity_mm_s, which is 100"));
    EXPECT_THAT(reading.warnings[1].message,
                HasSubstr("latch_velocity_mm_s of axis Y is 3, above its max_velocity_step_mm_s"));
}

}  // namespace
}  // namespace motionrack::rack
