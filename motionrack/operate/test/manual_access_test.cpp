// Manual accesses to the cards' buses: their conditions, and the end of motion that register writes start.
#include <gmock/gmock.h>

#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/operate/test/operated.hpp>

namespace motionrack::operate {
namespace {

using testing::HasSubstr;

const std::string with_card = "[card.glass]\ntype = \"ioflex02\"\nbase_address = 0x2300\npreloaded = true\n";

std::string write_16(Machine& m, const char* card, std::uint32_t address, std::uint32_t value) {
    return refusal_of(m.manual_access().request({card, 16, address, value}, [](const auto&) {}));
}

/// Bits of WR0 that select an axis of an MCX314.
constexpr std::uint32_t of_x = 1 << 8, of_y = 1 << 9;

/// Writes the registers that make an axis of an MCX314 drive in + direction until it is stopped.
void drive_by_writes(Machine& m, std::uint32_t axis) {
    constexpr std::uint32_t wr0 = 0, wr6 = 12, wr7 = 14;
    struct Write {
        std::uint32_t address, value;
    };
    for (const auto& [address, value] : {Write{wr6, 0x1200},
                                         {wr7, 0x007A},
                                         {wr0, axis | 0x00},  // R: multiple 1
                                         {wr6, 400},
                                         {wr0, axis | 0x02},  // A
                                         {wr6, 100},
                                         {wr0, axis | 0x04},  // SV
                                         {wr6, 4000},
                                         {wr0, axis | 0x05},
                                         {wr0, axis | 0x22}})
        EXPECT_EQ(write_16(m, "m", address, value), "");
}

bool axis_moves(Machine& m, std::size_t axis) {
    return m.rack().axes()[axis].velocity(m.now()) != 0;
}

TEST(ManualAccess, IsAllowedToMeasuringCardsOnlyWhileAxesMove) {
    Operated o(two_axes(with_card));
    int answered = 0;
    std::string refused;
    const auto read = [&](Machine& m, const char* card, std::uint32_t address) {
        return m.manual_access().request({card, 16, address, {}}, [&](const Result<std::uint32_t>&) { ++answered; });
    };
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.line("G91 G1 X20 F600", 1)); });
    o.at(0.5, [&](Machine& m) {
        EXPECT_TRUE(read(m, "glass", 0x2300 + ioflex02::offset("STATUS")));
        refused = refusal_of(read(m, "m", 0));
        EXPECT_EQ(refusal_of(read(m, "nobody", 0)), refused);
    });
    o.at(0.6, [&](Machine&) { EXPECT_EQ(answered, 1); });
    o.run(4);
    EXPECT_THAT(refused, HasSubstr("The card was not accessed: the machine is in state"));
    EXPECT_NEAR(o.x(), 30, 1e-9) << "the motion went on";
}

TEST(ManualAccess, IsAllowedToMeasuringCardsDuringAService) {
    Operated o(two_axes(with_card));
    int answered = 0;
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.service().begin("m", {}, "", {})); });
    o.at(0.1, [&](Machine& m) {
        EXPECT_TRUE(m.manual_access().request({"glass", 16, 0x2300 + ioflex02::offset("STATUS"), {}},
                                              [&](const Result<std::uint32_t>& read) { answered += read ? 1 : 0; }));
        EXPECT_THAT(refusal_of(m.manual_access().request({"m", 16, 0, {}}, [](const auto&) {})),
                    HasSubstr("The card was not accessed: the machine is in state"));
    });
    o.at(0.2, [&](Machine& m) {
        EXPECT_EQ(answered, 1);
        EXPECT_EQ(m.service().card(), "m");
    });
    o.run(0.3);
}

/// A card without axes of the machine is in service also while the machine is disabled.
TEST(ManualAccess, PrecedesAServiceThatBeginsAfterIt) {
    Operated o(two_axes("[card.free]\ntype = \"mcx314\"\n"));
    const auto begin = [](Machine& m) { return refusal_of(m.service().begin("free", {}, "", {})); };
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.enable(false)); });
    o.at(0.1, [=](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::disabled);
        EXPECT_TRUE(m.manual_access().request({"m", 16, 0, {}}, [](const auto&) {}));
        EXPECT_THAT(begin(m), HasSubstr("a command is still being executed. Nothing was changed; try again at once."));
    });
    o.at(0.2, [=](Machine& m) { EXPECT_EQ(begin(m), ""); });
    o.run(0.3);
}

TEST(ManualAccess, WritesNoValueThatIsTooWide) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_EQ(write_16(m, "m", 0, 0x10000), "65536 does not fit into 16 bits. Nothing was done.");
        EXPECT_EQ(write_16(m, "m", 12, 0xFFFF), "");
        EXPECT_THAT(refusal_of(m.manual().jog('X', 5)), HasSubstr("a card is being accessed; try again at once"));
    });
    o.run(0.2);
}

TEST(ManualAccess, WritesNothingWhileAStopIsInForce) {
    Operated o(two_axes(with_card));
    const std::uint32_t outputs = 0x2300 + ioflex02::offset("OUTL");
    o.at(0.1, [](Machine& m) { m.stop(); });
    for (const double seconds : {0.1, 0.2})  // in the slice of the stop, and in the error stop
        o.at(seconds, [=](Machine& m) {
            EXPECT_THAT(write_16(m, "m", 0, 0x0122), HasSubstr("Stopped on request at 0.1"));
            EXPECT_THAT(write_16(m, "glass", outputs, 0xFF), HasSubstr("The card was not written"));
            EXPECT_TRUE(m.manual_access().request({"m", 16, 0, {}}, [](const auto&) {})) << "it may be read";
        });
    o.at(0.3, [](Machine& m) { m.reset(); });
    o.at(0.4, [=](Machine& m) { EXPECT_EQ(write_16(m, "glass", outputs, 0xFF), ""); });
    o.at(0.5, [](Machine& m) { m.stop(); });
    o.at(0.6, [](Machine& m) { EXPECT_EQ(*m.wires().get("glass.out0"), 0) << "the stop has cleared it"; });
    o.run(0.7);
}

TEST(ManualAccess, CancelsAWriteIfAStopPrecedesIt) {
    Operated o(two_axes());
    std::string answer;
    o.at(0.1, [&](Machine& m) {
        EXPECT_TRUE(m.manual_access().request({"m", 16, 0, 0x0122}, [&](const Result<std::uint32_t>& done) {
            answer = done ? "written" : done.error().message;
        }));
        m.stop();
    });
    o.run(0.2);
    EXPECT_THAT(answer, HasSubstr("The card was not written: Stopped on request"));
}

TEST(ManualAccess, WritesToNoCardOfADisabledAxis) {
    Operated o(two_axes(with_card));
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.enable(false, "Y"));
        EXPECT_THAT(write_16(m, "m", 0, 0), HasSubstr("axis Y is disabled")) << "also before it is carried out";
    });
    o.at(0.2, [](Machine& m) {
        EXPECT_THAT(write_16(m, "m", 0, 0), HasSubstr("axis Y is disabled"));
        EXPECT_EQ(write_16(m, "glass", 0x2300 + ioflex02::offset("OUTL"), 1), "") << "it moves no axis";
    });
    o.run(0.3);
}

TEST(ManualAccess, WritesToNoCardThatMovesWhileTheDoorIsOpen) {
    Operated o(two_axes(with_card + "[safety]\ndoor = true\n"));
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.wires().force("door", 0));
        EXPECT_THAT(write_16(m, "m", 0, 0), HasSubstr("the door is open"));
    });
    o.run(0.2);
}

/// The chip stops only the axis at its own switch.
TEST(ManualAccess, MovesNoAxisOnceAnotherOneHasReachedItsLimitSwitch) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        drive_by_writes(m, of_x);
        drive_by_writes(m, of_y);
    });
    o.at(0.5, [](Machine& m) {
        EXPECT_TRUE(axis_moves(m, 0) && axis_moves(m, 1));
        EXPECT_TRUE(m.wires().force("m.ylmtp", 0));
    });
    double moved_to = 0;
    o.at(0.55, [&](Machine& m) {
        EXPECT_FALSE(axis_moves(m, 0) || axis_moves(m, 1)) << "within 50 ms";
        moved_to = m.status().axes[0].true_position;
    });
    o.at(1, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << name_of(m.state());
        EXPECT_THAT(m.status().reason, HasSubstr("The + limit switch of Y was reached"));
        m.reset();
    });
    o.run(1.5);
    EXPECT_EQ(o.machine->state(), MachineState::standstill) << o.machine->status().reason;
    EXPECT_EQ(o.machine->status().axes[0].true_position, moved_to);
}

TEST(ManualAccess, StartsAMotionThatTheAlarmOfAnOpenedDoorNames) {
    Operated o(two_axes("[safety]\ndoor = true\n"));
    o.at(0.1, [](Machine& m) { drive_by_writes(m, of_x); });
    o.at(0.5, [](Machine& m) { EXPECT_TRUE(m.wires().force("door", 0)); });
    o.run(0.6);
    ASSERT_THAT(o.machine->status().alarms, testing::SizeIs(1));
    EXPECT_THAT(o.machine->status().alarms[0].text, HasSubstr("the motion was stopped, the spindle is off"));
}

/// A cause that ends the motion that register writes have started at standstill.
struct EndOfMotion {
    const char* name;
    void (*give)(Machine& m);
    const char* state;
};
void PrintTo(const EndOfMotion& end, std::ostream* out) {
    *out << end.name;
}

class MotionByRegisters : public testing::TestWithParam<EndOfMotion> {};

TEST_P(MotionByRegisters, EndsOnEveryStopAndPreventsEveryStart) {
    Operated o(two_axes("[safety]\ndoor = true\n"));
    double moved_to = 0;
    o.at(0.1, [](Machine& m) { drive_by_writes(m, of_x); });
    o.at(0.5, [&](Machine& m) {
        EXPECT_TRUE(axis_moves(m, 0));
        for (const std::string& refused :
             {refusal_of(m.manual().set_position('X', 0)), refusal_of(m.manual().jog('Y', 5)),
              refusal_of(m.manual().home("")), refusal_of(m.service().begin("m", {}, "", {}))})
            EXPECT_THAT(refused, HasSubstr("axis X is moved by register writes"));
        GetParam().give(m);
    });
    o.at(0.55, [&](Machine& m) {
        EXPECT_FALSE(axis_moves(m, 0)) << "within 50 ms";
        moved_to = m.status().axes[0].true_position;
        EXPECT_FALSE(m.status().axes[0].position_valid);
    });
    o.at(1, [&](Machine& m) {
        EXPECT_EQ(name_of(m.state()), std::string(GetParam().state));
        EXPECT_EQ(m.status().axes[0].true_position, moved_to);
        for (const char* const wire : {"estop", "door"}) EXPECT_TRUE(m.wires().force(wire, 1));
        m.reset();
    });
    o.at(1.1, [&](Machine& m) {
        EXPECT_TRUE(m.enable(true));
        EXPECT_EQ(m.status().axes[0].true_position, moved_to) << "a reset moves nothing";
        for (const char letter : {'X', 'Y'}) EXPECT_TRUE(m.manual().set_position(letter, 20));
    });
    o.at(1.2, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X30\nM2\n", "p")); });
    o.run(3);
    EXPECT_NEAR(o.x(), 30, 1e-3) << "the controller drives it again";
}

INSTANTIATE_TEST_SUITE_P(
    Ends, MotionByRegisters,
    testing::Values(EndOfMotion{"stop", [](Machine& m) { m.stop(); }, "error stop"},
                    EndOfMotion{"reset", [](Machine& m) { m.reset(); }, "standstill"},
                    EndOfMotion{"disable", [](Machine& m) { EXPECT_TRUE(m.enable(false)); }, "disabled"},
                    EndOfMotion{"estop", [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); }, "error stop"},
                    EndOfMotion{"door", [](Machine& m) { EXPECT_TRUE(m.wires().force("door", 0)); }, "standstill"}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace motionrack::operate
