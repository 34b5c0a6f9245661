// The four calibration commands, from outside.
#include <gtest/gtest.h>

#include <motionrack/cards/ioflex02/test/rig.hpp>

namespace motionrack::ioflex02 {
namespace {

TEST(Ioflex02Calibration, ResZeroesAtOnce) {
    Rig rig;
    rig.start();
    for (int axis = 0; axis < 4; ++axis) rig.turn(axis, 10 + axis);
    rig.command(2, cRes);  // the others get cNop
    EXPECT_EQ(rig.read(offset("STS")), 0x0F);
    EXPECT_EQ(position(rig, 0), 10);
    EXPECT_EQ(position(rig, 1), 11);
    EXPECT_EQ(position(rig, 2), 0);
    EXPECT_EQ(position(rig, 3), 13);
}

TEST(Ioflex02Calibration, ResNmZeroesAtTheFirstIndexOnly) {
    Rig rig;
    rig.start();
    rig.turn(1, 50);
    rig.command(1, cResNm);
    EXPECT_EQ(status(rig, 1), sNotCal);
    rig.turn(1, 50);
    EXPECT_EQ(position(rig, 1), 100);
    rig.pulse("z1");
    EXPECT_EQ(status(rig, 1), sCal);
    EXPECT_EQ(position(rig, 1), 0);
    rig.turn(1, 33);
    rig.pulse("z1");
    EXPECT_EQ(position(rig, 1), 33);
    EXPECT_EQ(of_axis(rig, 1, offset("INDEXES")), 2);
    EXPECT_EQ(of_axis(rig, 1, offset("INDEX_AT_L")), 133);  // in counts, which a calibration does not zero
}

TEST(Ioflex02Calibration, AnIndexThatIsAlreadyHighIsIgnored) {
    Rig rig;
    rig.start();
    rig.set("z0", 1);
    rig.run(microseconds(1));
    rig.command(0, cResNm);
    rig.turn(0, 5);
    EXPECT_EQ(status(rig, 0), sNotCal);
    rig.set("z0", 0);
    rig.turn(0, 5);
    EXPECT_EQ(status(rig, 0), sNotCal);
    rig.pulse("z0");
    EXPECT_EQ(status(rig, 0), sCal);
}

TEST(Ioflex02Calibration, ACountInTheSampleOfTheIndexIsLost) {
    Rig rig;
    rig.start();
    rig.command(0, cResNm);
    rig.run(nanoseconds(30));
    rig.kernel.set_wire(rig.kernel.find_wire("c1.a0"), 1);
    rig.kernel.set_wire(rig.kernel.find_wire("c1.z0"), 1);
    rig.run(microseconds(1));
    EXPECT_EQ(position(rig, 0), 0);
    EXPECT_EQ(signed24(rig.read24(offset("RAW0_L"))), 1);
}

TEST(Ioflex02Calibration, ResNmSigWaitsForCalThenForTheIndex) {
    Rig rig;
    rig.start();
    rig.set("cal3", 1);
    rig.run(microseconds(1));
    rig.command(3, cResNmSig);
    rig.turn(3, 5);
    rig.pulse("z3");  // before any edge of Cal: no effect, and a high Cal gives no edge
    EXPECT_EQ(status(rig, 3), sNotCal);
    rig.set("cal3", 0);
    rig.run(microseconds(1));
    rig.pulse("z3");
    EXPECT_EQ(status(rig, 3), sNotCal);
    rig.set("cal3", 1);
    rig.run(microseconds(1));
    EXPECT_EQ(position(rig, 3), 5);
    EXPECT_EQ(status(rig, 3), sNotCal);
    rig.pulse("z3");
    EXPECT_EQ(status(rig, 3), sCal);
    EXPECT_EQ(position(rig, 3), 0);
}

TEST(Ioflex02Calibration, AnIndexInTheSampleOfCalIsIgnored) {
    Rig rig;
    rig.start();
    rig.command(0, cResNmSig);
    rig.run(nanoseconds(30));
    rig.kernel.set_wire(rig.kernel.find_wire("c1.cal0"), 1);
    rig.kernel.set_wire(rig.kernel.find_wire("c1.z0"), 1);
    rig.run(microseconds(1));
    EXPECT_EQ(rig.card.calibration(0), CalState::wait_index);
    rig.set("z0", 0);
    rig.run(microseconds(1));
    rig.pulse("z0");
    EXPECT_EQ(rig.card.calibration(0), CalState::calibrated);
}

TEST(Ioflex02Calibration, ANewCommandReplacesPendingCommandsOfAllAxes) {
    Rig rig;
    rig.start();
    rig.write(offset("CMD"), cResNm | cResNm << 2 | cResNmSig << 4 | cResNm << 6);
    EXPECT_EQ(rig.read(offset("STS")), 0);
    rig.turn(0, 3);
    rig.write(offset("CMD"), cNop | cResNmSig << 2 | cNop << 4 | cRes << 6);
    EXPECT_EQ(rig.read(offset("STS")), 0b1101);
    EXPECT_EQ(position(rig, 0), 3);
    rig.pulse("z0");
    rig.pulse("z1");
    EXPECT_EQ(position(rig, 0), 3);
    EXPECT_EQ(rig.read(offset("STS")), 0b1101);
}

TEST(Ioflex02Calibration, AnAxisWithKeepIgnoresTheCommandAndKeepsItsArmedState) {
    Rig rig;
    rig.start();
    for (int axis = 0; axis < 4; ++axis) rig.turn(axis, 40);
    rig.write(offset("CMD"), cResNmSig | cResNm << 2);
    rig.pulse("cal0");
    // Axis 2 is armed; 0 has had its edge of Cal, 1 waits for an index, 3 does not wait.
    rig.write(offset("CMD"), cResNm << 4 | 0xB00);
    EXPECT_EQ(rig.read(offset("STS")), 0b1000);
    for (const char* index : {"z0", "z1", "z2", "z3"}) rig.pulse(index);
    EXPECT_EQ(rig.read(offset("STS")), 0b1111);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(position(rig, axis), 0) << axis;
    EXPECT_EQ(position(rig, 3), 40);
    rig.write(offset("CMD"), 0xF55);
    EXPECT_EQ(position(rig, 3), 40) << "all keep: nothing is written";
}

}  // namespace
}  // namespace motionrack::ioflex02
