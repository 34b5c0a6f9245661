// Tests of the frame: its CRC, its comparisons and its reading time.
#include <gtest/gtest.h>

#include <motionrack/cards/grating_bus/map.hpp>

namespace motionrack::grating_bus {
namespace {

Frame example() {
    Frame frame;
    frame.time = 2'000'000;
    frame.sequence = 7;
    frame.words = 3;
    frame.counts[0] = 1;
    frame.counts[1] = 0xFFFFFFFF;
    frame.counts[2] = 123'456'789;
    frame.addresses = {5, 2, 9};
    frame.crc = crc_of(frame);
    return frame;
}

TEST(GratingFrame, FindsAScaleByItsAddress) {
    const Frame frame = example();
    EXPECT_EQ(word_of(frame, 2), 1u);
    EXPECT_EQ(word_of(frame, 9), 2u);
    EXPECT_EQ(word_of(frame, 0), std::nullopt) << "what is beyond its words is none of it";
    Frame other = frame;
    other.addresses = {5, 9, 2};
    EXPECT_FALSE(same(frame, other));
}

TEST(GratingFrame, IsValidWithItsOwnCrcOnly) {
    Frame frame = example();
    EXPECT_TRUE(sound(frame));
    frame.counts[1] ^= 1u << 20;
    EXPECT_FALSE(sound(frame));
    frame = example();
    ++frame.sequence;
    EXPECT_FALSE(sound(frame));
    frame = example();
    frame.addresses[2] ^= 1;
    EXPECT_FALSE(sound(frame)) << "which scale it is is covered, too";
    frame.addresses[2] = 128;
    frame.crc = crc_of(frame);
    EXPECT_FALSE(sound(frame)) << "seven lines have no such address";
    frame = example();
    frame.words = 0;
    frame.crc = crc_of(frame);
    EXPECT_FALSE(sound(frame)) << "a frame has one scale at least";
    frame.words = 129;
    EXPECT_FALSE(sound(frame));
}

TEST(GratingFrame, IsTheSameWhateverIsBeyondItsWords) {
    Frame a = example(), b = example();
    b.counts[3] = 99;
    EXPECT_TRUE(same(a, b));
    EXPECT_EQ(crc_of(a), crc_of(b));
    b.time += 1;
    EXPECT_FALSE(same(a, b));
}

TEST(GratingFrame, HasTheDurationThatTheSourceStates) {
    constexpr BusTiming timing;
    EXPECT_EQ(timing.frame_time(4), nanoseconds(450));
    EXPECT_EQ(timing.frame_time(8), nanoseconds(890));
    EXPECT_EQ(timing.frame_time(16), nanoseconds(1770));
    EXPECT_EQ(timing.sample_at(0), nanoseconds(50));
    EXPECT_EQ(timing.sample_at(3), nanoseconds(3 * 110 + 50));
}

TEST(GratingFrame, CountsAreExtendedAcrossTheWrap) {
    EXPECT_EQ(unwrapped(0xFFFFFFFF, 0), 0x100000000);
    EXPECT_EQ(unwrapped(0, 0xFFFFFFFF), -1);
    EXPECT_EQ(unwrapped(-1, 5), 5);
    EXPECT_EQ(unwrapped(0x2'0000'0010, 0xFFFFFFF0), 0x1'FFFF'FFF0);
}

}  // namespace
}  // namespace motionrack::grating_bus
