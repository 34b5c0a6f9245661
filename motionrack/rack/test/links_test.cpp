// Pulses and encoder tracks in the rack file: the wires determine which motor turns and which input counts; other
// wiring is rejected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/job.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/test/config_helpers.hpp>

namespace motionrack::rack {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string second_axis = "[axis.A]\ncard = \"m\"\nchannel = \"u\"\n";

std::string wired(const std::string& wires) {
    return rack_with("[wires]\n" + wires);
}

TEST(Links, FollowTheDefaultRule) {
    const RackConfig config = good(rack_with(second_axis));
    EXPECT_THAT(config.pulse_links, ElementsAre(PulseLink{0, 0, 0}, PulseLink{1, 0, 3}));
    EXPECT_THAT(config.encoder_links, ElementsAre(EncoderLink{0, 0, 0, false}, EncoderLink{1, 0, 3, false}));
    EXPECT_THAT(good(rack_with("encoder_counts_per_rev = 0\n")).encoder_links, IsEmpty());
}

TEST(Links, FollowTheFile) {
    const RackConfig moved = good(wired("\"X.step\" = \"m.upp\"\n\"X.dir\" = \"m.upm\"\n"));
    EXPECT_THAT(moved.pulse_links, ElementsAre(PulseLink{0, 0, 3}));
    EXPECT_THAT(good(wired("X.step = \"open\"\n")).pulse_links, IsEmpty());
    EXPECT_THAT(good(wired("m.xeca = \"open\"\nm.xecb = \"open\"\n")).encoder_links, IsEmpty());
    const RackConfig crossed = good(wired("m.xeca = \"X.enc_b\"\nm.xecb = \"X.enc_a\"\n"));
    EXPECT_THAT(crossed.encoder_links, ElementsAre(EncoderLink{0, 0, 0, true}));
    const RackConfig twice = good(wired("m.yeca = \"X.enc_a\"\nm.yecb = \"X.enc_b\"\n"));
    EXPECT_THAT(twice.encoder_links, ElementsAre(EncoderLink{0, 0, 0, false}, EncoderLink{0, 0, 1, false}));
}

struct BadWires {
    std::string wires;
    TextPosition location;
    std::vector<std::string> words;
};

TEST(Links, RejectsImpossibleWiringBeforeAnythingMoves) {
    const std::vector<BadWires> cases = {
        {"X.step = \"m.xout0\"\n", {7, 3}, {"X.step cannot be driven by m.xout0", "m.xpp", "open"}},
        {"X.step = \"m.xpm\"\nX.dir = \"m.xpp\"\n", {7, 3}, {"X.step cannot be driven by m.xpm"}},
        {"X.step = \"X.enc_z\"\n", {7, 3}, {"X.step cannot be driven by X.enc_z"}},
        {"X.step = \"m.upp\"\n", {7, 3}, {"X.step is driven by m.upp and X.dir by m.xpm", "\"X.dir\" = \"m.upm\""}},
        {"X.dir = \"open\"\n", {7, 3}, {"X.dir is open", "\"X.dir\" = \"m.xpm\""}},
        {"X.dir = \"m.xout4\"\n", {7, 3}, {"X.dir by m.xout4"}},
        {"m.xin1 = \"X.enc_a\"\n", {7, 3}, {"m.xin1 cannot be driven by X.enc_a", "m.xeca and m.xecb"}},
        {"m.xeca = \"open\"\n", {7, 3}, {"m.xecb is driven by X.enc_b but m.xeca is open", "open"}},
        {"m.xecb = \"m.xout0\"\n", {7, 3}, {"m.xecb is driven by m.xout0"}},
        {"m.xecb = \"X.enc_a\"\n", {7, 3}, {"m.xecb is driven by X.enc_a", "\"m.xecb\" = \"X.enc_b\""}},
    };
    for (const BadWires& bad : cases) {
        const RackReading reading = read_rack_text(wired(bad.wires));
        EXPECT_FALSE(reading.config) << bad.wires;
        ASSERT_EQ(reading.errors.size(), 1u) << all_texts(reading.errors) << bad.wires;
        EXPECT_EQ(reading.errors[0].location, bad.location) << reading.errors[0].text() << bad.wires;
        for (const std::string& word : bad.words) EXPECT_THAT(reading.errors[0].message, HasSubstr(word)) << bad.wires;
    }
}

TEST(Links, AnAxisWithoutItsChannelOrCardIsAnExampleOfTheFirstOne) {
    const RackReading no_channel =
        read_rack_text("[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\n[wires]\nX.step = \"m.xout0\"\n");
    EXPECT_FALSE(no_channel.config);
    EXPECT_THAT(all_texts(no_channel.errors), HasSubstr("such as m.xpp"));
    const RackReading no_card =
        read_rack_text("[axis.X]\ncard = \"m\"\nchannel = \"x\"\n[wires]\nX.step = \"X.enc_z\"\n");
    EXPECT_FALSE(no_card.config);
    EXPECT_THAT(all_texts(no_card.errors), HasSubstr("does not have"));
}

TEST(Links, OneChannelDrivesOneMotor) {
    const RackReading reading =
        read_rack_text(rack_with(second_axis + "[wires]\nX.step = \"m.upp\"\nX.dir = \"m.upm\"\n"));
    ASSERT_EQ(reading.errors.size(), 1u) << all_texts(reading.errors);
    EXPECT_EQ(reading.errors[0].location, (TextPosition{10, 3}));
    EXPECT_THAT(reading.errors[0].message, HasSubstr("m.upp drives X.step and A.step"));
}

TEST(Links, AnEncoderLeadsToSixChannels) {
    std::string text = rack_with("[card.n]\ntype = \"mcx314\"\n[wires]\n");
    for (const char* pin : {"m.y", "m.z", "m.u", "n.x", "n.y", "n.z"})
        text += fmt::format("{0}eca = \"X.enc_a\"\n{0}ecb = \"X.enc_b\"\n", pin);
    const RackReading reading = read_rack_text(text);
    ASSERT_EQ(reading.errors.size(), 1u) << all_texts(reading.errors);
    EXPECT_THAT(reading.errors[0].message, HasSubstr("n.zeca would be input number 7"));
}

TEST(Wires, OneOutputDrivesThirtyOneInputs) {
    std::string text = rack_with("[axis.X.switches]\nhome_mm = 1\n[card.n]\ntype = \"mcx314\"\n[wires]\n");
    int inputs = 1;  // m.xin0, by the default rule
    for (const char channel : {'x', 'y', 'z', 'u'})
        for (const char* pin : {"in0", "in1", "in2", "in3", "alarm", "inpos", "expp", "expm"})
            if (inputs < 31) text += fmt::format("n.{}{} = \"X.home\"\n", channel, pin), ++inputs;
    Rack rack(good(text));
    rack.start();
    const RackReading reading = read_rack_text(text + "n.emgn = \"X.home\"\n");
    ASSERT_EQ(reading.errors.size(), 1u) << all_texts(reading.errors);
    EXPECT_THAT(reading.errors[0].message, HasSubstr("X.home drives more than 31 inputs"));
    EXPECT_GT(reading.errors[0].location.line, 8);
}

// ---- On a running rack

struct Ended {
    std::unique_ptr<Rack> rack;
    JobOutcome outcome;
};

/// Moves X to 10 mm and A to 20 degrees.
Ended run_wires(const std::string& wires, bool watched = true) {
    Ended out;
    RackConfig config = good(rack_with(second_axis + "[wires]\n" + wires));
    for (RackAxis& axis : config.axes)
        if (!watched) axis.following_error_alarm = 0;
    out.rack = std::make_unique<Rack>(config);
    JobSettings settings;
    settings.program = "G21 G90\nG1 X10 F600\nG1 A20\nM2\n";
    Job job(*out.rack, settings);
    out.rack->start();
    out.outcome = job.run();
    return out;
}

TEST(Rack, AJobRunsOverAnEightBitBus) {
    std::string text = rack_with("");
    text.replace(text.find("[axis"), 0, "bus = \"8-bit\"\n");
    Rack rack(good(text));
    JobSettings settings;
    settings.program = "G21 G90 F600\nG1 X10\nG0 X2\nM2\n";
    Job job(rack, settings);
    rack.start();
    const JobOutcome outcome = job.run();
    ASSERT_TRUE(outcome.ended) << outcome.ended.error().text();
    EXPECT_EQ(outcome.axes[0].actual_end, 2);
    EXPECT_TRUE(outcome.position_valid);
}

TEST(Links, AnOpenStepInputKeepsTheMotorAtStandstillAndTheJobReportsIt) {
    const Ended ended = run_wires("X.step = \"open\"\n", false);
    EXPECT_TRUE(ended.outcome.ended);
    const AxisOutcome& x = ended.outcome.axes[0];
    EXPECT_EQ(x.pulses_sent, 6400);
    EXPECT_EQ(x.actual_end, 0);
    EXPECT_EQ(x.encoder_counts, 0);
    EXPECT_EQ(x.lost_pulses, 6400);
    EXPECT_FALSE(ended.outcome.position_valid);
    EXPECT_EQ(ended.outcome.axes[1].actual_end, 20);
}

TEST(Links, AnOpenStepInputStopsTheJobWhereTheFollowingErrorIsWatched) {
    const Ended ended = run_wires("X.step = \"open\"\n");
    ASSERT_FALSE(ended.outcome.ended);
    EXPECT_THAT(ended.outcome.ended.error().message, HasSubstr("The following error of X was"));
}

TEST(Links, ThePulsesOfAnotherChannelDriveTheMotor) {
    const Ended ended =
        run_wires("X.step = \"m.upp\"\nX.dir = \"m.upm\"\nA.step = \"m.xpp\"\nA.dir = \"m.xpm\"\n", false);
    EXPECT_TRUE(ended.outcome.ended);
    // The 16,000 pulses of 20 degrees move X at 640 pulses per mm; the 6400 pulses of 10 mm move A at 800 per degree.
    EXPECT_EQ(ended.outcome.axes[0].actual_end, 25);
    EXPECT_EQ(ended.outcome.axes[1].actual_end, 8);
    EXPECT_FALSE(ended.outcome.position_valid);
}

TEST(Links, SwappedTracksCountBackwardsAndOpenOnesNotAtAll) {
    const Ended crossed = run_wires("m.xeca = \"X.enc_b\"\nm.xecb = \"X.enc_a\"\n");
    EXPECT_EQ(crossed.outcome.axes[0].encoder_counts, -8000);
    EXPECT_EQ(crossed.outcome.axes[0].actual_end, 10);
    EXPECT_TRUE(crossed.outcome.position_valid);
    const Ended open = run_wires("m.xeca = \"open\"\nm.xecb = \"open\"\n");
    EXPECT_EQ(open.outcome.axes[0].encoder_counts, 0);
    EXPECT_EQ(open.outcome.axes[1].encoder_counts, 20000);
}

/// A comparison of the crossed encoder stops the drive at count -2000.
TEST(Links, WatchedRangesOfASwappedEncoderNotifyAtTheInvertedCount) {
    struct RecordingListener final : sim::PositionListener {
        void crossed(Instant) override { ++times; }
        void rate_changed(double, double rate, Instant) override { last_rate = rate; }
        int times = 0;
        double last_rate = 0;
    };
    const RackConfig config = good(rack_with(""));
    Rack rack(config);
    InvertedPosition mirrored(rack.axes()[0].machine->encoder());
    RecordingListener listener;
    const int slot = mirrored.add_listener(listener);
    JobSettings settings;
    settings.program = "G21 G90\nG1 X10 F600\nM2\n";
    Job job(rack, settings);
    rack.start();
    mirrored.watch(slot, -2000, sim::unwatched_above);
    EXPECT_TRUE(job.run().ended);
    EXPECT_EQ(listener.times, 1);
    EXPECT_EQ(mirrored.count(rack.kernel().now()), -8000);
    mirrored.watch(slot, sim::unwatched_below, -7000);
    EXPECT_TRUE(rack.kernel().run_until(rack.kernel().now() + milliseconds(1)) == sim::RunEnd::reached);
    EXPECT_EQ(listener.times, 1);
    mirrored.watch(slot, sim::unwatched_below, -8000);
    rack.kernel().run_until(rack.kernel().now() + milliseconds(1));
    EXPECT_EQ(listener.times, 2);
    EXPECT_EQ(listener.last_rate, 0);
}

}  // namespace
}  // namespace motionrack::rack
