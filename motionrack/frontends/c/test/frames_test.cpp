// Frames of a grating bus over the C interface.
#include <gmock/gmock.h>

#include <cstring>

#include "world.hpp"

namespace motionrack::c_test {
namespace {

using testing::HasSubstr;

constexpr const char* two_cards =
    "[card.c1]\ntype = \"grating_bus\"\naddresses = \"5, 2, 9\"\n"
    "[card.c2]\ntype = \"grating_bus\"\naddresses = \"5, 2, 9\"\n[card.m]\ntype = \"mcx314\"\n";

mr_frame marked() {
    mr_frame out{};
    out.sequence = 77;
    return out;
}

TEST(CFrames, AreTheSameFromEveryCardWithTheAddressOfEachWord) {
    World world(two_cards);
    mr_frame host = marked(), slave = marked();
    ASSERT_EQ(mr_frame_wait(world, "c2", 1'000'000, &slave), MR_OK) << mr_last_error();
    ASSERT_EQ(mr_frame_read(world, "c1", &host), MR_OK) << mr_last_error();
    EXPECT_EQ(std::memcmp(&host, &slave, sizeof host), 0);
    EXPECT_EQ(slave.sequence, 0u);
    EXPECT_EQ(slave.time_100ps, 0);
    ASSERT_EQ(slave.words, 3u);
    EXPECT_EQ(slave.addresses[0], 5);
    EXPECT_EQ(slave.addresses[2], 9);
    ASSERT_EQ(mr_frame_wait(world, "c2", 1'000'000, &slave), MR_OK) << mr_last_error();
    EXPECT_EQ(slave.sequence, 1u) << "the next one, not the same once more";
    EXPECT_LT(mr_now_ns(world), 203'000u) << "it does not wait longer than it must";
}

TEST(CFrames, MissingAndStaleOnesAreRejectedWithoutChangingTheBuffer) {
    World world(two_cards);
    mr_frame frame = marked();
    EXPECT_EQ(mr_frame_read(world, "c2", &frame), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("no frame yet"));
    world.pass(100'000);
    ASSERT_EQ(mr_fault(world, "off", "c1"), MR_OK) << mr_last_error();
    EXPECT_EQ(mr_frame_wait(world, "c2", 0, &frame), MR_OK) << "there was one that was not read";
    EXPECT_EQ(frame.sequence, 0u);
    frame = marked();
    EXPECT_EQ(mr_frame_wait(world, "c2", 500'000, &frame), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("within 500 us"));
    EXPECT_GE(mr_now_ns(world), 600'000u);
    EXPECT_EQ(mr_frame_read(world, "c2", &frame), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("stale"));
    EXPECT_EQ(frame.sequence, 77u);
}

TEST(CFrames, PositionsBelowZeroAreNegative) {
    World world(
        "[card.dec]\ntype = \"grating_decoder\"\nscales = 1\n[card.host]\ntype = \"grating_bus\"\nscales = 1\n"
        "[stage.SX]\ncard = \"host\"\ninput = 0\nstart_mm = -1\n");
    mr_frame frame = marked();
    ASSERT_EQ(mr_frame_wait(world, "host", 1'000'000, &frame), MR_OK) << mr_last_error();
    EXPECT_LT(frame.counts[0], -1'000);
    EXPECT_GT(frame.counts[0], -10'000'000);
}

TEST(CFrames, InvalidCallsAreRejectedAndChangeNothing) {
    World world(two_cards);
    mr_frame frame = marked();
    const std::uint64_t before = world.hash();
    EXPECT_EQ(mr_frame_read(nullptr, "c1", &frame), MR_BAD_CALL);
    EXPECT_EQ(mr_frame_read(world, nullptr, &frame), MR_BAD_CALL);
    EXPECT_EQ(mr_frame_read(world, "c1", nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_frame_read(world, "c9", &frame), MR_BAD_CALL);
    EXPECT_EQ(mr_frame_read(world, "m", &frame), MR_BAD_CALL);
    EXPECT_THAT(mr_last_error(), HasSubstr("Card m is a mcx314, which has no frames"));
    EXPECT_EQ(mr_frame_wait(nullptr, "c1", 1, &frame), MR_BAD_CALL);
    EXPECT_EQ(mr_frame_wait(world, "c1", 1'000'000'000'000'001, &frame), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("1000000000000001 ns"));
    EXPECT_EQ(world.hash(), before);
    EXPECT_EQ(frame.sequence, 77u);
}

TEST(CFrames, ARecordingContinuesDuringAWaitForAFrame) {
    const std::string csv = temporary("frames.csv");
    World world(two_cards);
    ASSERT_EQ(mr_trace_start(world, csv.c_str(), "bus.read_n"), MR_OK) << mr_last_error();
    mr_frame frame{};
    for (int i = 0; i < 20; ++i) ASSERT_EQ(mr_frame_wait(world, "c2", 1'000'000, &frame), MR_OK) << mr_last_error();
    EXPECT_EQ(frame.sequence, 19u);
    ASSERT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    const std::string text = text_of_file(csv);
    std::size_t pulses = 0;
    for (std::size_t at = 0; (at = text.find(",bus.read_n,0\r\n", at)) != std::string::npos; ++at) ++pulses;
    EXPECT_EQ(pulses, 60u) << "a pulse of READ for each scale of each frame";
    std::filesystem::remove(csv);
}

}  // namespace
}  // namespace motionrack::c_test
