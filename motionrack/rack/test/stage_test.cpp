// Stages in a rack file: rejected settings with their errors, and loops that run through the bus' frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/grating_card.hpp>
#include <motionrack/rack/part_sections.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wire_access.hpp>

namespace motionrack::rack {
namespace {

using testing::HasSubstr;

const std::string cards = R"(
[card.decoder]
type = "grating_decoder"
scales = 3
[card.host]
type = "grating_bus"
scales = 3
[card.second]
type = "grating_bus"
scales = 3
)";
const std::string good_stage = cards + R"(
[stage.mask]
card = "second"
input = 2
viscous_friction_per_s = 2
[stage.mask.scale]
pitch_um = 5
reversed = true
zero_offset_mm = -1
[stage.mask.servo]
profile = "scan"
from_mm = 0
to_mm = 4
max_velocity_mm_s = 20
max_accel_mm_s2 = 2000
[stage.table]
card = "second"
output = 3
input = 0
start_mm = 7
)";

std::string first_error(const std::string& text) {
    const RackReading reading = read_rack_text(text);
    return reading.errors.empty() ? "none" : reading.errors[0].message;
}

TEST(StageSections, AreReadWithTheirDefaults) {
    const RackReading reading = read_rack_text(good_stage);
    ASSERT_TRUE(reading.config) << reading.errors[0].text();
    ASSERT_EQ(reading.config->stages.size(), 2u);
    const RackStage& mask = reading.config->stages[0];
    EXPECT_EQ(mask.output, 0);
    EXPECT_EQ(mask.scale.interpolation, 4096);
    ASSERT_TRUE(mask.servo);
    EXPECT_EQ(mask.servo->profile, StageProfile::scan);
    EXPECT_EQ(mask.servo->bandwidth_hz, 250);
    EXPECT_FALSE(reading.config->stages[1].servo);
}

TEST(StageSections, ReportInconsistentSettings) {
    const std::string stage = cards + "[stage.mask]\ncard = \"second\"\ninput = 2\n";
    const std::pair<std::string, std::string> cases[] = {
        {cards + "[stage.host]\ncard = \"host\"\ninput = 0\n", "'host' cannot be a stage's name"},
        {cards + "[stage]\nmask = 3\n", "stage.mask is a whole number, but must be a table"},
        {cards + "[stage.mask]\ninput = 0\n", "card"},
        {cards + "[stage.mask]\ncard = \"third\"\ninput = 0\n", "Stage mask: unknown card 'third'."},
        {cards + "[stage.mask]\ncard = \"decoder\"\ninput = 0\n",
         "card decoder is of type grating_decoder; one of type grating_bus drives a stage."},
        {cards + "[stage.mask]\ncard = \"host\"\ninput = 3\n",
         "its scale is number 3, but the decoder has 3 (0 to 2)."},
        {stage + "[stage.other]\ncard = \"second\"\ninput = 1\n", "output 0 of card second drives stage mask already."},
        {stage + "[stage.other]\ncard = \"host\"\ninput = 2\n",
         "scale 2 of the decoder is that of stage mask already."},
        {stage + "start_mm = 2000\n", "it starts at 2000 mm, outside of its travel, -1000 to 1000 mm."},
        {stage + "hard_stop_minus_mm = 5\nhard_stop_plus_mm = 5\n", "the first must be the smaller."},
        {stage + "scale = { interpolation = 6 }\n", "6 counts of a pitch are no multiple of 4"},
        {stage + "scale = { pitch_um = 0.0012345 }\n", "a pitch of 0.0012345 um is not a whole number of picometres"},
        {stage + "scale = { pitch_nm = 5 }\n", "did you mean 'pitch_um'?"},
        {stage + "servo = { control_delay_us = 200 }\n", "computing takes 200 us, but the frame period is 200 us."},
        {stage + "servo = { profile = \"scan\", from_mm = 5, to_mm = 5 }\n",
         "from_mm is 5 and to_mm is 5; from_mm must be below to_mm."},
        {stage + "servo = { profile = \"steps\", step_mm = 0 }\n", "step_mm is 0; it must be other than 0."},
        {stage + "servo = { profile = \"steps\", step_mm = 50, step_period_ms = 100 }\n", "A step of 50 mm takes"},
        {stage + "servo = { profile = \"jump\" }\n", "jump"},
    };
    for (const auto& [text, words] : cases) EXPECT_THAT(first_error(text), HasSubstr(words));
    std::string beyond = cards;
    beyond.replace(beyond.rfind("scales = 3"), 10, "scales = 3\nfirst = 0");
    EXPECT_EQ(first_error(beyond), "none");
}

TEST(StageSections, AreOnTheReferencePage) {
    const std::string page = rack_file_reference();
    for (const std::span<const Field> fields :
         {part_fields("stage.NAME"), part_fields("stage.NAME.scale"), part_fields("stage.NAME.servo")})
        for (const Field& field : fields) {
            EXPECT_THAT(page, HasSubstr('`' + std::string(field.key) + '`'));
            EXPECT_THAT(page, HasSubstr(std::string(field.doc)));
        }
}

struct Running {
    explicit Running(const std::string& text = good_stage) : rack(*read_rack_text(text).config) { rack.start(); }
    double get(const std::string& name) {
        const Result<double> value = get_quantity(rack, name);
        EXPECT_TRUE(value) << value.error().message;
        return value.value_or(0);
    }
    void run(double seconds) {
        const Instant until = rack.kernel().now() + from_seconds(seconds);
        while (rack.kernel().run_until(until) == sim::RunEnd::broken) {  // a card's interrupt
        }
    }
    Rack rack;
};

TEST(StageWires, EachWireOfTheRackCanBeReadInItsUnit) {
    Running r;
    Rack& rack = r.rack;
    WireAccess wires(rack);
    r.run(0.1);
    const std::map<std::string, double> volts = volts_of_wires(rack.config());
    for (std::size_t i = 0; i < rack.kernel().wire_count(); ++i) {
        const auto wire = static_cast<sim::WireId>(i);
        for (std::size_t which = 0; !rack.kernel().wire_name(wire, which).empty(); ++which) {
            const std::string& name = rack.kernel().wire_name(wire, which);
            const Result<double> value = wires.get(name);
            ASSERT_TRUE(value) << value.error().message;
            const auto unit = volts.find(name);
            EXPECT_DOUBLE_EQ(*value, rack.kernel().level(wire) * (unit == volts.end() ? 1 : unit->second)) << name;
        }
    }
    EXPECT_DOUBLE_EQ(*wires.get("mask.drive"), *wires.get("second.vout0"));
    EXPECT_NE(*wires.get("mask.drive"), 0);
    EXPECT_EQ(
        wires.force("mask.scale.a", 1).error().message,
        "mask.scale.a cannot be forced: it is the output of the scale. Force the decoder's input. Nothing was done.");
    EXPECT_TRUE(wires.force("mask.drive", 0));
    EXPECT_EQ(*wires.get("mask.drive"), 0);
}

TEST(RunningStages, FollowTheirProfileThroughTheFrames) {
    Running r;
    EXPECT_EQ(r.get("table.position_mm"), 7);
    EXPECT_NEAR(r.get("mask.position_mm"), r.get("mask.wanted_mm"), 1e-9) << "it stands where its profile begins";
    r.run(0.5);
    EXPECT_EQ(r.get("mask.closed"), 1);
    EXPECT_LT(r.get("mask.following_peak_nm"), 50);
    EXPECT_NEAR(r.get("mask.position_mm"), r.get("mask.wanted_mm"), 1e-4);
    EXPECT_NEAR(r.get("mask.scale_mm"), r.get("mask.position_mm"), 3e-6);
    EXPECT_LT(r.get("mask.scale_counts"), 0) << "reversed";
    EXPECT_NEAR(std::fabs(r.get("mask.speed_mm_s")), 20, 1);
    EXPECT_NE(r.get("mask.drive_v"), 0);
    EXPECT_EQ(r.get("mask.unused_frames"), 0);
    EXPECT_EQ(r.get("table.position_mm"), 7);
    EXPECT_THAT(get_quantity(r.rack, "table.closed").error().message,
                HasSubstr("Stage table has no quantity 'closed'; it has: position_mm"));
    EXPECT_THAT(get_quantity(r.rack, "chair.closed").error().message, HasSubstr("mask, table"));
}

TEST(RunningStages, FaultsOfMotorAndScaleOpenTheLoop) {
    Running r;
    r.run(0.1);
    EXPECT_THAT(inject_fault(r.rack, "scale.bent", "mask").error().message, HasSubstr("scale.expansion"));
    ASSERT_TRUE(inject_fault(r.rack, "scale.lose=100000", "mask"));
    EXPECT_EQ(r.get("mask.trusted"), 0);
    EXPECT_EQ(r.get("mask.lost_counts"), 100'000);
    r.run(0.01);
    EXPECT_EQ(r.get("mask.closed"), 0) << "122 um are more than its limit";
    EXPECT_EQ(r.get("mask.drive_v"), 0);
    ASSERT_TRUE(inject_fault(r.rack, "motor.push=2000000", "table"));
    EXPECT_NEAR(r.get("table.position_mm"), 9, 1e-6);
    const auto conditions = r.rack.kernel().conditions();
    ASSERT_FALSE(conditions.empty());
    ASSERT_EQ(conditions.size(), 2u);
    EXPECT_THAT(r.rack.describe(conditions[0]),
                HasSubstr("scale mask: at 0.100000 s it counts again and has lost 100000 counts"));
    EXPECT_THAT(r.rack.describe(conditions[1]),
                HasSubstr("nm, more than max_following_error_um = 100; card second opened its loop: 0 V"));
    EXPECT_FALSE(inject_fault(r.rack, "motor.load=-1", "table"));
}

TEST(RunningStages, NoFramesForTwoPeriodsOpenTheLoops) {
    Running r;
    r.run(0.1);
    ASSERT_TRUE(inject_fault(r.rack, "off", "host"));
    r.run(0.001);
    EXPECT_EQ(r.get("mask.closed"), 0);
    EXPECT_EQ(r.rack.stage("mask")->loop()->state(), grating_bus::LoopState::stale);
    std::string reported;
    for (const sim::Condition& condition : r.rack.kernel().conditions()) reported += r.rack.describe(condition) + "\n";
    EXPECT_THAT(reported, HasSubstr("card second had no frame for two periods and opened its loop"));
    EXPECT_EQ(r.get("mask.drive_v"), 0);
}

TEST(RunningStages, ARestoredSnapshotContinuesIdentically) {
    Running r;
    r.run(0.1234);
    const sim::Snapshot snapshot = r.rack.kernel().snapshot();
    std::uint64_t hashes[2] = {};
    double places[2] = {};
    for (int i = 0; i < 2; ++i) {
        r.rack.kernel().restore(snapshot);
        r.run(0.2);
        hashes[i] = r.rack.kernel().state_hash();
        places[i] = r.get("mask.position_mm");
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(places[0], places[1]);
}

}  // namespace
}  // namespace motionrack::rack
