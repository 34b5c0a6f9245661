// Every state of a machine against every source of a stop. Hazards end in time, nothing moves before a reset and a
// command, and the reset moves nothing. The page docs/explanations/safety.md lists these tests by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/ioflex02_card.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/rtc5_card.hpp>
#include <motionrack/rack/stop_reactions.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <set>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using rack::StopSource;

/// Two axes with switches and a probe, a positioning card (which has a watchdog), a laser over a belt, a moving stage,
/// outputs.
const char* const everything = R"(
[card.m]
type = "mcx314"
variant = "mcx314as"
[card.board]
type = "databoard4002"
[card.glass]
type = "ioflex02"
preloaded = true
[card.decoder]
type = "grating_decoder"
scales = 1
[card.host]
type = "grating_bus"
scales = 1
period_us = 1000
[card.scan]
type = "rtc5"
list_memory = 256
[axis.X]
card = "m"
channel = "x"
initial_position_mm = 100
switches = { limit_minus_mm = -5, limit_plus_mm = 305, home_mm = 0 }
[axis.Y]
card = "m"
channel = "y"
switches = { limit_minus_mm = -5, limit_plus_mm = 305 }
[probe]
x_min_mm = 280
[stage.mask]
card = "host"
input = 0
viscous_friction_per_s = 2
scale = { pitch_um = 20 }
[stage.mask.servo]
profile = "scan"
from_mm = 0
to_mm = 200
max_velocity_mm_s = 50
max_accel_mm_s2 = 1000
bandwidth_hz = 20
max_following_error_um = 0
[belt.line]
card = "scan"
velocity_mm_s = 50
counts_per_mm = 100
[scanner.head]
card = "scan"
conveyor = "line"
bits_per_mm = 5184
)";

struct State {
    std::string_view name;
    MachineState state;  ///< reported state just before the stop
    void (*begin)(Operated& o, double stop_s);
};

void program(Operated& o, const std::string& text) {
    o.at(0.05, [text](Machine& m) { EXPECT_TRUE(m.begin_program(text, "p")); });
}
const char* const one_long_line = "G21 G90 F1200\nG1 X200\nM2\n";

constexpr State states[] = {
    {"disabled", MachineState::disabled,
     [](Operated& o, double) { o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.enable(false)); }); }},
    {"standstill", MachineState::standstill, [](Operated&, double) {}},
    {"waiting_for_a_line", MachineState::standstill,
     [](Operated& o, double) { o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.line("G21 G90 G1 X104 F1200", 1)); }); }},
    {"moving", MachineState::moving, [](Operated& o, double) { program(o, one_long_line); }},
    {"dwell", MachineState::moving,
     [](Operated& o, double stop_s) {  // it would end soon after the stop
         program(o, "G21 G90 F1200\nG1 X104\nG4 P" + std::to_string(stop_s - 0.2) + "\nG1 X200\nM2\n");
     }},
    {"hold", MachineState::hold,
     [](Operated& o, double) {
         program(o, one_long_line);
         o.at(0.25, [](Machine& m) { EXPECT_TRUE(m.hold()); });
     }},
    {"m0", MachineState::hold, [](Operated& o, double) { program(o, "G21 G90 F1200\nG1 X104\nM0\nG1 X200\nM2\n"); }},
    {"single_block", MachineState::hold,
     [](Operated& o, double) {
         o.at(0.04, [](Machine& m) { m.programs().set_single_block(true); });
         program(o, "G21 G90 F1200\nG1 X104\nG1 X200\nM2\n");
     }},
    {"probing", MachineState::moving, [](Operated& o, double) { program(o, "G21 G90\nG38.2 X290 F1200\nM2\n"); }},
    {"homing", MachineState::homing,
     [](Operated& o, double) { o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().home("X")); }); }},
    {"jog", MachineState::jogging,
     [](Operated& o, double stop_s) {
         for (double t = 0.05; t < stop_s + 0.3; t += 0.1) o.at(t, [](Machine& m) { (void)m.manual().jog('X', 20); });
     }},
    {"jog_along_a_line", MachineState::jogging,
     [](Operated& o, double) {
         o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().jog_to({300, 0, 0, 0, 0, 0}, 20)); });
     }},
    {"service", MachineState::service,
     [](Operated& o, double) {
         o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.service().begin("m", {"anna", "", ""}, "w1", {})); });
         const auto call = [&o](double seconds, const char* function,
                                const std::map<std::string, std::int64_t, std::less<>>& arguments) {
             o.at(seconds, [=](Machine& m) {
                 EXPECT_TRUE(m.service().call({"m", function, arguments}, {}, "w1", [](const auto&) {}));
             });
         };
         call(0.1, "SetRange", {{"data", 800'000}});
         call(0.15, "TCurve_C", {{"axis", 1}, {"m_SV", 100}, {"m_V", 1000}, {"m_A", 1}});
     }},
};

struct Source {
    StopSource source;
    std::string_view name;
    double ahead_s;  ///< time from its start to the stop
    void (*begin)(Machine& m);
    void (*end)(Machine& m);
};

void nothing(Machine&) {}
template <bool pressed>
void button(Machine& m) {
    EXPECT_TRUE(m.wires().force("estop", pressed ? 0 : 1));
}
template <bool alarm>
void drive(Machine& m) {
    EXPECT_TRUE(m.wires().force("m.yalarm", alarm ? 0 : 1));
}

constexpr Source sources[] = {
    {StopSource::emergency_stop, "emergency_stop", 0, button<true>, button<false>},
    {StopSource::stop_command, "stop_command", 0, [](Machine& m) { m.stop(); }, nothing},
    {StopSource::drive_alarm, "drive_alarm", 0, drive<true>, drive<false>},
    {StopSource::limit_switch, "limit_switch", 0, [](Machine& m) { EXPECT_TRUE(m.wires().force("Y.limit_minus", 0)); },
     nothing},
    {StopSource::watchdog, "watchdog", 1,
     [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "watchdog.hang", "board")); }, nothing},
    {StopSource::following_error, "following_error", 0,
     [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.push=1280", "Y")); }, nothing},
};

using Case = std::tuple<State, Source>;

class StopInAState : public testing::TestWithParam<Case> {
  protected:
    StopInAState() : o_(rack::good(everything)) {}
    const State& state() const { return std::get<0>(GetParam()); }
    const Source& source() const { return std::get<1>(GetParam()); }
    double stop_s() const { return 0.45 + 0.6 * source().ahead_s; }

    rack::Rack& rack() { return o_.machine->rack(); }
    double level(const std::string& wire) { return *o_.machine->wires().get(wire); }
    double stage_velocity() { return std::fabs(rack().stage("mask")->motor->velocity(o_.machine->now())); }
    double belt_velocity() { return rack().track("line")->track().velocity(to_seconds(o_.machine->now())); }
    double marked() { return *rack::get_quantity(rack(), "head.marked_mm"); }

    /// Declares the positions, then switches the spindle and both coolants on. Before a state begins, that line is
    /// over.
    void begin_tools() {
        o_.at(0.004, [](Machine& m) {
            EXPECT_TRUE(m.manual().set_position('X', 100));
            EXPECT_TRUE(m.manual().set_position('Y', 0));
        });
        o_.at(0.016, [](Machine& m) { EXPECT_TRUE(m.line("M3 S1000 M7 M8", 1)); });
    }
    /// Starts a laser for eight seconds, a belt and a stage, and switches outputs on.
    void begin_all() {
        rtc5::Engine& laser = rack::rtc5_card_of(rack(), "scan")->engine();
        ASSERT_TRUE(laser.set_start_list(1));
        ASSERT_TRUE(laser.put(*rtc5::list_command(rtc5::Op::set_mark_speed, {25})));
        ASSERT_TRUE(laser.put(*rtc5::list_command(rtc5::Op::mark_abs, {200'000, 0})));
        ASSERT_TRUE(laser.put(*rtc5::list_command(rtc5::Op::set_end_of_list, {})));
        ASSERT_TRUE(laser.execute_list(1));
        for (const std::uint32_t low_and_high : {ioflex02::offset("OUTL"), ioflex02::offset("OUTH")})
            rack::ioflex02_card_of(rack(), "glass")->write(low_and_high, 0xFF);
    }
    void expect_tools(control::gcode::Spindle spindle, bool coolant) {
        const Status& status = o_.machine->status();
        EXPECT_EQ(status.spindle, spindle);
        EXPECT_EQ(status.mist, coolant);
        EXPECT_EQ(status.flood, coolant);
    }
    void expect_outputs(double value) {
        for (int output = 0; output < 16; ++output)
            EXPECT_EQ(level("glass.out" + std::to_string(output)), value) << output;
    }
    void expect_all_on() {
        EXPECT_EQ(o_.machine->state(), state().state) << name_of(o_.machine->state());
        EXPECT_EQ(level("scan.laser_on"), 1);
        expect_tools(control::gcode::Spindle::clockwise, true);
        expect_outputs(1);
        EXPECT_GT(belt_velocity(), 0);
        EXPECT_GT(stage_velocity(), 0.01);
    }
    /// Expects everything that must be off immediately.
    void expect_off() {
        EXPECT_EQ(level("scan.laser_on"), 0);
        expect_tools(control::gcode::Spindle::off, false);
        expect_outputs(0);
    }

    Operated o_;
};

TEST_P(StopInAState, HoldsUntilAReset) {
    double x = 0, y = 0, laser = 0, belt = 0;
    begin_tools();
    o_.at(0.02, [&](Machine&) { begin_all(); });
    const double stop = stop_s(), released = stop + 0.1, looked = stop + 0.35, over = stop + 0.5;
    state().begin(o_, stop);
    o_.at(stop - source().ahead_s, source().begin);
    o_.at(stop - 0.01, [&](Machine&) {
        expect_all_on();
        belt = belt_velocity();
    });
    o_.at(stop + 0.01, [&](Machine&) {
        expect_off();
        EXPECT_LT(belt_velocity(), belt) << "it brakes";
        laser = marked();
    });
    o_.at(released, [&](Machine& m) { source().end(m); });
    o_.at(released + 0.01, [](Machine& m) { EXPECT_FALSE(m.resume()); });
    o_.at(released + 0.15, [&](Machine& m) { x = m.status().axes[0].commanded, y = m.status().axes[1].commanded; });
    o_.at(looked, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << name_of(m.state());
        EXPECT_EQ(rack().stop_latch().cause(), source().source);
        EXPECT_EQ(m.status().alarms.size(), source().source == StopSource::stop_command ? 0u : 1u);
        EXPECT_FALSE(m.line("G1 X110 F600", 1));
        EXPECT_FALSE(m.begin_program("G0 X110\n", "q"));
        EXPECT_FALSE(m.manual().jog('X', 5));
        EXPECT_FALSE(m.manual().home("X"));
        EXPECT_LT(stage_velocity(), 0.001);
        EXPECT_EQ(belt_velocity(), 0);
        m.reset();
    });
    o_.at(over, [&](Machine& m) {
        EXPECT_EQ(m.state(),
                  state().state == MachineState::disabled ? MachineState::disabled : MachineState::standstill)
            << name_of(m.state()) << ' ' << m.status().reason;
        EXPECT_EQ(m.status().axes[0].commanded, x) << "nothing moves before a new order";
        EXPECT_EQ(m.status().axes[1].commanded, y);
        EXPECT_EQ(marked(), laser) << "the laser stays off";
        expect_off();
        EXPECT_EQ(belt_velocity(), 0);
        EXPECT_LT(stage_velocity(), 0.001);
    });
    o_.run(over + 0.01);
}

std::vector<Case> all_cases() {
    std::vector<Case> out;
    for (const State& state : states)
        for (const Source& source : sources) out.emplace_back(state, source);
    return out;
}

INSTANTIATE_TEST_SUITE_P(EveryState, StopInAState, testing::ValuesIn(all_cases()), [](const auto& each) {
    return std::string(std::get<0>(each.param).name) + "_by_" + std::string(std::get<1>(each.param).name);
});

/// Servo enables and brakes may be connected to these outputs.
TEST(GeneralOutputs, GoLowAtAnEmergencyStopAndKeepTheirLevelsAtAllOtherStops) {
    for (const Source& source : sources) {
        SCOPED_TRACE(source.name);
        const double stop = 0.45 + 0.6 * source.ahead_s;
        const double expected = source.source == StopSource::emergency_stop ? 0 : 1;
        Operated o(rack::good(everything));
        o.at(0.004, [](Machine& m) {
            EXPECT_TRUE(m.manual().set_position('X', 100));
            EXPECT_TRUE(m.manual().set_position('Y', 0));
        });
        program(o, one_long_line);
        o.at(0.3, [](Machine& m) { m.rack().card("m")->registers()->write(mcx314::reg::WR4, 0xFFFF); });
        o.at(stop - source.ahead_s, source.begin);
        for (const double after : {0.01, 0.08})  // in the ramp, and at standstill
            o.at(stop + after, [&](Machine& m) {
                EXPECT_TRUE(m.rack().stop_latch().latched());
                for (const std::string channel : {"x", "y", "z", "u"})
                    for (const char* output : {"out0", "out1", "out2", "out3"})
                        EXPECT_EQ(*m.wires().get("m." + channel + output), expected) << channel << output << after;
            });
        o.run(stop + 0.1);
    }
}

TEST(TableOfReactions, HasOneReactionOfEachPartToEachSource) {
    std::set<std::string_view> parts;
    for (const rack::StopReaction& reaction : rack::stop_reactions()) parts.insert(reaction.part);
    for (const std::string_view type : rack::card_type_names())
        EXPECT_EQ(parts.count(type), type == "grating_decoder" ? 0u : 1u) << type;  // it only counts
    for (const std::string_view part : parts)
        for (const StopSource source : rack::stop_sources) {
            int rows = 0;
            for (const rack::StopReaction& reaction : rack::stop_reactions())
                rows += reaction.part == part && reaction.is_to(source);
            EXPECT_EQ(rows, 1) << part << " to " << rack::name_of(source);
        }
}

TEST(SafetyPage, NamesTheStatesThatAreTested) {
    std::vector<std::string_view> tested, reported;
    for (const State& state : states) tested.push_back(state.name);
    for (const rack::StopState& state : rack::stop_states()) reported.push_back(state.name);
    EXPECT_EQ(reported, tested);
}

}  // namespace
}  // namespace motionrack::operate
