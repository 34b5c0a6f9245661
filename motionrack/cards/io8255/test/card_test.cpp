// The card from outside: writes, reads, edges of its lines, and a look at its wires.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/io8255/test/rig.hpp>
#include <motionrack/sim/test/allocation_count.hpp>

namespace motionrack::io8255 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint8_t port_a = offset("OUT_A"), port_b = offset("OUT_B"), port_c = offset("OUT_C");

struct Started : Rig {
    explicit Started(const PortModes& modes = {}) {
        start();
        set_modes(modes);
    }
};

// ---- mode 0

TEST(Io8255Card, BeginsWithInputsAndLowOutputs) {
    Rig rig;
    rig.start();
    for (const char* port : {"a", "b", "c"}) EXPECT_EQ(rig.driven(port), 0u) << port;
    EXPECT_EQ(rig.level("int"), 0);
    for (const std::uint8_t port : {port_a, port_b, port_c})
        EXPECT_EQ(rig.port.in(port), 0xFF) << "inputs without a wire are high";
    rig.port.out(port_a, 0x55);
    EXPECT_EQ(rig.driven("a"), 0u) << "a write to an input does nothing";
}

TEST(Io8255Card, PutsOutAndReadsBackItsLatches) {
    Started rig(all_outputs);
    rig.port.out(port_a, 0xA5);
    rig.port.out(port_b, 0x0F);
    rig.port.out(port_c, 0x81);
    EXPECT_EQ(rig.driven("a"), 0xA5u);
    EXPECT_EQ(rig.driven("b"), 0x0Fu);
    EXPECT_EQ(rig.driven("c"), 0x81u);
    EXPECT_EQ(rig.port.in(port_a), 0xA5);
    EXPECT_EQ(rig.port.in(port_c), 0x81);
    EXPECT_THAT(rig.conditions(), IsEmpty());
}

TEST(Io8255Card, ReadsTheLevelsOfItsInputs) {
    Started rig;
    rig.set_port("a", 0x12);
    rig.set_port("b", 0x34);
    rig.set_port("c", 0x56);
    EXPECT_EQ(rig.port.in(port_a), 0x12);
    EXPECT_EQ(rig.port.in(port_b), 0x34);
    EXPECT_EQ(rig.port.in(port_c), 0x56);
    EXPECT_EQ(rig.card.peek(port_c), 0x56);
}

TEST(Io8255Card, HalvesOfPortCHaveDirectionsOfTheirOwn) {
    PortModes modes;
    modes.c_upper_input = false;
    Started rig(modes);
    rig.set_port("c", 0x05);
    rig.port.out(port_c, 0xAF);
    EXPECT_EQ(rig.driven("c"), 0xA0u);
    EXPECT_EQ(rig.port.in(port_c), 0xA5);
}

TEST(Io8255Card, SetsSingleLinesOfPortC) {
    Started rig(all_outputs);
    rig.bit(3, 1);
    rig.bit(7, 1);
    EXPECT_EQ(rig.driven("c"), 0x88u);
    rig.bit(3, 0);
    EXPECT_EQ(rig.driven("c"), 0x80u);
}

TEST(Io8255Card, AControlWordSetsAllOutputsLow) {
    Started rig(all_outputs);
    rig.port.out(port_a, 0xFF);
    rig.port.out(port_c, 0xFF);
    rig.set_modes(all_outputs);
    EXPECT_EQ(rig.driven("a"), 0u);
    EXPECT_EQ(rig.driven("c"), 0u);
}

TEST(Io8255Card, RefusesMode2AndKeepsItsOutputs) {
    Started rig(all_outputs);
    rig.port.out(port_a, 0x77);
    rig.port.out(offset("MODE_SET"), 0xC0);
    EXPECT_EQ(rig.driven("a"), 0x77u);
    EXPECT_EQ(rig.card.control_word(), word_of(all_outputs));
    EXPECT_THAT(rig.conditions(), ElementsAre(CardCondition::both_directions));
    EXPECT_THAT(rig.sentence(), HasSubstr("the control word C0h asks for mode 2 of port A"));
}

// ---- mode 1

struct StrobedCase {
    PortGroup group;
    std::uint8_t port;
    const char *letter, *strobe, *flag, *request;
};
constexpr StrobedCase strobed_inputs[] = {{PortGroup::a, port_a, "a", "pc4_in", "pc5", "pc3"},
                                          {PortGroup::b, port_b, "b", "pc2_in", "pc1", "pc0"}};
constexpr StrobedCase strobed_outputs[] = {{PortGroup::a, port_a, "a", "pc6_in", "pc7", "pc3"},
                                           {PortGroup::b, port_b, "b", "pc2_in", "pc1", "pc0"}};

PortModes strobed(PortGroup group, bool input) {
    PortModes out;
    (group == PortGroup::a ? out.a_strobed : out.b_strobed) = true;
    (group == PortGroup::a ? out.a_input : out.b_input) = input;
    return out;
}
void enable(Rig& rig, const StrobedCase& of) {
    rig.bit(static_cast<unsigned>(of.strobe[2] - '0'), 1);
}

TEST(Io8255Handshake, TakesAByteAtTheEndOfAStrobe) {
    for (const StrobedCase& of : strobed_inputs) {
        Started rig(strobed(of.group, true));
        enable(rig, of);
        rig.set_port(of.letter, 0x3C);
        rig.set(of.strobe, 0);
        EXPECT_EQ(rig.level(of.flag), 1) << "IBF";
        EXPECT_EQ(rig.level(of.request), 0) << "the strobe is not over";
        rig.set_port(of.letter, 0xC3);
        rig.set(of.strobe, 1);
        rig.set_port(of.letter, 0x00);
        EXPECT_EQ(rig.level(of.request), 1);
        EXPECT_EQ(rig.level("int"), 1);
        EXPECT_EQ(rig.port.in(of.port), 0xC3);
        EXPECT_EQ(rig.level(of.flag), 0);
        EXPECT_EQ(rig.level(of.request), 0);
        EXPECT_EQ(rig.level("int"), 0);
        EXPECT_THAT(rig.conditions(), IsEmpty());
    }
}

TEST(Io8255Handshake, ReportsAByteThatASecondStrobeOverwrites) {
    for (const StrobedCase& of : strobed_inputs) {
        Started rig(strobed(of.group, true));
        rig.pulse(of.strobe);
        rig.set_port(of.letter, 0x11);
        rig.pulse(of.strobe);
        rig.pulse(of.strobe);
        EXPECT_THAT(rig.conditions(), ElementsAre(CardCondition::byte_lost)) << "once until a read";
        EXPECT_EQ(rig.port.in(of.port), 0x11);
        EXPECT_THAT(rig.sentence(), HasSubstr("before the host had read the byte before, which is lost"));
    }
}

TEST(Io8255Handshake, GivesAByteUntilThePeripheralHasTakenIt) {
    for (const StrobedCase& of : strobed_outputs) {
        Started rig(strobed(of.group, false));
        enable(rig, of);
        EXPECT_EQ(rig.level(of.flag), 1) << "OBF is active low";
        EXPECT_EQ(rig.level(of.request), 1) << "the first byte may be written";
        rig.port.out(of.port, 0x5A);
        EXPECT_EQ(rig.driven(of.letter), 0x5Au);
        EXPECT_EQ(rig.level(of.flag), 0);
        EXPECT_EQ(rig.level(of.request), 0);
        rig.set(of.strobe, 0);
        EXPECT_EQ(rig.level(of.flag), 1);
        EXPECT_EQ(rig.level(of.request), 0) << "ACK is not over";
        rig.set(of.strobe, 1);
        EXPECT_EQ(rig.level(of.request), 1);
        EXPECT_THAT(rig.conditions(), IsEmpty());
    }
}

TEST(Io8255Handshake, ReportsAByteThatTheHostOverwrites) {
    for (const StrobedCase& of : strobed_outputs) {
        Started rig(strobed(of.group, false));
        for (const char byte : {'1', '2', '3'}) rig.port.out(of.port, static_cast<std::uint8_t>(byte));
        EXPECT_THAT(rig.conditions(), ElementsAre(CardCondition::byte_overwritten)) << "once until ACK";
        EXPECT_THAT(rig.sentence(), HasSubstr("before the peripheral had taken the byte before, which is lost"));
    }
}

TEST(Io8255Handshake, RequestsNothingWhileItIsNotEnabled) {
    Started rig(strobed(PortGroup::a, true));
    rig.pulse("pc4_in");
    EXPECT_EQ(rig.level("pc3"), 0);
    rig.bit(4, 1);
    EXPECT_EQ(rig.level("pc3"), 1);
    rig.bit(4, 0);
    EXPECT_EQ(rig.level("pc3"), 0);
}

TEST(Io8255Handshake, ShowsItsStatusInPortC) {
    PortModes modes = strobed(PortGroup::a, true);
    modes.b_strobed = true;
    modes.b_input = false;
    modes.c_upper_input = false;
    Started rig(modes);
    rig.bit(4, 1);
    rig.pulse("pc4_in");
    rig.bit(7, 1);
    // 7: output, 6: output, 5: IBF A, 4: INTE A, 3: INTR A, 2: INTE B, 1: OBF B, 0: INTR B
    EXPECT_EQ(rig.port.in(port_c), 0b1011'1010);
}

TEST(Io8255Handshake, LinesOfAHandshakeAreNotWritten) {
    Started rig(strobed(PortGroup::a, true));
    rig.port.out(port_c, 0xFF);
    EXPECT_EQ(rig.level("pc5"), 0);
    EXPECT_THAT(rig.conditions(), IsEmpty());
    rig.bit(5, 1);
    EXPECT_EQ(rig.level("pc5"), 0);
    EXPECT_THAT(rig.conditions(), ElementsAre(CardCondition::flag_written));
    EXPECT_THAT(rig.sentence(), HasSubstr("line 5 of port C was written"));
}

// ---- stops

TEST(Io8255Stop, SetsOutputsLowUntilTheyAreWrittenLowThenHigh) {
    Started rig(all_outputs);
    rig.port.out(port_a, 0x0F);
    rig.port.out(port_c, 0x80);
    rig.card.clear_outputs();
    rig.kernel.settle();
    EXPECT_EQ(rig.driven("a"), 0u);
    EXPECT_EQ(rig.driven("c"), 0u);
    rig.port.out(port_a, 0xFF);
    EXPECT_EQ(rig.driven("a"), 0xF0u) << "outputs that were low before may be switched on";
    EXPECT_THAT(rig.conditions(), ElementsAre(CardCondition::outputs_held));
    EXPECT_THAT(rig.sentence(), HasSubstr("the outputs of port A with the bits 0Fh stayed low"));
    rig.bit(7, 1);
    EXPECT_EQ(rig.driven("c"), 0u);
    EXPECT_EQ(rig.conditions().size(), 1u) << "reported once a stop";
    rig.port.out(port_a, 0x00);
    rig.port.out(port_a, 0x0F);
    EXPECT_EQ(rig.driven("a"), 0x0Fu);
    rig.bit(7, 0);
    rig.bit(7, 1);
    EXPECT_EQ(rig.driven("c"), 0x80u);
}

TEST(Io8255Stop, AControlWordReleasesNoOutput) {
    Started rig(all_outputs);
    rig.port.out(port_a, 0x0F);
    rig.port.out(port_c, 0x80);
    rig.card.clear_outputs();
    rig.set_modes(all_outputs);
    rig.set_modes({});
    rig.set_modes(all_outputs);
    rig.port.out(port_a, 0xFF);
    EXPECT_EQ(rig.driven("a"), 0xF0u) << "a word from before the stop";
    rig.bit(7, 1);
    EXPECT_EQ(rig.driven("c"), 0u);
    EXPECT_THAT(rig.conditions(), ElementsAre(CardCondition::outputs_held)) << "once a stop, not once a control word";
    rig.port.out(port_a, 0x00);
    rig.port.out(port_a, 0x0F);
    EXPECT_EQ(rig.driven("a"), 0x0Fu);
}

TEST(Io8255Stop, DiscardsTheByteThatAPeripheralHasNotTaken) {
    for (const StrobedCase& of : strobed_outputs) {
        Started rig(strobed(of.group, false));
        enable(rig, of);
        rig.port.out(of.port, 0x77);
        rig.card.clear_outputs();
        rig.kernel.settle();
        EXPECT_EQ(rig.driven(of.letter), 0u);
        EXPECT_EQ(rig.level(of.flag), 1) << "OBF: the 0 on the lines is no byte";
        EXPECT_EQ(rig.level(of.request), 1) << "the handshake goes on";
        EXPECT_THAT(rig.conditions(), ElementsAre(CardCondition::byte_discarded));
        EXPECT_THAT(rig.sentence(), HasSubstr("discarded the byte at port "));
        rig.card.clear_outputs();
        EXPECT_EQ(rig.conditions().size(), 1u) << "no byte waits";
    }
}

TEST(Io8255Stop, KeepsReceivedBytes) {
    for (const StrobedCase& of : strobed_inputs) {
        Started rig(strobed(of.group, true));
        enable(rig, of);
        rig.set_port(of.letter, 0x3C);
        rig.pulse(of.strobe);
        rig.card.clear_outputs();
        rig.kernel.settle();
        EXPECT_EQ(rig.level(of.flag), 1) << "IBF";
        EXPECT_EQ(rig.level("int"), 1);
        EXPECT_EQ(rig.port.in(of.port), 0x3C);
        EXPECT_THAT(rig.conditions(), IsEmpty());
    }
}

TEST(Io8255Stop, PutsOutWholeBytesAfterwards) {
    for (const StrobedCase& of : strobed_outputs) {
        Started rig(strobed(of.group, false));
        rig.port.out(of.port, 0x77);
        rig.pulse(of.strobe);
        rig.card.clear_outputs();
        rig.kernel.settle();
        EXPECT_EQ(rig.driven(of.letter), 0u);
        rig.port.out(of.port, 0x73);
        EXPECT_EQ(rig.driven(of.letter), 0x73u);
        EXPECT_EQ(rig.level(of.flag), 0);
        EXPECT_THAT(rig.conditions(), IsEmpty()) << "the byte before the stop had been taken";
    }
}

TEST(Io8255Stop, HandsOverNoByteWithABitThatItHolds) {
    for (const StrobedCase& of : strobed_outputs) {
        Started rig(all_outputs);
        rig.port.out(of.port, 0x0F);
        rig.card.clear_outputs();
        rig.set_modes(strobed(of.group, false));
        rig.port.out(of.port, 0xF3);
        EXPECT_EQ(rig.driven(of.letter), 0u);
        EXPECT_EQ(rig.level(of.flag), 1) << "OBF";
        EXPECT_THAT(rig.conditions(), ElementsAre(CardCondition::byte_refused));
        EXPECT_THAT(rig.sentence(), HasSubstr("was not put out: its bits 03h stay low"));
        rig.port.out(of.port, 0x0C);
        EXPECT_EQ(rig.driven(of.letter), 0x0Cu) << "the byte before had these bits low";
        EXPECT_EQ(rig.level(of.flag), 0);
        EXPECT_EQ(rig.conditions().size(), 1u);
    }
}

// ---- time

TEST(Io8255Card, NothingAllocates) {
    Started rig(strobed(PortGroup::a, true));
    const sim::WireId strobe = rig.kernel.find_wire("c1.pc4_in");
    unsigned read = 0;
    const std::uint64_t before = sim::allocations();
    for (int i = 0; i < 1'000; ++i) {
        rig.kernel.set_wire(strobe, 0);
        rig.kernel.settle();
        rig.kernel.set_wire(strobe, 1);
        rig.kernel.settle();
        read += rig.port.in(port_a);
    }
    EXPECT_EQ(sim::allocations(), before);
    EXPECT_EQ(read, 255'000u);
}

TEST(Io8255Card, APeekChangesNothing) {
    Started rig(strobed(PortGroup::a, true));
    rig.pulse("pc4_in");
    const std::uint64_t hash = rig.kernel.state_hash();
    for (unsigned port = 0; port < 256; ++port) rig.card.peek(static_cast<std::uint8_t>(port));
    EXPECT_EQ(rig.kernel.state_hash(), hash);
}

}  // namespace
}  // namespace motionrack::io8255
