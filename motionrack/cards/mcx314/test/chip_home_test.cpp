// The automatic home search of the MCX314As: on a simulated axis with bouncing switches and an encoder's index, and
// with switches operated by the test where the order of events matters.
//
//   machine   0 mm ─────4──5────────20──────────────────100 mm        index each 5 mm from the start
//   IN1       active ◄──┘           │                    start
//   IN0       active ◄──────────────┘
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/wire_connections.hpp>
#include <vector>

namespace motionrack::mcx314::outside {
namespace {

constexpr unsigned steps_minus_minus_plus_plus = 0x5F;  // ST1E, ST1D, ST2E, ST2D, ST3E, ST4E
constexpr unsigned clear_counters = field("EM7", "PCLR").mask, z_within_in1 = field("EM7", "SAND").mask,
                   limit_is_home = field("EM7", "LIMIT").mask, clear_pulse = field("EM7", "DCCE").mask;
constexpr unsigned home_interrupt = field("EM6", "HMINT").mask, slow_filters = 0x8100;  // FE0, 2.048 ms

unsigned hmst(Bench& b, unsigned axis) {
    return field("RR2", "HMST").get(b.status(axis, 2));
}

parts::AxisMechanicsSettings machine_settings(double start_mm, double in1_mm) {
    parts::AxisMechanicsSettings s;
    s.motor.start_stop_hz = 8'000;
    s.encoder.counts_per_rev = 4000;
    s.axle.initial_position = start_mm;
    s.home.position = 20;
    s.limit_minus.position = in1_mm;
    return s;
}

// A machine with 640 pulses per mm on axis X.
struct Homing : Bench {
    Homing(double start_mm, double in1_mm, bool switch_is_limit = false)
        : Bench(Variant::mcx314as), machine(kernel, "m", machine_settings(start_mm, in1_mm)), junctions(kernel) {
        machine.connect(chip.pulses(0));
        chip.connect_encoder(0, machine.encoder());
        junctions.join(machine.limit_minus_wire(), kernel.find_wire(switch_is_limit ? "c.xlmtm" : "c.xin1"));
        if (!switch_is_limit) junctions.join(machine.home_wire(), kernel.find_wire("c.xin0"));
        junctions.join(machine.index_wire(), kernel.find_wire("c.xin2"));
        start();
        speeds(X, 80'000, 20, 500, 200);  // 2,000 to 50,000 pulses/s
        data(X, cmd::HV, 20);
        data(X, cmd::P, 640);
        mode(X, 1, 0x8010);  // IN2 is active High; D-END interrupt
        advance(milliseconds(1));
    }
    void extension(unsigned em6, unsigned em7) { data(X, cmd::EM, std::int64_t{em7} << 16 | em6); }
    // Runs the search and returns the states passed, without repetitions.
    std::vector<unsigned> search() {
        std::vector<unsigned> states;
        command(X, cmd::HOME);
        while ((read(0) & X) != 0 && kernel.now() < whole_seconds(200)) {
            if (const unsigned state = hmst(*this, X); states.empty() || states.back() != state)
                states.push_back(state);
            advance(microseconds(100));
        }
        return states;
    }
    double position() { return machine.position(kernel.now()); }

    parts::AxisMechanics machine;
    sim::WireConnections junctions;
};

TEST(ChipHome, FindsSwitchIndexAndOffsetToTheExactPulse) {
    for (const double start_mm : {100.0, 45.0, 25.0}) {
        Homing b(start_mm, 4);
        b.extension(home_interrupt | slow_filters, steps_minus_minus_plus_plus | clear_counters | clear_pulse);
        EXPECT_EQ(b.search(), (std::vector<unsigned>{3, 8, 20, 25})) << "from " << start_mm << " mm";
        EXPECT_DOUBLE_EQ(b.position(), 6.0) << "1 mm behind the index at 5 mm, from " << start_mm << " mm";
        EXPECT_EQ(b.machine.lost_steps(), 0);
        EXPECT_EQ(b.lp(X), 0);
        EXPECT_EQ(b.ep(X), 0);
        EXPECT_EQ(b.status(X, 3), 0x0180u) << "D-END and HMEND";
        EXPECT_EQ(b.status(X, 2), 0u);
        b.data(X, cmd::P, 6400);
        b.command(X, 0x20);
        ASSERT_TRUE(b.finish(X));
        EXPECT_DOUBLE_EQ(b.position(), 16.0);
        EXPECT_EQ(b.ep(X), 8000);
    }
}

TEST(ChipHome, LeavesTheSwitchFirstIfItStartsOnIt) {
    for (const bool filtered : {false, true}) {
        Homing b(3, 4);
        b.extension(filtered ? slow_filters : 0u, steps_minus_minus_plus_plus);
        EXPECT_EQ(b.search(), (std::vector<unsigned>{12, 15, 20, 25}));
        EXPECT_DOUBLE_EQ(b.position(), 9.0) << "1 mm behind the index at 8 mm";
    }
}

TEST(ChipHome, AnIndexThatIsAlreadyActiveIsAnError) {
    Homing b(100, 5);  // IN1 acts exactly at the position of an index
    b.extension(home_interrupt, steps_minus_minus_plus_plus | clear_counters);
    EXPECT_EQ(b.search(), (std::vector<unsigned>{3, 8}));
    EXPECT_DOUBLE_EQ(b.position(), 5.0);
    EXPECT_EQ(b.status(X, 2), 0x0080u);
    EXPECT_EQ(b.read(0) & 0xF0u, 0x10u) << "X-ERR";
    EXPECT_EQ(b.lp(X), -95 * 640) << "the counters are not cleared";
    EXPECT_EQ(b.status(X, 3) & 0x0100u, 0x0100u) << "the end of the search is told";
    b.command(X, 0x25);
    EXPECT_EQ(b.status(X, 2), 0u);
}

TEST(ChipHome, TheLimitSwitchCanBeTheHomeSwitch) {
    Homing b(100, 4, true);
    b.mode(X, 2, 0x0004);  // the limit switch stops with deceleration
    b.extension(slow_filters, 0x1F | limit_is_home);
    EXPECT_EQ(b.search(), (std::vector<unsigned>{3, 12, 15, 20}));
    EXPECT_DOUBLE_EQ(b.position(), 5.0);
    EXPECT_EQ(b.machine.lost_steps(), 0);
}

TEST(ChipHome, TheIndexIsAcceptedOnlyWithinTheSwitchIfBothAreRequired) {
    Homing b(100, 4);
    b.data(X, cmd::HV, 500);  // with HV not slow the drive decelerates, beyond the index
    b.extension(0, 0x30 | z_within_in1);
    EXPECT_EQ(b.search(), (std::vector<unsigned>{20}));
    EXPECT_LT(b.position(), 0.0);
    Homing c(100, 4);
    c.extension(0, 0x30 | z_within_in1);
    EXPECT_EQ(c.search(), (std::vector<unsigned>{20}));
    EXPECT_DOUBLE_EQ(c.position(), 0.0);
}

// ---- operated by the test

struct HomeByHand : Bench {
    explicit HomeByHand(unsigned em7, unsigned em6 = home_interrupt) : Bench(Variant::mcx314as) {
        start();
        speeds(Y, 80'000, 20, 500, 200);
        data(Y, cmd::HV, 10);
        data(Y, cmd::P, 5);
        data(Y, cmd::EM, std::int64_t{em7} << 16 | em6);
    }
    void move(const char* pin, int level) {
        advance(milliseconds(5));
        wire(pin, level);
        advance(milliseconds(5));
    }
    int direction() {
        const std::int64_t from = count(1);
        advance(milliseconds(5));
        return count(1) > from ? 1 : count(1) < from ? -1 : 0;
    }
};

TEST(ChipHome, StepTwoReversesAtALimit) {
    HomeByHand b(0x0C);  // only step 2, in - direction
    b.command(Y, cmd::HOME);
    EXPECT_EQ(hmst(b, Y), 8u);
    EXPECT_EQ(b.direction(), -1);
    b.move("ylmtm", 0);  // the search passed the switch without seeing it
    EXPECT_EQ(hmst(b, Y), 12u);
    EXPECT_EQ(b.direction(), 1);
    b.move("ylmtm", 1);
    b.move("yin1", 0);
    EXPECT_EQ(hmst(b, Y), 12u) << "through the switch";
    EXPECT_EQ(b.direction(), 1);
    b.move("yin1", 1);
    EXPECT_EQ(hmst(b, Y), 15u);
    EXPECT_EQ(b.direction(), -1);
    b.move("yin1", 0);
    EXPECT_EQ(hmst(b, Y), 0u);
    EXPECT_EQ(b.read(0), 0u);
    EXPECT_EQ(b.status(Y, 3), 0x0100u);
}

TEST(ChipHome, StartsAtALimit) {
    HomeByHand b(0x0F);
    b.wire("ylmtm", 0);
    b.command(Y, cmd::HOME);
    EXPECT_EQ(hmst(b, Y), 3u);
    b.advance(microseconds(1));
    EXPECT_EQ(hmst(b, Y), 12u) << "step 1 ends at the limit, step 2 leaves it";
    EXPECT_EQ(b.direction(), 1);
}

TEST(ChipHome, EndsOnAStopAnAlarmOrTheOppositeLimit) {
    const struct {
        const char* pin;
        unsigned command, rr1;
    } ends[] = {
        {nullptr, 0x26, 0}, {nullptr, 0x27, 0}, {"yalarm", 0, 0x4000}, {"emgn", 0, 0x8000}, {"ylmtp", 0, 0x1000}};
    for (const auto& end : ends) {
        HomeByHand b(0x0D);  // step 1 in + direction, step 2 in - direction
        b.mode(Y, 2, 0x2000);
        b.command(Y, cmd::HOME);
        if (end.pin && std::string(end.pin) == "ylmtp") {  // ahead while step 2 leaves the switch
            b.move("yin1", 0);
            b.move("yin0", 0);
            b.advance(milliseconds(20));
            EXPECT_EQ(hmst(b, Y), 12u);
        }
        b.advance(milliseconds(10));
        EXPECT_NE(hmst(b, Y), 0u);
        if (end.pin)
            b.wire(end.pin, 0);
        else
            b.command(Y, end.command);
        b.advance(milliseconds(100));
        EXPECT_EQ(hmst(b, Y), 0u) << end.command;
        EXPECT_EQ(b.read(0) & Y, 0u);
        EXPECT_EQ(b.status(Y, 1) & 0xF000u, end.rr1);
        EXPECT_EQ(b.status(Y, 3), 0x0100u);
        EXPECT_EQ(b.status(Y, 2) & 0x80u, 0u);
    }
}

TEST(ChipHome, IgnoresDriveCommandsDuringTheSearch) {
    HomeByHand b(0x01);
    b.command(Y, cmd::HOME);
    b.advance(milliseconds(1));
    b.command(Y, 0x21);
    b.command(Y, cmd::HOME);
    b.write(5, 0x0004);
    b.command(0, 0x30);
    const auto conditions = b.kernel.conditions();
    ASSERT_EQ(conditions.size(), 3u);
    EXPECT_EQ(conditions[0].code, drive_ignored);
    EXPECT_EQ(conditions[1].code, drive_ignored);
    EXPECT_EQ(conditions[2].code, path_ignored);
    EXPECT_EQ(hmst(b, Y), 3u);
}

TEST(ChipHome, TheClearPulseLiesBetweenIndexAndOffset) {
    HomeByHand b(0x50 | clear_pulse | 3u << 13);  // steps 3 and 4, with a clear pulse of 200 us
    b.command(Y, cmd::HOME);
    b.advance(milliseconds(5));
    b.wire("yin2", 0);
    b.advance(tick);
    EXPECT_EQ(hmst(b, Y), 20u);
    EXPECT_EQ(b.level("ydrive"), 1);
    const std::int64_t at_index = b.count(1);
    b.advance(microseconds(200) - tick);
    EXPECT_EQ(hmst(b, Y), 20u);
    EXPECT_EQ(b.count(1), at_index);
    b.advance(tick);
    EXPECT_EQ(hmst(b, Y), 25u);
    EXPECT_EQ(b.level("ydrive"), 0);
    ASSERT_TRUE(b.finish(Y));
    EXPECT_EQ(b.count(1), at_index + 5);
}

TEST(ChipHome, WaitsForInPositionBetweenItsSteps) {
    HomeByHand b(0x05);
    b.mode(Y, 2, 0x8000);  // nINPOS enabled, Low
    b.command(Y, cmd::HOME);
    b.move("yin0", 0);
    b.advance(milliseconds(50));
    EXPECT_EQ(hmst(b, Y), 3u) << "stopped, not in position";
    EXPECT_EQ(b.direction(), 0);
    b.move("yinpos", 0);
    EXPECT_EQ(hmst(b, Y), 8u);
}

}  // namespace
}  // namespace motionrack::mcx314::outside
