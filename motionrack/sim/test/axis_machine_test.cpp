// An axis of the machine with fake pulses: true position, switches, step loss, encoder, snapshots.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>
#include <motionrack/sim/wire_connections.hpp>

namespace motionrack::parts {
namespace {

using sim::FakePulses;
using sim::Kernel;
using sim::PulseLaw;
using sim::WireId;

/// Returns an axis whose motor starts at up to 50 kHz, so that the tests' 10 kHz (a pulse each 100 us) cause no step
/// loss.
AxisMechanicsSettings plain() {
    AxisMechanicsSettings s;
    s.motor.start_stop_hz = 50'000;
    s.encoder.counts_per_rev = 4000;
    return s;
}

/// Records every change of every wire.
class Scribe final : public Kernel::WireObserver {
  public:
    struct Line {
        WireId wire{};
        int level = 0;
        Instant at{};
        friend bool operator==(const Line&, const Line&) = default;
    };
    void wire_changed(WireId wire, int level, Instant now) override { lines.push_back({wire, level, now}); }
    std::vector<Line> lines;
};

struct MachineWorld {
    MachineWorld(const AxisMechanicsSettings& settings, std::vector<PulseLaw> laws)
        : pulses(kernel, std::move(laws)), machine(kernel, "X", settings) {
        machine.connect(pulses);
        kernel.observe_wires(&scribe);
    }
    void run(Instant until) { kernel.run_until(until); }

    Kernel kernel;
    FakePulses pulses;
    AxisMechanics machine;
    Scribe scribe;
};

std::vector<std::pair<AxisCondition, std::int64_t>> conditions(const Kernel& kernel) {
    std::vector<std::pair<AxisCondition, std::int64_t>> out;
    for (const sim::Condition& c : kernel.conditions()) out.emplace_back(static_cast<AxisCondition>(c.code), c.a);
    return out;
}

// ---- True position

TEST(AxisMechanics, TurnsPulsesIntoMillimetresExactly) {
    MachineWorld w(plain(), {{Instant{0}, microseconds(100), +1}});
    w.kernel.start();
    w.run(milliseconds(320));
    EXPECT_EQ(w.machine.rotor().count(w.kernel.now()), 3200);
    EXPECT_EQ(w.machine.encoder().count(w.kernel.now()), 4000);
    EXPECT_EQ(w.machine.position(w.kernel.now()), 5.0);
    EXPECT_EQ(w.machine.lost_steps(), 0);
    EXPECT_EQ(w.machine.velocity(), 10'000 * 5.0 / 3200);
    EXPECT_EQ(w.machine.peak_velocity(), w.machine.velocity());
    EXPECT_TRUE(w.kernel.conditions().empty());
    EXPECT_LE(w.kernel.events(), 2u);  // single pulses cause no events
}

TEST(AxisMechanics, TurnsPulsesIntoDegreesByARatioThatIsNoDecimalFraction) {
    AxisMechanicsSettings s = plain();
    s.axle.travel_per_rev = rotary_travel(7);
    s.axle.initial_position = -10;
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1}});
    w.kernel.start();
    w.run(milliseconds(320 * 7));
    EXPECT_EQ(w.machine.position(w.kernel.now()), 350.0);
}

TEST(AxisMechanics, MovesTheTableOnlyAfterTheBacklashIsTakenUp) {
    AxisMechanicsSettings s = plain();
    s.axle.backlash = 10 * 5.0 / 3200;
    MachineWorld w(s, {{Instant{0}, milliseconds(1), +1}, {milliseconds(50), milliseconds(1), -1}});
    w.kernel.start();
    auto microsteps = [&] { return std::lround(w.machine.position(w.kernel.now()) * 3200 / 5); };
    w.run(milliseconds(10));
    EXPECT_EQ(microsteps(), 0);
    w.run(milliseconds(50));
    EXPECT_EQ(microsteps(), 40);
    w.run(milliseconds(60));
    EXPECT_EQ(microsteps(), 40);
    w.run(milliseconds(75));
    EXPECT_EQ(microsteps(), 25);
    EXPECT_EQ(w.machine.rotor().count(w.kernel.now()), 25);
}

// ---- Switches

TEST(AxisMechanics, SwitchesActAtTheirPulseAndReleaseAfterTheHysteresis) {
    AxisMechanicsSettings s = plain();
    s.limit_plus.position = 0.5;  // 320 pulses
    s.limit_plus.hysteresis = 0.05;
    s.limit_plus.bounce = Duration{0};
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1}, {milliseconds(40), microseconds(100), -1}});
    w.kernel.start();
    w.run(milliseconds(100));
    const WireId wire = w.kernel.find_wire("X.limit_plus");
    ASSERT_EQ(wire, w.machine.limit_plus_wire());
    const std::vector<Scribe::Line> expected = {
        {wire, 0, microseconds(32'000)},                      // at 320 pulses
        {wire, 1, milliseconds(40) + microseconds(11'200)}};  // at 400 - 112 = 288
    EXPECT_EQ(w.scribe.lines, expected);
}

TEST(AxisMechanics, AHomeSwitchIsActiveAtAndBelowItsPositionAlreadyAtTheStart) {
    AxisMechanicsSettings s = plain();
    s.home.position = 0;
    s.home.bounce = Duration{0};
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1}});
    w.kernel.start();
    EXPECT_EQ(w.kernel.level(w.machine.home_wire()), 0);
    w.run(milliseconds(10));
    ASSERT_EQ(w.scribe.lines.size(), 1u);
    EXPECT_EQ(w.scribe.lines[0].at, microseconds(3200));  // 0.05 mm = 32 pulses
    EXPECT_EQ(w.kernel.level(w.machine.home_wire()), 1);
}

TEST(AxisMechanics, ContactsBounceAtFixedInstantsWithinTheBounceTime) {
    auto history = [] {
        AxisMechanicsSettings s = plain();
        s.limit_minus.position = -0.5;
        s.limit_minus.bounce = milliseconds(2);
        MachineWorld w(s, {{Instant{0}, microseconds(100), -1}, {milliseconds(60), microseconds(100), +1}});
        w.kernel.start();
        w.run(milliseconds(200));
        return w.scribe.lines;
    };
    const auto lines = history();
    EXPECT_EQ(lines, history());
    int first_group = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i > 0) {
            EXPECT_LT(lines[i - 1].at, lines[i].at);
            EXPECT_NE(lines[i - 1].level, lines[i].level);
        }
        if (lines[i].at < milliseconds(60)) {
            ++first_group;
            EXPECT_GE(lines[i].at, milliseconds(32));
            EXPECT_LE(lines[i].at, milliseconds(34));
        }
    }
    EXPECT_GE(first_group, 3);
    EXPECT_EQ(first_group % 2, 1);
    EXPECT_EQ(lines[static_cast<std::size_t>(first_group) - 1].level, 0);
    EXPECT_EQ(lines.back().level, 1);
}

TEST(AxisMechanics, AStuckSwitchKeepsItsLevelWhateverTheMachineDoes) {
    AxisMechanicsSettings s = plain();
    s.limit_plus.position = 0.5;
    s.limit_plus.bounce = Duration{0};
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1}});
    w.kernel.start();
    EXPECT_TRUE(w.machine.fault("limit_plus.stuck_open", 1, w.kernel.now()));
    w.run(milliseconds(40));
    EXPECT_EQ(w.kernel.level(w.machine.limit_plus_wire()), 1);
    EXPECT_TRUE(w.machine.fault("limit_plus.stuck_open", 0, w.kernel.now()));
    w.kernel.settle();
    EXPECT_EQ(w.kernel.level(w.machine.limit_plus_wire()), 0);
    EXPECT_TRUE(w.machine.fault("limit_plus.stuck_closed", 1, w.kernel.now()));
    w.pulses.drive(microseconds(100), -1);
    w.run(milliseconds(100));
    EXPECT_EQ(w.kernel.level(w.machine.limit_plus_wire()), 0);
    EXPECT_FALSE(w.machine.fault("home.stuck_open", 1, w.kernel.now()));
    EXPECT_FALSE(w.machine.fault("limit_plus.nonsense", 1, w.kernel.now()));
}

RC_GTEST_PROP(AxisMechanics, ASwitchTogglesExactlyWhereThePositionPassesItsPosition, ()) {
    AxisMechanicsSettings s = plain();
    s.axle.travel_per_rev =
        *rc::gen::element(linear_travel(5), linear_travel(5.08), rotary_travel(7), rotary_travel(90));
    s.axle.initial_position = *rc::gen::inRange(-1000, 1000) / 10.0;
    s.limit_plus.position = s.axle.initial_position + *rc::gen::inRange(1, 100) / 100.0;
    s.limit_plus.bounce = Duration{0};
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1}});
    w.kernel.start();
    const std::int64_t pulse = w.machine.switches().limit_plus().acts_at();
    w.run(microseconds(100) * pulse - Duration{1});
    RC_ASSERT(w.machine.position(w.kernel.now()) < *s.limit_plus.position);
    RC_ASSERT(w.kernel.level(w.machine.limit_plus_wire()) == 1);
    w.run(microseconds(100) * pulse);
    RC_ASSERT(w.machine.position(w.kernel.now()) >= *s.limit_plus.position);
    RC_ASSERT(w.kernel.level(w.machine.limit_plus_wire()) == 0);
}

// ---- Step loss

TEST(AxisMechanics, AMotorStartedTooFastStallsAndLocksAMultipleOfFourStepsLater) {
    AxisMechanicsSettings s = plain();
    s.motor.start_stop_hz = 2000;
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1}, {milliseconds(100), microseconds(1000), +1}});
    w.kernel.start();
    w.run(milliseconds(50));
    EXPECT_FALSE(w.machine.in_step());
    EXPECT_EQ(w.machine.rotor().count(w.kernel.now()), 16)
        << "it falls out of step a full step away from where it should be";
    EXPECT_EQ(w.machine.rotor().rate(w.kernel.now()), 0);
    w.run(milliseconds(110));
    EXPECT_TRUE(w.machine.in_step());
    EXPECT_EQ(w.machine.lost_steps(), 960);  // 984 pulses: 15 * 64 is the nearest multiple of 64
    EXPECT_EQ(conditions(w.kernel), (std::vector<std::pair<AxisCondition, std::int64_t>>{
                                        {AxisCondition::fell_out_of_step, 0}, {AxisCondition::lost_steps, 960}}));
    EXPECT_EQ(w.kernel.conditions()[1].at, milliseconds(100));
}

TEST(AxisMechanics, AMotorStoppedAbruptlyOvershootsByWholeElectricalCycles) {
    AxisMechanicsSettings s = plain();
    s.motor.start_stop_hz = 2000;
    // 0 -> 2000 -> 4000 -> 0 Hz: the last change is twice the start/stop rate.
    MachineWorld w(s, {{Instant{0}, microseconds(500), +1},
                       {milliseconds(10), microseconds(250), +1},
                       {milliseconds(20), microseconds(250), 0}});
    w.kernel.start();
    w.run(milliseconds(30));
    EXPECT_TRUE(w.machine.in_step());
    EXPECT_EQ(w.machine.lost_steps(), -128);
    EXPECT_EQ(w.machine.rotor().count(w.kernel.now()), 20 + 40 + 128);
}

TEST(AxisMechanics, AMotorFollowsPulsesThatStopLessThanAFullStepOn) {
    AxisMechanicsSettings s = plain();
    s.motor.start_stop_hz = 2000;
    // Pulses at 3 kHz: three times 15 of the 16 microsteps of a full step, then more than a full step.
    const Duration quick = microseconds(333);
    std::vector<PulseLaw> laws;
    for (const int ms : {0, 100, 200}) {
        laws.push_back({milliseconds(ms), quick, +1});
        laws.push_back({milliseconds(ms + 5), milliseconds(1), 0});
    }
    laws.push_back({milliseconds(300), quick, +1});
    laws.push_back({milliseconds(320), milliseconds(1), 0});
    MachineWorld w(s, laws);
    w.kernel.start();
    w.run(milliseconds(299));
    EXPECT_TRUE(w.machine.in_step());
    EXPECT_EQ(w.machine.rotor().count(w.kernel.now()), 45);
    EXPECT_EQ(w.machine.lost_steps(), 0);
    w.run(milliseconds(400));
    EXPECT_NE(w.machine.lost_steps(), 0);
}

TEST(AxisMechanics, AMotorFollowsARampToTheVelocityAtWhichItStops) {
    AxisMechanicsSettings s = plain();
    s.motor.start_stop_hz = 2000;
    // From standstill to 1600 Hz, up to 20 kHz and down again by 40 Hz each 10 us, and from 1600 Hz to standstill: an
    // acceleration of twice the start/stop rate per millisecond.
    std::vector<PulseLaw> laws;
    Instant at{};
    const auto step = [&](double hz) {
        laws.push_back({at, from_seconds(1 / hz), +1});
        at += microseconds(10);
    };
    for (int hz = 1600; hz < 20'000; hz += 40) step(hz);
    for (int hz = 20'000; hz >= 1600; hz -= 40) step(hz);
    laws.push_back({at, milliseconds(1), 0});
    MachineWorld w(s, laws);
    w.kernel.start();
    w.run(milliseconds(50));
    EXPECT_TRUE(w.machine.in_step());
    EXPECT_EQ(w.machine.lost_steps(), 0);
    EXPECT_TRUE(conditions(w.kernel).empty());
}

TEST(AxisMechanics, AMotorAboveItsPullOutFrequencyStalls) {
    AxisMechanicsSettings s = plain();
    s.motor.pull_out_hz = 15'000;
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1},
                       {milliseconds(10), microseconds(50), +1},
                       {milliseconds(20), microseconds(100), 0}});
    w.kernel.start();
    w.run(milliseconds(30));
    EXPECT_EQ(w.machine.lost_steps(), 192);  // 200 pulses: 3 cycles of 64
}

RC_GTEST_PROP(AxisMechanics, LosesMultiplesOfFourFullStepsAndKeepsThePhase, ()) {
    AxisMechanicsSettings s = plain();
    s.motor.start_stop_hz = 2000;
    s.motor.pull_out_hz = 20'000;
    s.motor.microsteps = *rc::gen::element<std::int64_t>(1, 2, 10, 16);
    std::vector<PulseLaw> laws;
    const int size = *rc::gen::inRange(1, 20);
    for (int i = 0; i < size; ++i)
        laws.push_back(
            {milliseconds(10 * i), microseconds(*rc::gen::inRange(20, 2000)), *rc::gen::inRange<std::int64_t>(-1, 2)});
    laws.push_back({milliseconds(10 * size), milliseconds(1), 0});
    MachineWorld w(s, laws);
    w.kernel.start();
    for (int i = 0; i <= size; ++i) {
        w.run(milliseconds(10 * i + 5));
        if (w.machine.in_step()) RC_ASSERT(w.machine.lost_steps() % (4 * s.motor.microsteps) == 0);
    }
    RC_ASSERT(w.machine.in_step());
}

TEST(AxisMechanics, FaultsStallPushAndLose) {
    MachineWorld w(plain(), {{Instant{0}, microseconds(100), +1}});
    w.kernel.start();
    w.run(milliseconds(10));
    EXPECT_TRUE(w.machine.fault("stall", 1, w.kernel.now()));
    w.run(milliseconds(20));
    EXPECT_EQ(w.machine.rotor().count(w.kernel.now()), 100);
    EXPECT_TRUE(w.machine.fault("motor.stall", 0, w.kernel.now()));
    EXPECT_EQ(w.machine.lost_steps(), 128);
    EXPECT_TRUE(w.machine.fault("lose_steps", 64, w.kernel.now()));
    EXPECT_EQ(w.machine.lost_steps(), 192);
    EXPECT_TRUE(w.machine.fault("push", 1000, w.kernel.now()));
    EXPECT_EQ(w.machine.lost_steps(), 192 - 1024);
    EXPECT_FALSE(w.machine.fault("push", std::numeric_limits<double>::quiet_NaN(), w.kernel.now()));
}

TEST(AxisMechanics, StopsAtTheEndOfTravelAndMovesAwayFromIt) {
    AxisMechanicsSettings s = plain();
    s.axle.end_plus = 1.0;  // 640 pulses
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1}, {milliseconds(100), microseconds(100), -1}});
    w.kernel.start();
    w.run(milliseconds(90));
    EXPECT_EQ(w.machine.position(w.kernel.now()), 1.0);
    EXPECT_FALSE(w.machine.in_step());
    w.run(milliseconds(110));
    EXPECT_TRUE(w.machine.in_step());
    EXPECT_EQ(w.machine.lost_steps() % 64, 0);
    EXPECT_LT(w.machine.position(w.kernel.now()), 1.0);
    EXPECT_EQ(conditions(w.kernel)[0], (std::pair{AxisCondition::end_of_travel, std::int64_t{1}}));
}

TEST(AxisMechanics, ConditionsAreSentencesWithTheirNumbers) {
    auto text = [](AxisCondition code, std::int64_t a, std::int64_t b) {
        return describe({milliseconds(1500), {}, static_cast<std::uint16_t>(code), a, b}, "X");
    };
    EXPECT_EQ(
        text(AxisCondition::fell_out_of_step, 0, 9000),
        "axis X: at 1.500000 s the motor fell out of step when the pulse rate went from 0 to 9000 Hz, more than it "
        "follows at once or above its pull-out rate");
    EXPECT_NE(text(AxisCondition::lost_steps, 64, 128).find("had lost 64 pulses (128 in all)"), std::string::npos);
    EXPECT_NE(text(AxisCondition::lost_steps, -64, 0).find("had run on by 64 pulses (0 in all)"), std::string::npos);
    EXPECT_NE(text(AxisCondition::end_of_travel, -1, -640).find("minus hard stop at -640"), std::string::npos);
    EXPECT_NE(text(AxisCondition::axle_held, 7, 0).find("held fast at 7 microsteps"), std::string::npos);
}

TEST(AxisMechanics, APushPastASwitchIsDetectedAtOnce) {
    AxisMechanicsSettings s = plain();
    s.limit_plus.position = 0.5;
    s.limit_plus.bounce = Duration{0};
    MachineWorld w(s, {});
    w.kernel.start();
    w.machine.fault("push", 640, w.kernel.now());
    w.kernel.settle();
    EXPECT_EQ(w.kernel.level(w.machine.limit_plus_wire()), 0);
    w.machine.fault("push", -640, w.kernel.now());
    w.kernel.settle();
    EXPECT_EQ(w.kernel.level(w.machine.limit_plus_wire()), 1);
}

// ---- Snapshots

TEST(AxisMechanics, ASnapshotDuringAMoveContinuesAsTheUninterruptedRun) {
    AxisMechanicsSettings s = plain();
    s.motor.start_stop_hz = 15'000;
    s.limit_plus.position = 0.5;
    s.home.position = 0.1;
    MachineWorld w(s, {{Instant{0}, microseconds(100), +1},
                       {milliseconds(45), microseconds(50), -1},
                       {milliseconds(70), microseconds(100), +1}});
    w.kernel.start();
    const Instant middle = milliseconds(32) + microseconds(300);  // while the switch bounces
    w.run(middle);
    const sim::Snapshot snapshot = w.kernel.snapshot();
    w.run(milliseconds(200));
    const std::uint64_t state = w.kernel.state_hash();
    const std::uint64_t trace = w.kernel.trace_hash();
    const double position = w.machine.position(w.kernel.now());
    EXPECT_NE(w.machine.lost_steps(), 0);
    w.kernel.restore(snapshot);
    EXPECT_EQ(w.kernel.now(), middle);
    EXPECT_NE(w.kernel.trace_hash(), trace);
    w.run(milliseconds(200));
    EXPECT_EQ(w.kernel.state_hash(), state);
    EXPECT_EQ(w.kernel.trace_hash(), trace);
    EXPECT_EQ(w.machine.position(w.kernel.now()), position);
}

}  // namespace
}  // namespace motionrack::parts
