// The function library: its exact traffic on a scripted port, and its behaviour with the virtual card.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/io8255/driver/port_driver.hpp>
#include <motionrack/cards/io8255/test/rig.hpp>
#include <motionrack/cards/io8255/test/scripted_port.hpp>

namespace motionrack::io8255 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr PortModes a_sends = {.a_strobed = true, .a_input = false};
constexpr PortModes a_receives = {.a_strobed = true, .a_input = true};
constexpr Duration one_second = whole_seconds(1);

// ---- exact traffic

TEST(PortDriverTraffic, SetsModesThenInterruptsOfStrobedGroups) {
    ScriptedPort port;
    PortDriver card(port, port);
    card.set_modes(all_outputs);
    card.set_modes(a_sends);
    card.set_modes(a_receives);
    card.set_modes({.b_strobed = true});
    EXPECT_THAT(port.traffic, ElementsAre("W 3=80", "W 3=AB", "W 3=0D", "W 3=BB", "W 3=09", "W 3=9F", "W 3=05"));
}

TEST(PortDriverTraffic, AccessesPortsAndLines) {
    ScriptedPort port;
    port.answers = {0x12};
    PortDriver card(port, port);
    card.write(IoPort::b, 0x34);
    EXPECT_EQ(card.read(IoPort::c), 0x12);
    card.set_line(6, true);
    card.set_line(0, false);
    EXPECT_THAT(port.traffic, ElementsAre("W 1=34", "R 2", "W 3=0D", "W 3=00"));
}

TEST(PortDriverTraffic, ReadsTheStatusUntilThePeripheralIsReady) {
    ScriptedPort port;
    PortDriver card(port, port, microseconds(50));
    card.set_modes(a_sends);
    port.traffic.clear();
    port.answers = {0x00, 0x80, 0x88};
    ASSERT_TRUE(card.send(PortGroup::a, 0x41, one_second));
    EXPECT_THAT(port.traffic, ElementsAre("R 2", "R 2", "R 2", "W 0=41"));
    EXPECT_EQ(port.time, microseconds(100));
}

// ---- errors

TEST(PortDriver, RefusesBytesThroughPortsThatAreNotStrobedThatWay) {
    ScriptedPort port;
    PortDriver card(port, port);
    card.set_modes(a_sends);
    port.traffic.clear();
    const auto read = card.receive(PortGroup::a, one_second);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::refused);
    EXPECT_EQ(read.error().message, "Port A is not an input in mode 1. Nothing was read; call set_modes first.");
    const auto sent = card.send(PortGroup::b, 1, one_second);
    ASSERT_FALSE(sent);
    EXPECT_THAT(sent.error().message, HasSubstr("Port B is not an output in mode 1"));
    EXPECT_TRUE(port.traffic.empty());
}

TEST(PortDriver, ReportsAPeripheralThatDoesNotAnswer) {
    ScriptedPort port;
    PortDriver card(port, port);
    card.set_modes(a_sends);
    const auto sent = card.send(PortGroup::a, 1, milliseconds(20));
    ASSERT_FALSE(sent);
    EXPECT_EQ(sent.error().kind, ErrorKind::machine);
    EXPECT_EQ(sent.error().message,
              "The peripheral at port A did not take the byte before (ACK) within 0.02 s. Nothing was written.");
    EXPECT_EQ(port.time, milliseconds(20));
    card.set_modes(a_receives);
    const auto read = card.receive(PortGroup::a, Duration{0});
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("sent no byte (STB)"));
}

TEST(PortDriver, EndsAWaitWhenAStopIsRequested) {
    ScriptedPort port;
    PortDriver card(port, port);
    card.set_modes(a_receives);
    port.stop = true;
    const auto read = card.receive(PortGroup::a, never);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::stopped);
}

// ---- with the virtual card

TEST(PortDriverOnTheCard, SendsABytePerAcknowledge) {
    Rig rig(microseconds(1));
    rig.start();
    PortDriver card(rig.port, rig.port);
    card.set_modes(a_sends);
    for (const unsigned byte : {0x41u, 0x42u, 0x43u}) {
        ASSERT_TRUE(card.send(PortGroup::a, static_cast<std::uint8_t>(byte), milliseconds(1)));
        EXPECT_EQ(rig.driven("a"), byte);
        EXPECT_FALSE(card.send(PortGroup::a, 0, milliseconds(1))) << "not taken yet";
        rig.pulse("pc6_in");
    }
    EXPECT_TRUE(rig.conditions().empty());
}

TEST(PortDriverOnTheCard, ReceivesABytePerStrobe) {
    Rig rig(microseconds(1));
    rig.start();
    PortDriver card(rig.port, rig.port);
    card.set_modes(a_receives);
    for (const unsigned byte : {0x41u, 0x42u, 0x43u}) {
        rig.set_port("a", byte);
        rig.set("pc4_in", 0);
        EXPECT_FALSE(card.receive(PortGroup::a, milliseconds(1))) << "the strobe is not over";
        rig.set("pc4_in", 1);
        const auto read = card.receive(PortGroup::a, milliseconds(1));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, byte);
    }
    EXPECT_TRUE(rig.conditions().empty());
}

}  // namespace
}  // namespace motionrack::io8255
