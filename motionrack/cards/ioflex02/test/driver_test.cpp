// The function library: its exact traffic on a scripted port, and its behaviour with the virtual card.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>
#include <motionrack/cards/ioflex02/driver/units.hpp>
#include <motionrack/cards/ioflex02/test/rig.hpp>
#include <motionrack/cards/ioflex02/test/scripted_port.hpp>

namespace motionrack::ioflex02 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Settings empty_card() {
    return {};
}

struct Bench {
    explicit Bench(const Settings& settings = empty_card(), FlexSettings flex = {})
        : rig(settings), card(rig.port, rig.port, std::move(flex)) {
        rig.start();
    }
    Rig rig;
    Flex2Pos card;
};

struct OnScript {
    OnScript() : card(port, port) {
        port.good_card();
        card.Init(0x2300);
        port.traffic.clear();
    }
    ScriptedPort port;
    Flex2Pos card;
};

// ---- exact traffic

TEST(Flex2PosTraffic, InitReadsBeforeItWritesAndSendsTheImageTwoBytesAtATime) {
    ScriptedPort port;
    port.good_card();
    Flex2Pos card(port, port);
    card.Init(0x2300);
    EXPECT_EQ(card.Result, Flex_Ok) << card.why();
    const std::size_t words = raw_image({})->size() / 2;
    ASSERT_EQ(port.traffic.size(), 5 + words + 4);
    EXPECT_EQ(port.traffic[0], "R SIGNATURE");
    EXPECT_EQ(port.traffic[1], "R SERIAL");
    EXPECT_EQ(port.traffic[2], "R SERIAL_N");
    EXPECT_EQ(port.traffic[3], "W CONTROL=1");
    EXPECT_EQ(port.traffic[4], "R STATUS");
    EXPECT_EQ(port.traffic[5], "W DATA=4F49");
    EXPECT_EQ(port.traffic[5 + words], "W CONTROL=2");
    EXPECT_EQ(port.traffic[6 + words], "R STATUS");
    EXPECT_EQ(port.traffic[7 + words], "R CFG_ERROR");
    EXPECT_EQ(port.traffic[8 + words], "R IDENT");
}

TEST(Flex2PosTraffic, TimeAndFourPositionsAreOneStrobeAndTenReads) {
    OnScript on;
    on.port.words[offset("TIME_L")] = 0x5678;
    on.port.words[offset("TIME_H")] = 0x12;
    on.port.words[offset("POS1_L")] = 0xFFFE;
    on.port.words[offset("POS1_H")] = 0xFF;
    on.port.words[offset("POS3_H")] = 0x7F;
    std::int32_t time = 0, p0 = 1, p1 = 0, p2 = 1, p3 = 0;
    on.card.ReadTimeClrPosition(time, p0, p1, p2, p3);
    EXPECT_THAT(on.port.traffic, ElementsAre("W STROBE=3", "R TIME_L", "R TIME_H", "R POS0_L", "R POS0_H", "R POS1_L",
                                             "R POS1_H", "R POS2_L", "R POS2_H", "R POS3_L", "R POS3_H"));
    EXPECT_EQ(time, 0x125678);
    EXPECT_EQ(p0, 0);
    EXPECT_EQ(p1, -2);
    EXPECT_EQ(p3, 0x7F0000);
}

TEST(Flex2PosTraffic, EveryOtherFunctionHasItsRegisters) {
    OnScript on;
    const auto traffic = [&](auto call) {
        on.port.traffic.clear();
        call();
        return on.port.traffic;
    };
    EXPECT_THAT(traffic([&] { on.card.ReadTime(); }), ElementsAre("W STROBE=1", "R TIME_L", "R TIME_H"));
    EXPECT_THAT(traffic([&] { on.card.ReadTimeClr(); }), ElementsAre("W STROBE=3", "R TIME_L", "R TIME_H"));
    EXPECT_THAT(traffic([&] { on.card.ReadPosition0(); }), ElementsAre("W STROBE=1", "R POS0_L", "R POS0_H"));
    EXPECT_THAT(traffic([&] { on.card.ReadPosition1(); }), ElementsAre("W STROBE=1", "R POS1_L", "R POS1_H"));
    EXPECT_THAT(traffic([&] { on.card.ReadPosition2(); }), ElementsAre("W STROBE=1", "R POS2_L", "R POS2_H"));
    EXPECT_THAT(traffic([&] { on.card.ReadPosition3(); }), ElementsAre("W STROBE=1", "R POS3_L", "R POS3_H"));
    EXPECT_THAT(traffic([&] { on.card.WriteOutL(0x5A); }), ElementsAre("W OUTL=5A"));
    EXPECT_THAT(traffic([&] { on.card.WriteOutH(0xA5); }), ElementsAre("W OUTH=A5"));
    EXPECT_THAT(traffic([&] { on.card.ReadInL(); }), ElementsAre("R IN"));
    EXPECT_THAT(traffic([&] { on.card.ReadInH(); }), ElementsAre("R IN"));
    EXPECT_THAT(traffic([&] { on.card.GetIdent(); }), ElementsAre("R IDENT"));
    EXPECT_THAT(traffic([&] { on.card.WriteCmd(cNop, cRes, cResNm, cResNmSig); }), ElementsAre("W CMD=E4"));
    EXPECT_THAT(traffic([&] { on.card.WriteCmdAxis(2, cResNmSig); }), ElementsAre("W CMD=B30"));
    EXPECT_THAT(traffic([&] { on.card.statuses(); }), ElementsAre("R STS"));
    EXPECT_THAT(traffic([&] {
                    EXPECT_TRUE(on.card.set_mode(2, {true, 1, true, 9}));
                }),
                ElementsAre("W AXIS=2", "W MODE=9D"));
    EXPECT_THAT(traffic([&] { on.card.clear_errors(); }), ElementsAre("W CONTROL=8"));
}

TEST(Flex2PosTraffic, WithoutASuccessfulInitNothingIsWrittenAndReadsGiveZero) {
    ScriptedPort port;
    Flex2Pos card(port, port);
    EXPECT_EQ(card.Result, Flex_ErrDevice);
    card.Init(0x2300);
    EXPECT_THAT(port.traffic, ElementsAre("R SIGNATURE", "R SERIAL", "R SERIAL_N"));
    port.traffic.clear();
    card.WriteOutL(1);
    card.WriteCmd(cRes, cRes, cRes, cRes);
    EXPECT_EQ(card.ReadPosition0(), 0);
    EXPECT_EQ(card.ReadTimeClr(), 0);
    EXPECT_FALSE(card.set_mode(0, {}));
    EXPECT_FALSE(card.wait_calibrated(0, milliseconds(1)));
    card.read_details();
    card.reset();
    EXPECT_TRUE(port.traffic.empty());
}

// ---- Init

TEST(Flex2PosInit, ConfiguresTheVirtualCardInTwoSeconds) {
    Bench b;
    b.card.Init(0x2300);
    EXPECT_EQ(b.card.Result, Flex_Ok) << b.card.why();
    EXPECT_TRUE(b.card.why().empty());
    EXPECT_EQ(b.card.GetIdent(), position_ident);
    EXPECT_GE(b.rig.kernel.now(), whole_seconds(2));
    EXPECT_LE(b.rig.kernel.now(), milliseconds(2'020));
    EXPECT_TRUE(b.rig.conditions().empty());
}

TEST(Flex2PosInit, AWrongBaseAddressIsErrDevice) {
    Bench b;
    b.card.Init(0x2400);
    EXPECT_EQ(b.card.Result, Flex_ErrDevice);
    EXPECT_THAT(b.card.why(), HasSubstr("No IOFLEX02 answers at 2400h: the signature reads FFFFh"));
    EXPECT_FALSE(b.rig.card.running());
}

TEST(Flex2PosInit, TwoCardsAtOneAddressAreErrDevice) {
    Settings other;
    other.serial = 2;
    Rig rig{Settings{}};
    Card second(rig.kernel, "c2", other);
    rig.bus.plug(second);
    rig.start();
    Flex2Pos card(rig.port, rig.port);
    card.Init(0x2300);
    EXPECT_EQ(card.Result, Flex_ErrDevice);
    EXPECT_THAT(card.why(), HasSubstr("At 2300h two cards answer"));
}

TEST(Flex2PosInit, ImagesThatAreCutDamagedOrForeignAreErrCfg) {
    const auto good = position_image();
    auto cut = good;
    cut.resize(good.size() - 5);
    auto damaged = good;
    damaged[good.size() / 2] ^= 4;
    auto raw_cut = *raw_image({});
    raw_cut.resize(40);
    auto raw_damaged = *raw_image({});
    raw_damaged[38] ^= 1;
    auto raw_foreign = *raw_image({});
    raw_foreign[3] = '?';
    const std::vector<std::uint8_t> text = {'h', 'e', 'l', 'l', 'o'};
    const std::pair<std::vector<std::uint8_t>, const char*> images[] = {
        {cut, "cannot be unpacked"},
        {damaged, "cannot be unpacked"},
        {text, "cannot be unpacked"},
        {compressed(raw_cut), "error 3): it is cut short"},
        {compressed(raw_damaged), "error 4): its CRC-32 is wrong"},
        {compressed(raw_foreign), "error 1): it is not an image"},
        {compressed(std::vector<std::uint8_t>{}), "error 3)"},
    };
    for (const auto& [image, sentence] : images) {
        FlexSettings flex;
        flex.image = image;
        Bench b(empty_card(), flex);
        b.card.Init(0x2300);
        EXPECT_EQ(b.card.Result, Flex_ErrCfg) << sentence;
        EXPECT_THAT(b.card.why(), HasSubstr(sentence));
        EXPECT_FALSE(b.rig.card.running());
    }
}

TEST(Flex2PosInit, AnotherProjectOrVersionIsErrProject) {
    ImageContent version, project;
    version.ident = 0x24;
    project.project = "stepper";
    for (const auto& [content, sentence] :
         {std::pair{version, "has version 24h of the project, but 25h is needed"}, {project, "another project"}}) {
        FlexSettings flex;
        flex.image = compressed(*raw_image(content));
        Bench b(empty_card(), flex);
        b.card.Init(0x2300);
        EXPECT_EQ(b.card.Result, Flex_ErrProject);
        EXPECT_THAT(b.card.why(), HasSubstr(sentence));
    }
}

TEST(Flex2PosInit, ReturnsErrCfgIfTheArrayDoesNotStartOrTheUserStops) {
    Settings slow;
    slow.configuration_time = whole_seconds(11);
    Bench b(slow);
    b.card.Init(0x2300);
    EXPECT_EQ(b.card.Result, Flex_ErrCfg);
    EXPECT_THAT(b.card.why(), HasSubstr("did not start within 10.0 s"));
    b.card.Init(0x2300);
    EXPECT_EQ(b.card.Result, Flex_ErrCfg);
    const std::atomic<bool> stop{true};
    Bench c;
    c.rig.port.set_stop_flag(&stop);
    c.card.Init(0x2300);
    EXPECT_EQ(c.card.Result, Flex_ErrCfg);
    EXPECT_THAT(c.card.why(), HasSubstr("stopped by the user"));
}

TEST(Flex2PosInit, AnotherInitAfterAFailureWorks) {
    Bench b;
    b.card.Init(0x2500);
    b.card.Init(0x2300);
    EXPECT_EQ(b.card.Result, Flex_Ok) << b.card.why();
}

// ---- with the card

struct Ready : Bench {
    Ready() {
        card.Init(0x2300);
        rig.run(microseconds(1));  // the first sample only sets the state
    }
};

TEST(Flex2Pos, CalibratesFourAxesWithTheFourCommands) {
    Ready r;
    for (int axis = 0; axis < 4; ++axis) r.rig.turn(axis, 100);
    r.card.WriteCmd(cNop, cRes, cResNm, cResNmSig);
    tIOFlexSts s0{}, s1{}, s2{}, s3{};
    r.card.ReadSts(s0, s1, s2, s3);
    EXPECT_EQ(s0, sCal);
    EXPECT_EQ(s1, sCal);
    EXPECT_EQ(s2, sNotCal);
    EXPECT_EQ(s3, sNotCal);
    r.rig.pulse("cal3");
    r.rig.pulse("z2");
    r.rig.pulse("z3");
    EXPECT_THAT(r.card.statuses(), testing::Each(sCal));
    EXPECT_TRUE(r.card.wait_calibrated(3, Duration{0}));
    for (int axis = 0; axis < 4; ++axis) r.rig.turn(axis, -7);
    EXPECT_EQ(r.card.ReadPosition0(), 93);
    EXPECT_EQ(r.card.ReadPosition1(), -7);
    EXPECT_EQ(r.card.ReadPosition2(), -7);
    EXPECT_EQ(r.card.ReadPosition3(), -7);
}

TEST(Flex2Pos, ReportsAMissingIndex) {
    Ready r;
    r.card.calibrate({cResNm, cNop, cNop, cNop});
    const auto done = r.card.wait_calibrated(0, milliseconds(50));
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("Axis 0 was not calibrated within 0.050 s"));
}

TEST(Flex2Pos, WaitsForAnIndexWithoutTimeoutIfAllowed) {
    Ready r;
    r.card.calibrate({cResNm, cNop, cNop, cNop});
    const Instant begun = r.rig.kernel.now();
    r.rig.port.on_slice(milliseconds(20),
                        [&] { r.rig.set("z0", r.rig.kernel.now() - begun > milliseconds(100) ? 1 : 0); });
    EXPECT_TRUE(r.card.wait_calibrated(0, never));
    EXPECT_GT(r.rig.kernel.now() - begun, milliseconds(100));
}

TEST(Flex2Pos, ModesAreReadBackAndOutOfRangeOnesRefused) {
    Ready r;
    const AxisMode mode{true, 2, true, 15};
    EXPECT_TRUE(r.card.set_mode(1, mode));
    EXPECT_EQ(r.card.mode(1), mode);
    EXPECT_EQ(r.card.mode(0), AxisMode{});
    ASSERT_FALSE(r.card.set_mode(1, {false, 3, false, 0}));
    EXPECT_THAT(r.card.set_mode(1, {false, 3, false, 0}).error().message, HasSubstr("has 3 edges per line"));
    EXPECT_FALSE(r.card.set_mode(1, {false, 4, false, 16}));
    EXPECT_FALSE(r.card.set_mode(1, {false, 4, false, -1}));
    EXPECT_EQ(r.card.mode(1), mode);
}

TEST(Flex2Pos, TheTimeIsCarriedOnOverWrapsOfAnyNumberAndOverClearings) {
    Ready r;
    const Instant begin = r.rig.kernel.now();
    const std::int64_t first = r.card.read().ticks;
    for (const Duration gap :
         {whole_seconds(5), whole_seconds(19), whole_seconds(21), whole_seconds(400), milliseconds(1)}) {
        r.rig.run(gap);
        if (gap == whole_seconds(19)) r.card.ReadTimeClr();
        std::int32_t t = 0, p = 0;
        if (gap == whole_seconds(400)) r.card.ReadTimeClrPosition(t, p, p, p, p);
        EXPECT_NEAR(static_cast<double>(r.card.read().ticks - first), to_seconds(r.rig.kernel.now() - begin) / 1.2e-6,
                    1);
    }
}

TEST(Flex2Pos, ExtendsPositionsBeyond24BitsAndAcrossACalibration) {
    OnScript on;
    std::int64_t position = 0, raw = 0;
    const auto reading = [&] {
        for (const auto& [at, value] : {std::pair{offset("POS2_L"), position}, {offset("RAW2_L"), raw}}) {
            on.port.words[at] = static_cast<std::uint16_t>(value);
            on.port.words[at + 2] = static_cast<std::uint16_t>(value >> 16 & 0xFF);
        }
        return on.card.read().axes[2];
    };
    for (int i = 0; i < 8; ++i) {
        position += 5'000'000;
        raw += 5'000'000;
        EXPECT_EQ(reading().position, position);
        EXPECT_EQ(reading().raw, raw);
    }
    position = -3;  // calibrated in the meantime
    raw += 4;
    EXPECT_EQ(reading().position, -3);
    EXPECT_EQ(reading().raw, raw);
    for (int i = 0; i < 8; ++i) {
        position -= 8'000'000;
        raw -= 8'000'000;
        EXPECT_EQ(reading().position, position);
        EXPECT_EQ(reading().raw, raw);
    }
}

TEST(Flex2Pos, AResetOfTheProjectDoesNotDisturbTheExtendedCounts) {
    Ready r;
    r.rig.turn(0, 50);
    r.rig.run(whole_seconds(3));
    const Reading before = r.card.read();
    r.card.reset();
    r.rig.run(milliseconds(12));
    r.rig.turn(0, 5);
    const Reading after = r.card.read();
    EXPECT_EQ(after.axes[0].position, 5);
    EXPECT_EQ(after.axes[0].raw, before.axes[0].raw + 5);
    EXPECT_NEAR(static_cast<double>(after.ticks - before.ticks), 10'000, 10);
}

TEST(Flex2Pos, DetailsHaveLinesEdgesIndexAndIllegalTransitions) {
    Ready r;
    r.rig.turn(1, 41);
    r.rig.pulse("z1");
    r.card.calibrate({cNop, cRes, cNop, cNop});
    r.rig.turn(1, -10);
    const AxisDetail d = r.card.read_details()[1];
    EXPECT_EQ(d.at.position, -10);
    EXPECT_EQ(d.at.raw, 31);
    EXPECT_TRUE(d.at.down);
    EXPECT_EQ(d.edges_a + d.edges_b, 51);
    EXPECT_EQ(d.indexes, 1);
    EXPECT_EQ(d.index_at, 41);
    EXPECT_EQ(d.position_of(d.index_at), 0);
    EXPECT_EQ(d.illegal, 0);
    EXPECT_EQ(d.edges, 4);
}

TEST(Flex2PosUnits, AreMillimetresOrDegrees) {
    const Units scale = *Units::mm(2048), spindle = *Units::degrees(4096);
    EXPECT_EQ(scale.of_counts(std::int64_t{4096}), 2.0);
    EXPECT_EQ(spindle.of_counts(std::int64_t{1024}), 90.0);
    EXPECT_EQ(spindle.to_counts(-180), -2048);
    EXPECT_FALSE(Units::mm(0));
    EXPECT_FALSE(Units::degrees(1.0 / 0.0));
    EXPECT_THAT(Units::mm(0).error().message, HasSubstr("counts for a mm are 0"));
}

}  // namespace
}  // namespace motionrack::ioflex02
