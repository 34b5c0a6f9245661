// The unit's object with the virtual card: its two steps of configuration, user images, inputs, one axis armed alone,
// and the range of 24 bits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>
#include <motionrack/cards/ioflex02/driver/units.hpp>
#include <motionrack/cards/ioflex02/test/rig.hpp>

namespace motionrack::ioflex02 {
namespace {

using testing::HasSubstr;

struct Configured {
    Configured() : card(rig.port, rig.port) {
        rig.start();
        card.Init(0x2300);
        rig.run(microseconds(1));  // the first sample only sets the state
    }
    Rig rig{Settings{}};
    Flex2Pos card;
};

TEST(Flex2Pos, TheAncestorSetsTheBaseAddressAndConfigureLoadsTheArray) {
    Rig rig{Settings{}};
    Flex02 card(rig.port, rig.port);
    rig.start();
    card.Init(0x2300);
    EXPECT_EQ(card.base_address(), 0x2300);
    EXPECT_EQ(card.Result, Flex_ErrDevice);
    EXPECT_THAT(card.why(), HasSubstr("Call Configure"));
    EXPECT_EQ(rig.card.array(), ArrayState::empty);
    card.Configure(position_image());
    EXPECT_EQ(card.Result, Flex_Ok) << card.why();
    EXPECT_EQ(card.GetIdent(), position_ident);
}

TEST(Flex2Pos, ConfiguringAgainCountsFromZero) {
    Configured r;
    r.rig.turn(1, 50);
    EXPECT_EQ(r.card.read().axes[1].raw, 50);
    r.card.Configure(position_image({0, mode::REVERSED.mask, 0, 0}));
    r.rig.run(microseconds(1));
    r.rig.turn(1, 8);
    EXPECT_EQ(r.card.read().axes[1].raw, -8);
    EXPECT_EQ(r.card.read().axes[1].position, -8);
}

TEST(Flex2Pos, InitLoadsTheUsersImage) {
    Configured r;
    r.card.use_image(compressed(*raw_image({"position", 0x24, std::vector<std::uint8_t>(8)})));
    r.card.Init(0x2300);
    EXPECT_EQ(r.card.Result, Flex_ErrProject) << r.card.why();
    r.card.use_image({});
    r.card.Init(0x2300);
    EXPECT_EQ(r.card.Result, Flex_Ok) << r.card.why();
}

TEST(Flex2Pos, ReadsInputsAndWritesOutputs) {
    Configured r;
    r.rig.set("b0", 1);
    r.rig.set("z1", 1);
    r.rig.set("a2", 1);
    r.rig.set("cal3", 1);
    EXPECT_EQ(r.card.ReadInL(), 0x42);
    EXPECT_EQ(r.card.ReadInH(), 0x81);
    r.card.WriteOutL(0x81);
    r.card.WriteOutH(0x42);
    EXPECT_EQ(r.rig.level("out0") + 2 * r.rig.level("out7") + 4 * r.rig.level("out9") + 8 * r.rig.level("out14"), 15);
    EXPECT_EQ(r.rig.level("out8"), 0);
}

TEST(Flex2Pos, ArmsOneAxisWhileTheOthersKeepWhatTheyWaitFor) {
    Configured r;
    for (int axis = 0; axis < 4; ++axis) r.rig.turn(axis, 10 + axis);
    r.card.WriteCmdAxis(0, cResNmSig);
    r.rig.pulse("cal0");
    r.card.WriteCmdAxis(3, cResNm);
    r.card.WriteCmdAxis(1, cRes);
    EXPECT_THAT(r.card.statuses(), testing::ElementsAre(sNotCal, sCal, sCal, sNotCal));
    EXPECT_EQ(r.card.ReadPosition1(), 0);
    r.rig.pulse("z0");
    EXPECT_EQ(r.card.ReadPosition0(), 0) << "its edge of Cal was not forgotten";
    r.card.WriteCmdAxis(3, cNop);
    r.rig.pulse("z3");
    EXPECT_EQ(r.card.ReadPosition3(), 13);
    EXPECT_EQ(r.card.ReadPosition2(), 12);
}

// 5.2.5: "2 mm a period and 4096 parts a period: about +-2 m". With one count per part, signed 24 bits reach twice as
// far.
TEST(Flex2Pos, AScaleOfTwoMetresInEachDirectionFitsIntoThePosition) {
    const Units scale = *Units::mm(4096 / 2.0);
    EXPECT_DOUBLE_EQ(scale.of_counts(signed24(0x800000)), -4096);
    EXPECT_NEAR(scale.of_counts(signed24(0x7FFFFF)), 4096, 1e-3);
    for (const double metres : {2.0, -2.0}) {
        EncoderAxisState axis;
        begin_axis(axis, 0, -1);
        axis.position = static_cast<std::int64_t>(scale.to_counts(1000 * metres));
        wire_changed(axis, 0, true, 5);
        advance(axis, 6);
        EXPECT_NEAR(scale.of_counts(signed24(axis.position)), 1000 * metres, 1e-3) << "has not wrapped";
    }
    // Two counts per part would match the sentence.
    EXPECT_NEAR(Units::mm(2 * 4096 / 2.0)->of_counts(signed24(0x7FFFFF)), 2048, 1e-3);
}

}  // namespace
}  // namespace motionrack::ioflex02
