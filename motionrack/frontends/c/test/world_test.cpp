// Complete racks over the C interface: copies, hashes, registers by name, recordings; and the same rack over C++.
#include <gmock/gmock.h>

#include <filesystem>
#include <motionrack/frontends/c/test/world.hpp>
#include <motionrack/rack/session.hpp>
#include <string>
#include <utility>

namespace motionrack::c_test {
namespace {

using ::testing::HasSubstr;

/// Motion on several axes: an arc of X and Y, a drive of U with its index input monitored.
void begin_motion(World& world) {
    world.set_up(0xF, 2000);
    world.command(1, 0x06, 0);
    world.command(2, 0x06, 0);
    world.command(1, 0x08, 3000);
    world.command(2, 0x08, 0);
    world.write(0x0A, 0x0004);  // WR5: X and Y
    world.write(0x00, 0x0032);
    world.command(8, 0x06, 5000);
    world.write(0x00, 0x0821);
}

// ---- copies and hashes

TEST(CRack, TheSameCallsGiveTheSameEventTrace) {
    World a, b;
    begin_motion(a);
    begin_motion(b);
    for (World* world : {&a, &b}) world->pass(123'456'789);
    EXPECT_EQ(a.hash(), b.hash());
    b.pass(250);
    EXPECT_NE(a.hash(), b.hash());
}

TEST(CRack, TheDivisionOfTimeDoesNotMatter) {
    World whole, cut;
    begin_motion(whole);
    begin_motion(cut);
    whole.pass(500'000'000);
    for (int i = 0; i < 5'000; ++i) cut.pass(100'000);
    EXPECT_EQ(whole.hash(), cut.hash());
    EXPECT_EQ(whole.peek("x.LP"), cut.peek("x.LP"));
}

TEST(CRack, ACopyIsIndependentAndContinuesIdentically) {
    World world;
    begin_motion(world);
    world.pass(80'000'000);
    world.set("c1.zin1", 0);
    world.set("c1.yeca", 1);
    World copy(world.rack);
    const std::uint64_t at_copy = copy.hash();
    EXPECT_EQ(at_copy, world.hash());
    world.set("c1.xlmtp", 0);
    world.pass(1'000'000);
    EXPECT_EQ(copy.hash(), at_copy) << "what is done to one does nothing to the other";
    EXPECT_EQ(copy.wire("c1.xlmtp"), 1);
    copy.set("c1.xlmtp", 0);
    copy.pass(1'000'000);
    EXPECT_EQ(copy.hash(), world.hash());
    for (World* each : {&world, &copy}) {
        each->set("c1.yeca", nan_value);
        each->set("c1.xlmtp", nan_value);
        each->pass(700'000'000);
    }
    EXPECT_EQ(copy.hash(), world.hash());
    EXPECT_EQ(copy.peek("u.LP"), -5000);
    World third(copy.rack);
    mr_rack_close(copy.rack);
    copy.rack = nullptr;
    third.pass(1000);
    EXPECT_EQ(third.peek("u.LP"), -5000);
}

/// The same motion over C, over the Session below it and over a plain rack: the same event trace and the same position.
TEST(CRack, HasTheEventTraceOfTheCppRack) {
    World world;
    begin_motion(world);
    world.pass(900'000'000);

    const auto session = *rack::Session::open(one_card, rack::Session::Programs::yes);
    rack::Rack rack(*rack::read_rack_text(one_card).config);
    rack.start();
    sim::VirtualPort& port = *rack.cards()[0]->port();
    const auto write = [&](std::uint32_t offset, unsigned value) {
        port.write(offset, static_cast<std::uint16_t>(value));
        EXPECT_TRUE(session->write("c1", 16, offset, value));
    };
    const auto command = [&](unsigned axes, unsigned code, std::uint32_t value) {
        write(0x0E, value >> 16);
        write(0x0C, value & 0xFFFF);
        write(0x00, axes << 8 | code);
    };
    for (const auto& [code, value] : {std::pair{0x00u, 800'000u}, {0x02u, 400u}, {0x04u, 10u}, {0x05u, 2000u}})
        command(0xF, code, value);
    command(1, 0x06, 0);
    command(2, 0x06, 0);
    command(1, 0x08, 3000);
    command(2, 0x08, 0);
    write(0x0A, 0x0004);
    write(0x00, 0x0032);
    command(8, 0x06, 5000);
    write(0x00, 0x0821);
    port.pass(milliseconds(900));
    EXPECT_TRUE(session->advance(900'000'000));

    EXPECT_EQ(mr_now_ns(world), static_cast<std::uint64_t>(rack.kernel().now().count() / 10));
    EXPECT_EQ(world.hash(), session->state_hash());
    EXPECT_EQ(session->rack().kernel().trace_hash(), rack.kernel().trace_hash());
    for (std::size_t i = 0; i < 4; ++i) {
        const auto channel = std::string(1, "xyzu"[i]), axis = std::string(1, "XYZA"[i]);
        EXPECT_EQ(world.peek((channel + ".LP").c_str()), rack.cards()[0]->motion()->pulse_counter(static_cast<int>(i)));
        EXPECT_EQ(world.part((axis + (i < 3 ? ".position_mm" : ".position_deg")).c_str()),
                  rack.axes()[i].machine->position(rack.kernel().now()));
    }
    EXPECT_EQ(world.peek("u.LP"), -5000);
}

// ---- registers by name

TEST(CRack, EveryRegisterOfTheMapCanBePeekedOrIsRejectedByName) {
    World world;
    int known = 0;
    for (const RegisterInfo& reg : rack::find_card_plugin("mcx314")->map().registers) {
        const std::string name = (reg.per_axis ? "y." : "") + std::string(reg.name);
        std::uint64_t value = 0;
        if (mr_peek(world, "c1", name.c_str(), &value) == MR_OK)
            ++known;
        else
            EXPECT_THAT(mr_last_error(), HasSubstr(name));
    }
    EXPECT_GE(known, 15);
}

TEST(CRack, PeeksReadEachAxisIndependentlyOfTheBus) {
    World world;
    world.command(1, 0x06, 11);
    world.command(2, 0x06, 22);
    world.write(0x00, 0x010F);
    world.write(0x02, 0x0012);  // WR1 of X
    EXPECT_EQ(world.peek("x.P"), 11);
    EXPECT_EQ(world.peek("y.P"), 22);
    EXPECT_EQ(world.peek("x.WR1"), 0x12);
    EXPECT_EQ(world.peek("y.WR1"), 0);
    world.command(1, 0x09, 0xFFFF'FFFE);
    EXPECT_EQ(world.peek("x.LP"), -2);
    const std::uint64_t before = world.hash();
    for (const char* name : {"RR0", "RR1", "x.RR3", "RR3", "WR7", "u.CV"}) world.peek(name);
    EXPECT_EQ(world.hash(), before) << "looking changes nothing";
    std::uint64_t value = 77;
    for (const char* name : {"RR9", "", "x.", "v.RR1", "x.RR0", "x.WR4", "LP", "x.RR1 ", "X.RR1", "WR1"}) {
        EXPECT_EQ(mr_peek(world, "c1", name, &value), MR_BAD_CALL) << name;
        EXPECT_THAT(mr_last_error(), HasSubstr("COMP_PLUS"));
    }
    EXPECT_EQ(mr_peek(world, "X", "RR0", &value), MR_BAD_CALL);
    EXPECT_EQ(value, 77u);
}

// ---- recordings

TEST(CRack, RecordsSignalsAtAnyTime) {
    const std::string csv = temporary("a.csv"), vcd = temporary("b.vcd");
    World world;
    world.set_up(1, 4000);
    world.command(1, 0x06, 500);
    world.write(0x00, 0x0120);
    world.pass(1'000'000'000);
    ASSERT_EQ(mr_trace_start(world, csv.c_str(), "X.step, c1.xpp c1.xlp c1.xlmtp"), MR_OK) << mr_last_error();
    EXPECT_EQ(mr_trace_start(world, vcd.c_str(), nullptr), MR_REFUSED) << "one at a time";
    world.write(0x00, 0x0120);
    world.pass(500'000'000);
    world.set("c1.xlmtp", 0);
    world.pass(500'000'000);
    ASSERT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    EXPECT_EQ(mr_trace_stop(world), MR_REFUSED);
    const std::string text = text_of_file(csv);
    EXPECT_EQ(count_of(text, ",X.step,1\r\n"), 500);
    EXPECT_EQ(count_of(text, ",c1.xpp,1\r\n"), 500) << "the pin itself";
    EXPECT_EQ(count_of(text, ",c1.xlp,500\r\n"), 1) << "where it began";
    EXPECT_EQ(count_of(text, ",c1.xlp,1000\r\n"), 1) << "where it ended";
    EXPECT_EQ(count_of(text, "1.5000"), 1) << "the limit, by hand";

    ASSERT_EQ(mr_trace_start(world, vcd.c_str(), ""), MR_OK) << mr_last_error();
    world.set("c1.xlmtp", nan_value);
    world.write(0x00, 0x0120);
    world.pass(1'000'000'000);
    mr_rack_close(world.rack);  // ends the recording
    world.rack = nullptr;
    const std::string waves = text_of_file(vcd);
    EXPECT_EQ(count_of(waves, "$scope module c1 $end"), 1);
    EXPECT_THAT(waves, HasSubstr("X_step"));
    EXPECT_THAT(waves, HasSubstr("#2000")) << "times are the rack's";
    EXPECT_GT(count_of(waves, "\n#"), 1000);
    std::filesystem::remove(csv);
    std::filesystem::remove(vcd);
}

TEST(CRack, RecordsWithATimescaleThatResolvesEveryEdgeOrTheRequestedOne) {
    const std::string vcd = temporary("u.vcd");
    World world;
    const auto unit_in = [&](World& of, const char* signals) {
        EXPECT_EQ(mr_trace_start(of, vcd.c_str(), signals), MR_OK) << mr_last_error();
        of.pass(1'000);
        EXPECT_EQ(mr_trace_stop(of), MR_OK) << mr_last_error();
        const std::string text = text_of_file(vcd);
        const std::size_t at = text.find("$timescale ");
        return text.substr(at + 11, text.find(" $end", at) - at - 11);
    };
    const auto unit_of = [&](const char* signals) { return unit_in(world, signals); };
    EXPECT_EQ(unit_of("X.step"), "100 ns");
    ASSERT_EQ(mr_trace_unit(world, 0.1), MR_OK) << mr_last_error();
    EXPECT_EQ(unit_of("X.step"), "100 ps");
    ASSERT_EQ(mr_trace_unit(world, 1'000), MR_OK) << mr_last_error();
    EXPECT_EQ(unit_of("X.step"), "1 us");
    World copy(world.rack);
    EXPECT_EQ(unit_in(copy, "X.step"), "1 us") << "a copy records as the first does";
    for (const double wrong : {-1.0, 125.0, 0.05, 0.12, 1e300, nan_value})
        EXPECT_EQ(mr_trace_unit(world, wrong), MR_REFUSED) << wrong;
    EXPECT_EQ(unit_of("X.step"), "1 us") << "a refusal changes nothing";
    ASSERT_EQ(mr_trace_unit(world, 0), MR_OK) << mr_last_error();
    EXPECT_EQ(unit_of("X.step"), "100 ns");
    std::filesystem::remove(vcd);
}

TEST(CRack, RecordsAGratingBusFrameWithATimescaleThatResolvesEachWait) {
    const std::string vcd = temporary("frame.vcd");
    World world("[card.c1]\ntype = \"grating_bus\"\nscales = 2\n");
    ASSERT_EQ(mr_trace_start(world, vcd.c_str(), "bus.read_n bus.hold"), MR_OK) << mr_last_error();
    world.pass(201'000);
    ASSERT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    const std::string waves = text_of_file(vcd);
    EXPECT_THAT(waves, HasSubstr("$timescale 10 ns $end"));
    // The frame of 200 us: READ falls after T1 = 20 ns, rises T2 + T3 = 60 ns later; the next word comes 110 ns later.
    std::size_t at = 0;
    for (const char* instant : {"\n#20000\n", "\n#20002\n", "\n#20008\n", "\n#20013\n", "\n#20019\n", "\n#20023\n"}) {
        at = waves.find(instant, at);
        ASSERT_NE(at, std::string::npos) << instant;
    }
    std::filesystem::remove(vcd);
}

TEST(CRack, RecordsNumbersAsRealsAndVoltagesInVolts) {
    const std::string vcd = temporary("v.vcd"), csv = temporary("v.csv");
    for (const std::string& path : {vcd, csv}) {
        World world("card.c1 = \"databoard4002\"");
        ASSERT_EQ(mr_trace_start(world, path.c_str(), "c1.vout c1.relay"), MR_OK) << mr_last_error();
        for (const auto& [port, value] : {std::pair{1u, 13u},
                                          {3u, 'R'},
                                          {0u, 16'021 & 0xFFu},
                                          {0u, 16'021u >> 8},
                                          {3u, 'N'},
                                          {0u, 0u},
                                          {0u, 100u},
                                          {0u, 0u},
                                          {3u, 'G'}}) {
            EXPECT_EQ(mr_write8(world, "c1", port, static_cast<std::uint8_t>(value)), MR_OK) << mr_last_error();
            world.pass(200'000);
        }
        EXPECT_EQ(world.wire("c1.vout"), 1);
        ASSERT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    }
    const std::string waves = text_of_file(vcd);
    EXPECT_THAT(waves, HasSubstr("$var real 64 "));
    EXPECT_THAT(waves, HasSubstr("\nr1 "));
    EXPECT_EQ(count_of(waves, "\nb"), 0) << "sigrok stops at vectors";
    EXPECT_EQ(count_of(text_of_file(csv), ",c1.vout,1\r\n"), 1);
    std::filesystem::remove(vcd);
    std::filesystem::remove(csv);
}

TEST(CRack, ReportsConditionsWithTheirInstants) {
    struct Told {
        std::uint64_t number;
        std::int64_t at;
        std::string card, sentence;
    };
    std::vector<Told> reported;
    const auto keep = [](void* user, uint64_t number, int64_t at, const char* card, int, const char* sentence) {
        static_cast<std::vector<Told>*>(user)->push_back({number, at, card, sentence});
    };
    World world("card.p1 = \"ioflex02\"");
    world.pass(10'000);
    ASSERT_EQ(mr_conditions(world, 0, keep, &reported), MR_OK) << mr_last_error();
    EXPECT_TRUE(reported.empty());
    world.set("p1.a2", 1);
    world.set("p1.b2", 1);
    world.pass(10'000);
    ASSERT_EQ(mr_conditions(world, 0, keep, &reported), MR_OK) << mr_last_error();
    ASSERT_EQ(reported.size(), 1u);
    EXPECT_EQ(reported[0].number, 1u);
    EXPECT_NEAR(static_cast<double>(reported[0].at), 10'000 * 10, 2'000) << "in 100 ps";
    EXPECT_EQ(reported[0].card, "p1");
    EXPECT_THAT(reported[0].sentence, HasSubstr("2"));
    ASSERT_EQ(mr_conditions(world, 1, keep, &reported), MR_OK);
    EXPECT_EQ(reported.size(), 1u) << "those after number 1";
    EXPECT_EQ(mr_conditions(world, 0, nullptr, nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_conditions(nullptr, 0, keep, &reported), MR_BAD_CALL);
}

TEST(CRack, HasAVersion) {
    EXPECT_THAT(mr_version(), testing::MatchesRegex("[0-9]+[.][0-9]+[.][0-9]+"));
}

TEST(CRack, RecordingWiresAndPulsesDoesNotAffectTheMotion) {
    const std::string csv = temporary("c.csv");
    World watched, alone;
    ASSERT_EQ(mr_trace_start(watched, csv.c_str(), "*"), MR_OK);
    for (World* world : {&watched, &alone}) {
        begin_motion(*world);
        world->pass(200'000'000);
        EXPECT_GT(world->peek("x.CV"), 0);
    }
    World copy(watched.rack);
    EXPECT_EQ(copy.hash(), watched.hash());
    for (World* world : {&watched, &alone, &copy}) world->pass(1'300'000'000);
    EXPECT_EQ(mr_trace_stop(watched), MR_OK);
    EXPECT_EQ(mr_trace_stop(copy), MR_REFUSED) << "the recording stayed with the first";
    for (const char* name : {"x.LP", "y.LP", "u.LP", "x.EP", "RR0", "x.RR1"}) {
        EXPECT_EQ(watched.peek(name), alone.peek(name)) << name;
        EXPECT_EQ(copy.peek(name), alone.peek(name)) << name;
    }
    std::filesystem::remove(csv);
}

TEST(CRack, RecordingsThatCannotBeCreatedAreRejected) {
    World world;
    EXPECT_EQ(mr_trace_start(world, "a.txt", nullptr), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr(".h5"));
    EXPECT_EQ(mr_trace_start(world, "", nullptr), MR_REFUSED);
    EXPECT_EQ(mr_trace_start(world, nullptr, nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_trace_start(world, "/no/such/folder/a.vcd", nullptr), MR_IO);
    const std::string vcd = temporary("d.vcd");
    EXPECT_EQ(mr_trace_start(world, vcd.c_str(), "Q.* nothing"), MR_BAD_CALL);
    EXPECT_THAT(mr_last_error(), HasSubstr("Q.*"));
    EXPECT_FALSE(std::filesystem::exists(vcd));
    EXPECT_EQ(mr_trace_stop(world), MR_REFUSED);
    World copy(world.rack);
    EXPECT_EQ(copy.hash(), world.hash()) << "nothing was left behind";
}

TEST(CRack, ARecordingThatCannotStartDoesNotChangeTheRack) {
    World world;
    begin_motion(world);
    world.pass(123'456'789);
    World copy(world.rack);
    const std::uint64_t before = world.hash();
    const std::string vcd = temporary("h.vcd"), nowhere = "/no/such/folder/a.vcd";
    const std::pair<const char*, const char*> starts[] = {{nowhere.c_str(), nullptr},
                                                          {nowhere.c_str(), "X.*,A.* c1.*"},
                                                          {nowhere.c_str(), "c1.xpp"},
                                                          {vcd.c_str(), "Q.*"},
                                                          {"a.txt", "X.*"},
                                                          {"/no/such/folder/a.h5", ""}};
    for (const auto& [path, signals] : starts) {
        EXPECT_NE(mr_trace_start(world, path, signals), MR_OK) << path;
        EXPECT_EQ(world.hash(), before) << path << ": " << mr_last_error();
    }
    for (World* each : {&world, &copy}) each->pass(700'000'000);
    EXPECT_EQ(world.hash(), copy.hash());
    EXPECT_FALSE(std::filesystem::exists(vcd));
}

TEST(CRack, NullPointersAreBadCalls) {
    World world;
    double value = 0;
    std::uint64_t word = 0;
    mr_rack* copy = nullptr;
    EXPECT_EQ(mr_peek(nullptr, "c1", "RR0", &word), MR_BAD_CALL);
    EXPECT_EQ(mr_peek(world, nullptr, "RR0", &word), MR_BAD_CALL);
    EXPECT_EQ(mr_peek(world, "c1", nullptr, &word), MR_BAD_CALL);
    EXPECT_EQ(mr_peek(world, "c1", "RR0", nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_wire_get(nullptr, "estop", &value), MR_BAD_CALL);
    EXPECT_EQ(mr_wire_get(world, nullptr, &value), MR_BAD_CALL);
    EXPECT_EQ(mr_wire_get(world, "estop", nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_wire_set(nullptr, "estop", 0), MR_BAD_CALL);
    EXPECT_EQ(mr_wire_set(world, nullptr, 0), MR_BAD_CALL);
    EXPECT_EQ(mr_part_get(nullptr, "X.in_step", &value), MR_BAD_CALL);
    EXPECT_EQ(mr_part_get(world, nullptr, &value), MR_BAD_CALL);
    EXPECT_EQ(mr_part_get(world, "X.in_step", nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_part_set(nullptr, "X.position_mm", 0), MR_BAD_CALL);
    EXPECT_EQ(mr_part_set(world, nullptr, 0), MR_BAD_CALL);
    EXPECT_EQ(mr_snapshot(nullptr, &copy), MR_BAD_CALL);
    EXPECT_EQ(mr_snapshot(world, nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_trace_start(nullptr, "a.vcd", nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_trace_stop(nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_state_hash(nullptr), 0u);
}

}  // namespace
}  // namespace motionrack::c_test
