// The card from outside: counting, calibration, time, inputs and outputs.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/cards/ioflex02/test/rig.hpp>
#include <motionrack/sim/test/allocation_count.hpp>

namespace motionrack::ioflex02 {
namespace {

constexpr std::uint32_t pos0 = offset("POS0_L"), time_l = offset("TIME_L"), strobe = offset("STROBE");

TEST(Ioflex02Card, AfterPowerUpPositionsAndTimeAreZeroAndEveryAxisIsCalibrated) {
    Rig rig;
    rig.start();
    rig.set("a2", 1);
    rig.run(microseconds(1));
    for (int axis = 0; axis < 4; ++axis) EXPECT_EQ(position(rig, axis), axis == 2 ? 1 : 0);
    EXPECT_EQ(rig.read(offset("STS")), 0x0F);
    EXPECT_EQ(rig.read(offset("IDENT")), position_ident);
}

TEST(Ioflex02Card, ALeadingBCountsUpFourCountsALine) {
    Rig rig;
    rig.start();
    rig.turn(1, 4 * 25);
    EXPECT_EQ(position(rig, 1), 100);
    rig.turn(1, -130);
    EXPECT_EQ(position(rig, 1), -30);
    EXPECT_EQ(of_axis(rig, 1, offset("DOWN")), 1 << 1);
    EXPECT_EQ(of_axis(rig, 1, offset("EDGES_A")), 115);
    EXPECT_EQ(of_axis(rig, 1, offset("EDGES_B")), 115);
}

TEST(Ioflex02Card, TheFirstSampleOnlySetsTheState) {
    Rig rig;
    for (const char* pin : {"c1.a0", "c1.b0", "c1.z0", "c1.cal0"}) rig.kernel.set_wire(rig.kernel.find_wire(pin), 1);
    rig.start();
    rig.run(microseconds(5));
    EXPECT_EQ(position(rig, 0), 0);
    EXPECT_EQ(of_axis(rig, 0, offset("LINES")), 0x0F);
    EXPECT_EQ(of_axis(rig, 0, offset("ILLEGAL")), 0);
    EXPECT_EQ(of_axis(rig, 0, offset("INDEXES")), 0);
}

TEST(Ioflex02Card, BothLinesInOneSampleAreIllegalAndNeverCount) {
    Rig rig;
    rig.start();
    rig.turn(3, 7);
    rig.run(nanoseconds(50));
    for (int i = 1; i <= 5; ++i) {
        rig.phase[3] += 2;
        rig.kernel.set_wire(rig.kernel.find_wire("c1.a3"), lines_of_phase(rig.phase[3]) & 1);
        rig.run(nanoseconds(20));
        rig.kernel.set_wire(rig.kernel.find_wire("c1.b3"), lines_of_phase(rig.phase[3]) >> 1);
        rig.run(nanoseconds(180));
        EXPECT_EQ(position(rig, 3), 7);
        EXPECT_EQ(of_axis(rig, 3, offset("ILLEGAL")), i);
        EXPECT_EQ(of_axis(rig, 3, offset("ILLEGAL_AT_L")), 7);
    }
    EXPECT_EQ(rig.read(offset("STATUS")) >> 4, 1 << 3);
    EXPECT_EQ(rig.conditions(), std::vector{CardCondition::illegal_transition});
    rig.turn(3, 2);
    EXPECT_EQ(position(rig, 3), 9);  // the new state was kept
    rig.write(offset("CONTROL"), 8);
    EXPECT_EQ(of_axis(rig, 3, offset("ILLEGAL")), 0);
    EXPECT_EQ(rig.read(offset("STATUS")) >> 4, 0);
}

TEST(Ioflex02Card, AnIllegalTransitionIsReportedWithAxisAndInstant) {
    Rig rig;
    rig.start();
    rig.run(microseconds(10));
    rig.kernel.set_wire(rig.kernel.find_wire("c1.a1"), 1);
    rig.kernel.set_wire(rig.kernel.find_wire("c1.b1"), 1);
    rig.run(microseconds(10));
    const auto reported = rig.kernel.conditions();
    ASSERT_EQ(reported.size(), 1u);
    EXPECT_NE(describe(reported[0], "c1").find("axis 1 changed at once at 10100 ns"), std::string::npos)
        << describe(reported[0], "c1");
}

TEST(Ioflex02Card, ThePositionWrapsAt24Bits) {
    Rig rig;
    rig.start();
    EncoderAxisState axis;
    begin_axis(axis, 0, -1);
    axis.position = 8'388'607;
    wire_changed(axis, 0, true, 5);
    advance(axis, 6);
    EXPECT_EQ(signed24(axis.position), -8'388'608);
    EXPECT_EQ(signed24(0x7FFFFF), 8'388'607);
    EXPECT_EQ(signed24(0x800000), -8'388'608);
    EXPECT_EQ(signed24(-1), -1);
}

// ---- modes

TEST(Ioflex02Card, CountsInTheDirectionAndAtTheEdgesOfItsMode) {
    for (const int edges : {0, 1, 2, 3})
        for (const int reversed : {0, 1}) {
            Rig rig;
            rig.start();
            rig.write(offset("AXIS"), 2);
            rig.write(offset("MODE"), edges << 1 | reversed);
            EXPECT_EQ(rig.read(offset("MODE_NOW")), edges << 1 | reversed);
            rig.turn(2, 400);
            EXPECT_EQ(position(rig, 2), (reversed ? -1 : 1) * (edges == 0 ? 400 : edges == 1 ? 200 : 100));
            rig.turn(2, -400);
            EXPECT_EQ(position(rig, 2), 0);
        }
}

TEST(Ioflex02Card, TheFilterDropsPulsesThatAreTooShort) {
    Rig rig;
    rig.start();
    rig.write(offset("AXIS"), 0);
    rig.write(offset("MODE"), 5 << 4);
    rig.run(nanoseconds(50));
    for (const auto& [width, counts] : {std::pair{500, 0}, {600, 1}}) {
        rig.set("a0", 1);
        rig.run(nanoseconds(width));
        rig.set("a0", 0);
        EXPECT_EQ(of_axis(rig, 0, offset("LINES")) & 1, counts);
        rig.run(microseconds(2));
        EXPECT_EQ(position(rig, 0), 0);  // up and down again
    }
    EXPECT_EQ(of_axis(rig, 0, offset("EDGES_A")), 2);
}

TEST(Ioflex02Card, AnIndexThatIsActiveLowZeroesAtItsFallingEdge) {
    Rig rig;
    rig.start();
    rig.set("z0", 1);
    rig.write(offset("AXIS"), 0);
    rig.write(offset("MODE"), mode::INDEX_LOW.mask);
    rig.turn(0, 9);
    rig.command(0, cResNm);
    rig.run(microseconds(1));
    EXPECT_EQ(status(rig, 0), sNotCal);
    rig.set("z0", 0);
    rig.run(microseconds(1));
    EXPECT_EQ(status(rig, 0), sCal);
    EXPECT_EQ(position(rig, 0), 0);
}

// ---- time

TEST(Ioflex02Time, CountsTicksOfTwelveHundredNanoseconds) {
    Rig rig;
    rig.kernel.start();
    rig.run(microseconds(12'000));
    rig.capture();
    EXPECT_EQ(rig.read24(time_l), 10'000);
    rig.run(nanoseconds(1'199));
    rig.capture();
    EXPECT_EQ(rig.read24(time_l), 10'000);
    rig.run(nanoseconds(1));
    EXPECT_EQ(rig.read24(time_l), 10'000);  // the captured value stays
    rig.capture();
    EXPECT_EQ(rig.read24(time_l), 10'001);
}

TEST(Ioflex02Time, WrapsAfter24Bits) {
    Rig rig;
    rig.kernel.start();
    rig.run(nanoseconds(1'200) * 0x1000000 + nanoseconds(2'400));
    rig.capture();
    EXPECT_EQ(rig.read24(time_l), 2);
    EXPECT_EQ(rig.card.time(), 2u);
}

RC_GTEST_PROP(Ioflex02Time, SumsOfClearedTimesLoseNothing, ()) {
    Rig rig;
    rig.kernel.start();
    std::int64_t sum = 0;
    const int reads = *rc::gen::inRange(1, 30);
    for (int i = 0; i < reads; ++i) {
        rig.run(Duration{*rc::gen::inRange<std::int64_t>(0, 1'000'000)});
        rig.capture(2);
        sum += rig.read24(time_l);
    }
    RC_ASSERT(sum == rig.kernel.now() / time_tick);
}

TEST(Ioflex02Capture, HasTimeAndFourPositionsOfOneInstant) {
    Rig rig(loaded_settings(), microseconds(3));  // accesses take time
    rig.start();
    rig.turn(0, 5, nanoseconds(200));
    rig.turn(3, -6, nanoseconds(200));
    const Instant before = rig.kernel.now();
    rig.write(strobe, 1);
    const std::int64_t tick = (before + microseconds(3)) / time_tick;
    rig.turn(0, 100, nanoseconds(200));
    rig.turn(3, 100, nanoseconds(200));
    EXPECT_EQ(rig.read24(time_l), tick);
    EXPECT_EQ(signed24(rig.read24(pos0)), 5);
    EXPECT_EQ(signed24(rig.read24(pos0 + 12)), -6);
    rig.write(strobe, 2);  // clears the time, captures nothing
    EXPECT_EQ(rig.read24(time_l), tick);
    EXPECT_EQ(rig.card.time(), 5u);  // the two reads took 6 us
}

TEST(Ioflex02Capture, ReportsTheTimeSinceTheLastCount) {
    Rig rig;
    rig.kernel.start();
    rig.capture();
    EXPECT_EQ(rig.read24(offset("AGE0_L")), 0xFFFFFF);
    rig.run(microseconds(12));
    rig.set("a0", 1);
    rig.run(microseconds(120));
    rig.capture(2);
    EXPECT_EQ(rig.read24(offset("AGE0_L")), 100);
    rig.run(microseconds(120));
    rig.capture();
    EXPECT_EQ(rig.read24(offset("AGE0_L")), 200);  // not affected by clearing the time
    rig.run(whole_seconds(21));
    rig.capture();
    EXPECT_EQ(rig.read24(offset("AGE0_L")), 0xFFFFFF);
}

// ---- inputs, outputs, reset

TEST(Ioflex02Card, InputsAreReadAsTheyAreAndOutputsHoldTheirBytes) {
    Rig rig;
    rig.start();
    const char* lines[16] = {"a0", "b0", "z0", "cal0", "a1", "b1", "z1", "cal1",
                             "a2", "b2", "z2", "cal2", "a3", "b3", "z3", "cal3"};
    for (int i = 0; i < 16; ++i) {
        rig.set(lines[i], 1);
        EXPECT_EQ(rig.read(offset("IN")), 1 << i) << lines[i];
        EXPECT_EQ(rig.level("in" + std::to_string(i)), 1);
        rig.set("in" + std::to_string(i), 0);
        EXPECT_EQ(rig.level(lines[i]), 0) << "two names of one wire";
    }
    rig.write(offset("AXIS"), 1);
    rig.write(offset("MODE"), 0xF0);
    rig.set("in5", 1);
    EXPECT_EQ(rig.read(offset("IN")), 1 << 5) << "not behind the filter";
    rig.write(offset("OUTL"), 0xA5);
    rig.write(offset("OUTH"), 0xFF3C);
    for (int i = 0; i < 32; ++i) EXPECT_EQ(rig.level("out" + std::to_string(i)), 0x3CA5 >> i & 1) << i;
}

/// A host writes whole bytes: those that it remembers from before the stop.
TEST(Ioflex02Card, AClearedOutputStaysLowUntilItIsWrittenLow) {
    Rig rig;
    rig.start();
    rig.write(offset("OUTL"), 0x03);
    rig.write(offset("OUTH"), 0x80);
    rig.card.clear_outputs();
    rig.write(offset("OUTL"), 0x07);
    EXPECT_EQ(rig.level("out0"), 0);
    EXPECT_EQ(rig.level("out1"), 0);
    EXPECT_EQ(rig.level("out2"), 1) << "was low";
    EXPECT_EQ(rig.conditions(), std::vector{CardCondition::outputs_held});
    rig.write(offset("OUTH"), 0x80);
    EXPECT_EQ(rig.level("out15"), 0);
    rig.write(offset("OUTL"), 0x02);
    rig.write(offset("OUTL"), 0x03);
    EXPECT_EQ(rig.level("out0"), 1);
    EXPECT_EQ(rig.level("out1"), 0) << "never written low";
    EXPECT_EQ(rig.conditions().size(), 1u) << "once a stop";
    rig.write(offset("CONTROL"), 4);  // a reset of the project ends it
    rig.write(offset("OUTH"), 0x80);
    EXPECT_EQ(rig.level("out15"), 1);
}

TEST(Ioflex02Card, AResetClearsCountsOutputsAndModes) {
    Rig rig;
    rig.start();
    rig.turn(0, 100);
    rig.write(offset("OUTL"), 0xFF);
    rig.write(offset("AXIS"), 2);
    rig.write(offset("MODE"), 1);
    rig.write(offset("CMD"), 0xFF);
    rig.write(offset("CONTROL"), 4);
    EXPECT_EQ(rig.read(offset("STS")), 0x0F);
    EXPECT_EQ(position(rig, 0), 0);
    EXPECT_LE(rig.read24(time_l), 1);
    EXPECT_EQ(rig.level("out3"), 0);
    rig.run(microseconds(1));
    rig.turn(2, 4);
    EXPECT_EQ(position(rig, 2), 4);
}

TEST(Ioflex02Card, ALongRunWithoutEdgesCostsNoEventAndNothingAllocates) {
    Rig rig;
    rig.start();
    rig.turn(0, 100);
    const std::uint64_t events = rig.kernel.events();
    rig.run(whole_seconds(1000));
    EXPECT_EQ(rig.kernel.events(), events);
    const sim::WireId a = rig.kernel.find_wire("c1.a0"), b = rig.kernel.find_wire("c1.b0");
    const std::uint64_t before = sim::allocations();
    for (std::int64_t i = 1; i <= 20'000; ++i) {
        const int lines = lines_of_phase(100 + i);
        rig.kernel.set_wire(a, lines & 1);
        rig.kernel.set_wire(b, lines >> 1);
        rig.run(nanoseconds(300));
        if (i % 100 == 0) rig.capture();
    }
    EXPECT_EQ(sim::allocations(), before);
    EXPECT_EQ(rig.card.position(0), 20'100);
}

RC_GTEST_PROP(Ioflex02Card, ThePositionEqualsTheEncoderRotationOnEveryPath, ()) {
    Rig rig;
    rig.start();
    std::int64_t turned[4] = {};
    const int turns = *rc::gen::inRange(1, 12);
    for (int i = 0; i < turns; ++i) {
        const int axis = *rc::gen::inRange(0, 4);
        const int counts = *rc::gen::inRange(-300, 301);
        rig.turn(axis, counts, nanoseconds(*rc::gen::inRange(100, 2'000)));
        turned[axis] += counts;
    }
    rig.run(nanoseconds(200));
    for (int axis = 0; axis < 4; ++axis) {
        RC_ASSERT(rig.card.position(axis) == turned[axis]);
        RC_ASSERT(rig.card.illegal(axis) == 0);
    }
}

}  // namespace
}  // namespace motionrack::ioflex02
