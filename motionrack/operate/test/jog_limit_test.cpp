// A jog ends at the axis' soft limit: at the last pulse within it, at any velocity and acceleration, with any change on
// the way.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::HasSubstr;

constexpr double pulses_per_mm = 640;

struct JogCase {
    double speed = 20;          ///< mm/s
    double accel = 1000;        ///< mm/s2
    double start = 0;           ///< mm
    double min = 0, max = 300;  ///< mm
    int direction = 1;
    double next_speed = 0;  ///< mm/s, alternating with `speed`; 0: no change
    double every = 0.1;     ///< s between renewals
    bool overrides = false;
    const char* more = "";
};

std::ostream& operator<<(std::ostream& out, const JogCase& one) {
    return out << fmt::format("{} mm/s, {} mm/s2 from {} to {}, next {} mm/s, every {} s {}", one.direction * one.speed,
                              one.accel, one.start, one.direction > 0 ? one.max : one.min, one.next_speed, one.every,
                              one.more);
}

rack::RackConfig rack_of(const JogCase& one) {
    // At high accelerations the pulse rate increases greatly from one pulse to the next.
    const int start_stop_hz = one.accel > 1000 ? 60'000 : 2000;
    const rack::RackReading reading = rack::read_rack_text(
        fmt::format("[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = "
                    "{}\nmin_limit_mm = {}\nmax_limit_mm = {}"
                    "\nmax_velocity_mm_s = 100\nmax_accel_mm_s2 = {}\n[axis.X.motor]\nstart_stop_hz = {}\n{}",
                    one.start, one.min, one.max, one.accel, start_stop_hz, one.more));
    EXPECT_TRUE(reading.config) << (reading.errors.empty() ? "" : reading.errors[0].text());
    return *reading.config;
}

/// Maximum excess of the axis over the limit, maximum distance of the table from the axis, and the final position.
struct Seen {
    double beyond = 0, apart = 0, commanded = 0, end_velocity = 0;
    std::string conditions;
    bool position_valid = false;
    MachineState state = MachineState::disabled;
};

Seen jog_on(const JogCase& one) {
    Operated o(rack_of(one));
    Seen seen;
    const double way = one.direction > 0 ? one.max - one.start : one.start - one.min;
    const double min_speed = one.next_speed > 0 ? std::min(one.speed, one.next_speed) : one.speed;
    const double last = 1 + way / min_speed + 2 * one.speed / one.accel;
    int n = 0;
    for (double t = 0.1; t < last; t += one.every, ++n)
        o.at(t, [&one, n](Machine& m) {
            const double speed = n % 2 == 1 && one.next_speed > 0 ? one.next_speed : one.speed;
            if (one.overrides) m.programs().set_overrides(n % 2 == 0 ? 2 : 0.1, n % 2 == 0 ? 1 : 0.2);
            static_cast<void>(m.manual().jog('X', one.direction * speed));
        });
    o.machine->listen([&](const Status& status) {
        const AxisStatus& x = status.axes[0];
        seen.beyond = std::max({seen.beyond, one.min - x.commanded, x.commanded - one.max});
        seen.apart = std::max(seen.apart, std::fabs(x.true_position - x.commanded));
        if (x.velocity != 0) seen.end_velocity = std::fabs(x.velocity);
    });
    o.run(last + 1);
    seen.commanded = o.x();
    seen.position_valid = o.machine->status().axes[0].position_valid;
    seen.state = o.machine->state();
    for (const sim::Condition& condition : o.machine->rack().kernel().conditions())
        seen.conditions += o.machine->rack().describe(condition) + "\n";
    return seen;
}

constexpr const char* jerk_limited = "[controller]\nprofile = \"jerk_limited\"\n";

const JogCase jog_cases[] = {
    // all velocities, both directions
    {20},
    {50},
    {100},
    {1.5},
    {20, 1000, 300, 0, 300, -1},
    {50, 1000, 300, 0, 300, -1},
    {100, 1000, 300, 0, 300, -1},
    // both profiles of the controller
    {.speed = 20, .more = jerk_limited},
    {.speed = 50, .more = jerk_limited},
    {.speed = 100, .more = jerk_limited},
    {.speed = 100, .start = 300, .direction = -1, .more = jerk_limited},
    // accelerations that the chip can only round, or without enough distance to reach the velocity
    {.speed = 100, .accel = 17},
    {.speed = 100, .accel = 3333.3},
    {.speed = 100, .accel = 77'777, .start = 299},
    {.speed = 37.123, .accel = 1, .start = 280},
    // near the limit, between whole pulses, at the limit
    {.speed = 100, .start = 299.999},
    {.speed = 100, .start = 12.3456},
    {.speed = 50, .start = 0.0049, .min = -17.0011, .max = 17.0009},
    {.speed = 50, .start = 0.0049, .min = -17.0011, .max = 17.0009, .direction = -1},
    {.speed = 100, .start = 300},
    // velocities that change often
    {.speed = 100, .next_speed = 5},
    {.speed = 100, .next_speed = 60, .every = 0.011},
    {.speed = 100, .accel = 200, .next_speed = 99, .every = 0.004},
    {.speed = 100, .accel = 200, .start = 300, .direction = -1, .next_speed = 0.7, .every = 0.03},
    // overrides that change on the way
    {.speed = 100, .overrides = true},
    {.speed = 100, .start = 300, .direction = -1, .overrides = true, .more = jerk_limited},
};

class JogToTheLimit : public testing::TestWithParam<JogCase> {};

TEST_P(JogToTheLimit, StopsWithinAPulseOfItAndNeverBeyond) {
    const JogCase& one = GetParam();
    const Seen seen = jog_on(one);
    EXPECT_LE(seen.beyond, 1e-9);
    const double limit = one.direction > 0 ? one.max : one.min;
    EXPECT_LT(std::fabs(limit - seen.commanded), 1 / pulses_per_mm + 1e-9);
    EXPECT_LE(seen.apart, 0.5 / pulses_per_mm + 1e-9) << "no step was lost; a start may be between two pulses";
    EXPECT_LE(seen.end_velocity, 2.1 + 0.002 * one.accel) << "it ends with a ramp down to the velocity step";
    EXPECT_EQ(seen.conditions, "");
    EXPECT_TRUE(seen.position_valid);
    EXPECT_EQ(seen.state, MachineState::standstill);
}

INSTANTIATE_TEST_SUITE_P(Cases, JogToTheLimit, testing::ValuesIn(jog_cases));

TEST(ContinuousJog, AtALimitIsRejectedTowardsItAndAcceptedAwayFromIt) {
    Operated o(rack_of({.start = 300}));
    o.at(0.1, [](Machine& m) { static_cast<void>(m.manual().jog('X', 20)); });
    o.at(0.2, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_THAT(m.status().reason, HasSubstr("it is at the + end of its travel, 300 mm; move it in - direction"));
        EXPECT_DOUBLE_EQ(o.x(), 300);
        EXPECT_TRUE(m.manual().jog('X', -20));
    });
    o.run(1);
    EXPECT_LT(o.x(), 299);
}

TEST(ContinuousJog, WithoutAValidPositionHasNoSoftLimit) {
    Operated o(router());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', -10)); });
    o.run(0.2);
    EXPECT_FALSE(o.machine->status().axes[0].position_valid);
    EXPECT_LT(o.x(), -0.5);
}

TEST(Machine, JogsEveryAxisOfTheRouterWithoutALostStep) {
    for (const char* profile : {"trapezoid", "jerk_limited"})
        for (const double speed : {3.0, 20.0, 50.0})
            for (std::size_t i = 0; i < 4; ++i) {
                rack::RackConfig config = router();
                config.controller.profile = profile;
                Operated o(config);
                const char letter = config.axes[i].letter;
                const double way = letter == 'Z' ? -1 : 1;
                o.at(0.05, [](Machine& m) {
                    for (const AxisStatus& axis : m.status().axes)
                        EXPECT_TRUE(m.manual().set_position(axis.letter, axis.true_position));
                });
                for (double t = 0.1; t < 0.4; t += 0.05)
                    o.at(t, [=](Machine& m) { EXPECT_TRUE(m.manual().jog(letter, way * speed)); });
                o.run(1);
                const AxisStatus& axis = o.machine->status().axes[i];
                EXPECT_TRUE(axis.position_valid) << letter << ' ' << profile << ' ' << speed;
                EXPECT_NEAR(axis.true_position, axis.commanded, 1e-6) << letter << ' ' << profile << ' ' << speed;
                EXPECT_TRUE(o.machine->status().alarms.empty());
            }
}

/// The first line of a path has one pulse, and its AX1, at the limit switch, none; AX1 is not part of the next line.
TEST(LimitSwitch, EndsAPathWhoseFirstAxisIsOnIt) {
    rack::RackConfig config = router();
    config.controller.profile = "jerk_limited";
    Operated o(config);
    o.at(0.05, [](Machine& m) {
        for (const AxisStatus& axis : m.status().axes)
            EXPECT_TRUE(m.manual().set_position(axis.letter, axis.true_position));
    });
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 1, 10)); });
    o.at(1, [](Machine& m) { EXPECT_TRUE(m.wires().force("X.limit_plus", 0)); });
    o.at(1.2, [](Machine& m) { m.reset({}); });
    o.at(1.5, [](Machine& m) {
        control::Point to = m.stream().interpreter().position();
        to[0] += 0.11, to[1] += 0.7, to[2] -= 1.3;
        EXPECT_TRUE(m.manual().jog_to(to, 50));
    });
    o.run(3);
    EXPECT_EQ(o.states.back(), "error stop");
    EXPECT_THAT(o.machine->status().reason, HasSubstr("axis X: the + limit switch was reached"));
    EXPECT_LT(o.stood_since, 1.5) << "nothing moved at a speed that no line has";
}

}  // namespace
}  // namespace motionrack::operate
