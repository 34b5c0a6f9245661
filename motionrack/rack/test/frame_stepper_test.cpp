// Steps a rack from frame to frame of a card.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/frame_stepper.hpp>
#include <motionrack/rack/template.hpp>

namespace motionrack::rack {
namespace {

constexpr const char* two_cards = R"(
[card.host]
type = "grating_bus"
scales = 6
period_us = 250
[card.scan]
type = "grating_bus"
scales = 6
period_us = 250
)";

TEST(FrameStepper, ReturnsEveryFrameOfTheHost) {
    Rack rack(*read_rack_text(two_cards).config);
    const auto tap = FrameStepper::create(rack, "");
    ASSERT_TRUE(tap) << tap.error().text();
    EXPECT_TRUE((*tap)->card().is_host());
    EXPECT_EQ((*tap)->period(), microseconds(250));
    rack.start();
    grating_bus::Frame frame;
    for (std::uint32_t n = 0; n < 100; ++n) {
        (*tap)->next(frame, nullptr);
        ASSERT_TRUE(sound(frame)) << n;
        EXPECT_EQ(frame.words, 6u);
        EXPECT_EQ(frame.sequence, n);
        EXPECT_EQ(frame.instant(), n * microseconds(250));
    }
}

TEST(FrameStepper, ReturnsTheFramesOfASlave) {
    Rack rack(*read_rack_text(two_cards).config);
    const auto tap = FrameStepper::create(rack, "scan");
    ASSERT_TRUE(tap) << tap.error().text();
    EXPECT_FALSE((*tap)->card().is_host());
    rack.start();
    grating_bus::Frame frame;
    for (std::uint32_t n = 0; n < 10; ++n) {
        (*tap)->next(frame, nullptr);
        EXPECT_EQ(frame.sequence, n);
    }
}

TEST(FrameStepper, ContinuesWhileTheHostIsOff) {
    Rack rack(*read_rack_text(two_cards).config);
    const auto tap = FrameStepper::create(rack, "");
    ASSERT_TRUE(tap);
    rack.start();
    grating_bus::Frame frame;
    (*tap)->next(frame, nullptr);
    const Instant then = rack.kernel().now();
    int looked = 0;
    ASSERT_TRUE(rack.card("host")->fault("off", 1, then));
    for (int i = 1; i <= 3; ++i) {
        (*tap)->next(frame, [&] { ++looked; });
        EXPECT_EQ(frame.words, 0u);
        EXPECT_EQ(frame.instant(), then + i * microseconds(250));
    }
    EXPECT_GE(looked, 3);
    ASSERT_TRUE(rack.card("host")->fault("off", 0, rack.kernel().now()));
    (*tap)->next(frame, nullptr);
    EXPECT_TRUE(sound(frame));
}

TEST(FrameStepper, ListsTheAvailableCards) {
    Rack rack(*read_rack_text(two_cards).config);
    const auto wrong = FrameStepper::create(rack, "nobody");
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message,
              "The rack's grating bus has no card 'nobody'; its cards are: host, scan. Nothing was done.");
    Rack router(*read_rack_text(*rack_template("router")).config);
    const auto none = FrameStepper::create(router, "");
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message, "The rack has no grating_bus card and thus no frames. Nothing was done.");
}

}  // namespace
}  // namespace motionrack::rack
