// The grating bus in a rack: cards and decoder from a file, axes as scales, faults, agreement.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/rack/frame_monitor.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/test/config_helpers.hpp>

namespace motionrack::rack {
namespace {

namespace gb = grating_bus;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* three_cards =
    "[card.decoder]\ntype = \"grating_decoder\"\n[card.c1]\ntype = \"grating_bus\"\n[card.c2]\ntype = \"grating_bus\"\n"
    "[card.c3]\ntype = \"grating_bus\"\n";

std::unique_ptr<Session> open(const std::string& text) {
    auto out = Session::open(text);
    EXPECT_TRUE(out) << (out ? "" : out.error().message);
    return std::move(*out);
}

/// Turns scale `n` of the decoder forward by a number of counts.
void turn(Session& session, int n, int counts) {
    for (int i = 0; i < counts; ++i) {
        const bool a = i % 2 == 0;
        ASSERT_TRUE(session.set_wire(std::string("decoder.") + (a ? "a" : "b") + std::to_string(n), i % 4 < 2));
        ASSERT_TRUE(session.advance(1'000));
    }
}

std::uint32_t count_read(Session& session, const char* card, int k) {
    const auto low = session.read(card, 16, gb::counts_at + 4u * static_cast<unsigned>(k));
    const auto high = session.read(card, 16, gb::counts_at + 4u * static_cast<unsigned>(k) + 2);
    EXPECT_TRUE(low && high);
    return *high << 16 | *low;
}

TEST(GratingBusInARack, EveryCardHoldsWhatTheDecoderCounts) {
    auto session = open(three_cards);
    turn(*session, 1, 40);
    turn(*session, 3, 7);
    ASSERT_TRUE(session->advance(400'000));
    for (const char* card : {"c1", "c2", "c3"}) {
        EXPECT_EQ(*session->peek(card, "1.COUNT"), 40);
        EXPECT_EQ(*session->peek(card, "3.COUNT"), 7);
        ASSERT_TRUE(session->write(card, 16, gb::offset("CONTROL"), 1));
        EXPECT_EQ(count_read(*session, card, 1), 40u);
        EXPECT_EQ(*session->read(card, 16, gb::offset("WORDS")), 4u);
    }
    EXPECT_EQ(*session->peek("c2", "SEQUENCE"), *session->peek("c1", "SEQUENCE"));
    EXPECT_EQ(*session->peek("decoder", "1.COUNT"), 40);
    EXPECT_EQ(count_read(*session, "decoder", 1), 40u);
    EXPECT_FALSE(session->read("c1", 16, gb::counts_at + 16)) << "there are four scales";
    EXPECT_EQ(*session->part("c3.stale"), 0);
}

TEST(GratingBusInARack, ACardAloneHasADecoderOfItsOwn) {
    auto session = open("card.c1 = \"grating_bus\"");
    turn(*session, 0, 12);
    ASSERT_TRUE(session->advance(400'000));
    EXPECT_EQ(*session->peek("c1", "0.COUNT"), 12);
    EXPECT_EQ(*session->peek("c1", "ROLE"), 15) << "host, both shifters outwards, checks";
}

TEST(GratingBusInARack, AcceptsForcedBusLinesAndFaultsOfCards) {
    auto session = open(three_cards);
    ASSERT_TRUE(session->advance(1'000'000));
    ASSERT_TRUE(session->set_wire("bus.read_n", 1));
    ASSERT_TRUE(session->advance(600'000));
    EXPECT_EQ(*session->part("c2.stale"), 1);
    EXPECT_GT(*session->peek("c2", "MISSED_WORDS"), 0);
    ASSERT_TRUE(session->set_wire("bus.read_n", std::nan("")));
    ASSERT_TRUE(session->advance(400'000));
    EXPECT_EQ(*session->part("c2.stale"), 0);
    ASSERT_TRUE(session->fault("off", "c1"));
    ASSERT_TRUE(session->advance(600'000));
    EXPECT_EQ(*session->part("c3.stale"), 1);
    EXPECT_FALSE(session->fault("late", "c1")) << "a host is not late";
    EXPECT_TRUE(session->fault("no_latch", "decoder"));
}

TEST(GratingBusInARack, RejectsContradictingSettingsWithTheirPosition) {
    const auto errors = [](const std::string& text) {
        const RackReading reading = read_rack_text(text, "r.toml");
        return reading.errors.empty() ? std::string() : reading.errors[0].text();
    };
    EXPECT_THAT(errors("[card.d]\ntype = \"grating_decoder\"\n[card.c1]\ntype = \"grating_bus\"\nscales = 5\n"),
                AllOf(HasSubstr("r.toml:4"), HasSubstr("scales 0 to 4, but the decoder has 4")));
    EXPECT_THAT(errors("[card.c1]\ntype = \"grating_bus\"\nscales = 128\nperiod_us = 12\n"),
                AllOf(HasSubstr("r.toml:3"), HasSubstr("14090.0 ns")));
    EXPECT_THAT(errors("[card.c1]\ntype = \"grating_bus\"\n[card.c2]\ntype = \"grating_bus\"\nscales = 3\n"),
                HasSubstr("all cards of a bus read the same number"));
    EXPECT_THAT(errors("[card.d]\ntype = \"grating_decoder\"\n[card.e]\ntype = \"grating_decoder\"\n"),
                HasSubstr("two decoders"));
    EXPECT_THAT(errors(std::string(three_cards) + "[wires]\n\"decoder.a4\" = \"estop\"\n"), HasSubstr("decoder.a4"));
}

TEST(GratingBusInARack, AListOfAddressesIsReadInItsOrder) {
    const std::string list = "type = \"grating_bus\"\naddresses = \"5, 2, 9\"\n";
    auto session = open("[card.c1]\n" + list + "[card.c2]\n" + list);
    turn(*session, 9, 7);
    turn(*session, 2, 40);
    ASSERT_TRUE(session->advance(400'000));
    for (const char* card : {"c1", "c2"}) {
        EXPECT_EQ(*session->peek(card, "SCALES"), 3);
        EXPECT_EQ(*session->read(card, 16, gb::list_at), 5u);
        EXPECT_EQ(*session->read(card, 16, gb::list_at + 4), 9u);
        EXPECT_FALSE(session->read(card, 16, gb::list_at + 6)) << "there are three scales";
        EXPECT_EQ(*session->peek(card, "0.COUNT"), 0);
        EXPECT_EQ(*session->peek(card, "1.COUNT"), 40);
        EXPECT_EQ(*session->peek(card, "2.COUNT"), 7);
    }
}

TEST(GratingBusInARack, ASlaveHoldsTheScalesThatItsHostAddresses) {
    const RackReading reading = read_rack_text(
        "[card.c1]\ntype = \"grating_bus\"\naddresses = \"5, 2, 9\"\n"
        "[card.c2]\ntype = \"grating_bus\"\nscales = 3\n[card.d]\ntype = \"grating_decoder\"\nscales = 10\n");
    ASSERT_TRUE(reading.config) << reading.errors[0].text();
    Rack rack(*reading.config);
    FrameMonitor watch(rack);
    rack.start();
    while (rack.kernel().run_until(milliseconds(1)) == sim::RunEnd::broken) {
    }
    for (const FrameRow& row : watch.rows()) {
        EXPECT_GE(row.frames, 5u);
        EXPECT_EQ(row.untrue + row.unlike + row.broken, 0u);
        EXPECT_TRUE(row.agrees);
        EXPECT_EQ(row.frame->addresses[2], 9);
    }
    EXPECT_EQ(*rack.card("c2")->inspect("1.ADDRESS"), 2);
    EXPECT_FALSE(rack.card("c2")->inspect("3.ADDRESS"));
}

TEST(GratingBusInARack, AWrongListIsRefusedWithItsLocation) {
    const auto errors = [](const std::string& keys) {
        const RackReading reading = read_rack_text("[card.c1]\ntype = \"grating_bus\"\n" + keys, "r.toml");
        return reading.errors.empty() ? std::string() : reading.errors[0].text();
    };
    EXPECT_EQ(errors("addresses = \"5, 2, 9\"\n"), "");
    EXPECT_EQ(errors("addresses = \"5, 2, 9\"\nscales = 3\n"), "") << "the same, said twice";
    EXPECT_THAT(errors("addresses = \"5, 2, 5\"\n"), AllOf(HasSubstr("r.toml:3"), HasSubstr("the address 5 twice")));
    EXPECT_THAT(errors("addresses = \"5 2\"\n"), HasSubstr("must be a comma"));
    EXPECT_THAT(errors("addresses = \"5, 2\"\nscales = 3\n"), HasSubstr("leave those two out"));
    EXPECT_THAT(errors("addresses = \"5, 2\"\nfirst = 1\n"), HasSubstr("leave those two out"));
    EXPECT_THAT(errors("addresses = \"5, 2\"\n[card.d]\ntype = \"grating_decoder\"\n"),
                HasSubstr("the scales 5, 2, but the decoder has 4"));
}

TEST(GratingBusInARack, HostsWithDifferentAddressListsContendForTheAddress) {
    auto session = open(
        "[card.c1]\ntype = \"grating_bus\"\nrole = \"host\"\naddresses = \"1, 2\"\n"
        "[card.c2]\ntype = \"grating_bus\"\nrole = \"host\"\naddresses = \"2, 1\"\n");
    ASSERT_TRUE(session->advance(1'000'000));
    EXPECT_EQ(*session->part("c1.sequence"), -1) << "no frame";
    EXPECT_GT(*session->peek("c1", "ALIEN"), 0);
}

constexpr const char* router_with_bus = R"(
[card.motion]
type = "mcx314"
[card.decoder]
type = "grating_decoder"
scales = 2
[card.c1]
type = "grating_bus"
scales = 2
[card.c2]
type = "grating_bus"
scales = 2
[axis.X]
card = "motion"
channel = "x"
[axis.Y]
card = "motion"
channel = "y"
[wires]
"decoder.a0" = "X.enc_a"
"decoder.b0" = "X.enc_b"
"decoder.a1" = "Y.enc_a"
"decoder.b1" = "Y.enc_b"
)";

TEST(GratingBusInARack, AxesThatAPartProgramDrivesAreReadByAllCards) {
    const RackReading reading = read_rack_text(router_with_bus);
    ASSERT_TRUE(reading.config) << reading.errors[0].text();
    Rack rack(*reading.config);
    FrameMonitor watch(rack);
    JobSettings settings;
    settings.program = "G21 G90\nG1 X12 Y5 F3000\nG1 X3\nM2\n";
    Job job(rack, settings);
    rack.start();
    const JobOutcome outcome = job.run();
    ASSERT_TRUE(outcome.ended) << outcome.ended.error().message;
    while (rack.kernel().run_until(rack.kernel().now() + milliseconds(1)) == sim::RunEnd::broken) {
    }
    const auto rows = watch.rows();
    ASSERT_EQ(rows.size(), 2u);
    for (const FrameRow& row : rows) {
        EXPECT_GT(row.frames, 1000u);
        EXPECT_EQ(row.untrue, 0u);
        EXPECT_EQ(row.unlike, 0u);
        EXPECT_TRUE(row.agrees);
        EXPECT_EQ(static_cast<std::int32_t>(row.frame->counts[0]), 3 * 4000 / 5);
        EXPECT_EQ(static_cast<std::int32_t>(row.frame->counts[1]), 5 * 4000 / 5);
    }
}

TEST(GratingBusInARack, AFrameIsDrawnWithAllItsStatesAndLines) {
    const RackReading reading = read_rack_text(three_cards);
    const auto picture = frame_picture(*reading.config);
    ASSERT_TRUE(picture);
    for (const char* text : {"S1<", "S9<", "read_n", "word 3", "450 ns", "conflict"})
        EXPECT_THAT(*picture, HasSubstr(text));
    EXPECT_FALSE(frame_picture(*read_rack_text("card.m = \"mcx314\"").config));
}

}  // namespace
}  // namespace motionrack::rack
