// The IO8255 in a rack: wired to switches, to another card and to outputs, and stopped with the machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/io8255/map.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/stop_reactions.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <tests/source_root.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;

constexpr io8255::PortModes a_reads = {
    .a_input = true, .c_upper_input = false, .b_input = false, .c_lower_input = false};

/// A card "desk" whose port A is an input and whose other ports are outputs.
struct DeskBench {
    explicit DeskBench(const std::string& text = "[card.desk]\ntype = \"io8255\"\n")
        : session(std::move(*Session::open(text))) {
        write("MODE_SET", io8255::word_of(a_reads));
    }
    static std::uint32_t offset(std::string_view name) {
        for (const RegisterInfo& each : io8255::card_map().registers)
            if (each.name == name) return each.offset;
        ADD_FAILURE() << name;
        return 0;
    }
    void write(const char* name, unsigned value) {
        ASSERT_TRUE(session->write("desk", 8, offset(name), value));
        ASSERT_TRUE(session->advance(1'000));
    }
    std::uint32_t read(const char* name) { return *session->read("desk", 8, offset(name)); }
    double wire(const std::string& name) { return *session->wire(name); }

    std::unique_ptr<Session> session;
};

std::string desk_example() {
    return (source_root / "examples/io8255/desk.toml").string();
}

TEST(Io8255InARack, ReadsSwitchesAndOutputsOfOtherCards) {
    DeskBench bench(desk_example());
    for (const int level : {0, 1}) {
        ASSERT_TRUE(bench.session->set_wire("X.home", level));
        ASSERT_TRUE(bench.session->write("motion", 16, mcx314::reg::WR4, level == 0 ? 0xFFFF : 0));
        ASSERT_TRUE(bench.session->advance(10'000));
        EXPECT_EQ(bench.read("PORT_A") & 1, static_cast<unsigned>(level)) << "X.home";
        EXPECT_EQ(bench.read("PORT_A") >> 3 & 1, 1u - static_cast<unsigned>(level)) << "motion.xout0";
    }
}

TEST(Io8255InARack, DrivesWiresToOtherCards) {
    DeskBench bench(desk_example());
    bench.write("OUT_B", 0x81);
    EXPECT_EQ(bench.wire("desk.pb7"), 1);
    EXPECT_EQ(bench.wire("motion.xin1"), 1);
    bench.write("OUT_B", 0x80);
    EXPECT_EQ(bench.wire("motion.xin1"), 0);
    EXPECT_EQ(*bench.session->peek("desk", "PORT_B"), 0x80);
    EXPECT_EQ(*bench.session->peek("desk", "CONTROL_WORD"), io8255::word_of(a_reads));
}

TEST(Io8255InARack, SwitchesSignalLamps) {
    DeskBench bench(desk_example());
    const auto lit = [&](const char* lamp) { return *bench.session->part(std::string(lamp) + ".lit"); };
    unsigned line = 5;
    for (const char* lamp : {"green", "yellow", "red"}) {
        EXPECT_EQ(lit(lamp), 0) << lamp;
        bench.write("OUT_B", 1u << line++);
        EXPECT_EQ(lit(lamp), 1) << lamp;
    }
    react(bench.session->rack(), StopSource::emergency_stop);
    ASSERT_TRUE(bench.session->advance(1'000));
    EXPECT_EQ(lit("red"), 0);
}

TEST(Io8255InARack, ItsInterruptWakesTheHostAtTheEndOfAStrobe) {
    DeskBench bench;
    io8255::PortModes modes;
    modes.a_strobed = true;
    bench.write("MODE_SET", io8255::word_of(modes));
    bench.write("BIT", 4 << 1 | 1);  // INTE of group A
    EXPECT_FALSE(*bench.session->wait("desk", 1'000'000));
    ASSERT_TRUE(bench.session->set_wire("desk.pc4_in", 0));
    EXPECT_FALSE(*bench.session->wait("desk", 1'000'000));
    ASSERT_TRUE(bench.session->set_wire("desk.pc4_in", 1));
    EXPECT_TRUE(*bench.session->wait("desk", 1'000'000));
    EXPECT_EQ(bench.read("PORT_A"), 0xFFu);
    EXPECT_FALSE(*bench.session->wait("desk", 1'000'000));
}

TEST(Io8255InARack, EveryStopSetsItsOutputsLowUntilTheyAreWrittenLow) {
    for (const StopSource source : stop_sources) {
        DeskBench bench;
        bench.write("OUT_B", 0x03);
        bench.write("OUT_C", 0x10);
        react(bench.session->rack(), source);
        ASSERT_TRUE(bench.session->advance(1'000));
        for (const char* wire : {"desk.pb0", "desk.pb1", "desk.pc4"}) EXPECT_EQ(bench.wire(wire), 0) << wire;
        bench.write("OUT_B", 0x03);
        EXPECT_EQ(bench.wire("desk.pb0"), 0);
        bench.write("OUT_B", 0x02);
        bench.write("OUT_B", 0x03);
        EXPECT_EQ(bench.wire("desk.pb0"), 1);
        EXPECT_EQ(bench.wire("desk.pb1"), 0);
        const auto conditions = bench.session->rack().kernel().conditions();
        ASSERT_EQ(conditions.size(), 1U) << name_of(source);
        EXPECT_THAT(bench.session->rack().describe(conditions.front()), HasSubstr("card desk: at 0.00000"))
            << name_of(source);
    }
}

TEST(Io8255InARack, RefusesAccessesThatItsBusDoesNotHave) {
    DeskBench bench;
    EXPECT_THAT(bench.session->read("desk", 16, 0).error().message, HasSubstr("accesses of 8 bits"));
    EXPECT_THAT(bench.session->read("desk", 8, 3).error().message, HasSubstr("registers are from 0x00 to 0x02"));
    EXPECT_THAT(bench.session->write("desk", 8, 4, 0).error().message, HasSubstr("registers are from 0x00 to 0x03"));
    EXPECT_THAT(bench.session->peek("desk", "PORT_D").error().message, HasSubstr("CONTROL_WORD, PORT_A"));
}

TEST(Io8255InARack, ACopyOfTheRackContinuesIdentically) {
    DeskBench bench(desk_example());
    bench.write("OUT_B", 0x55);
    const auto copy = *bench.session->copy();
    ASSERT_TRUE(bench.session->advance(1'000'000));
    ASSERT_TRUE(copy->advance(1'000'000));
    EXPECT_EQ(bench.session->state_hash(), copy->state_hash());
    EXPECT_EQ(*copy->wire("desk.pb0"), 1);
}

}  // namespace
}  // namespace motionrack::rack
