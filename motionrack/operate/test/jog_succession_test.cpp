// A jog that is commanded while the one before it ends, at any instant of that end.
#include <gtest/gtest.h>

#include <cmath>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using FirstJog = Result<void> (*)(Machine&, double distance);

struct Succession {
    double moved_idle = 0;  ///< mm moved while the machine reports that it is idle
    MachineState state = MachineState::disabled;
};

Succession jog_after(const rack::RackConfig& config, FirstJog first, double distance, double then_s) {
    MachineSettings settings;
    settings.slice = microseconds(100);  // short: commands also arrive while a jog ends
    Operated o(config, std::move(settings));
    Succession seen;
    o.at(0.05, [](Machine& m) {
        for (const AxisStatus& axis : m.status().axes)
            EXPECT_TRUE(m.manual().set_position(axis.letter, axis.true_position));
    });
    o.at(0.1, [=](Machine& m) { EXPECT_TRUE(first(m, distance)); });
    o.at(then_s, [](Machine& m) { static_cast<void>(m.manual().jog('X', 10, {"operator"})); });
    double before = 0;
    bool idle_before = false;
    o.each_status([&](const Status& status) {
        const double x = status.axes[0].commanded;
        const bool is_stationary = idle(status.state);
        if (is_stationary && idle_before) seen.moved_idle += std::fabs(x - before);
        before = x;
        idle_before = is_stationary;
    });
    o.run(then_s + 0.1);
    seen.state = o.machine->state();
    return seen;
}

void expect_never_called_standstill(const rack::RackConfig& config, FirstJog first, double ends_from_s,
                                    double ends_to_s) {
    for (double at = ends_from_s; at < ends_to_s; at += 0.0001) {
        SCOPED_TRACE(testing::Message() << "the next jog at " << at << " s");
        const Succession seen = jog_after(config, first, 0.3, at);
        EXPECT_LT(seen.moved_idle, 0.05);  // mm: a servo still settles
        EXPECT_EQ(seen.state, MachineState::standstill);
    }
}

Result<void> jog_by(Machine& m, double distance) {
    return m.manual().jog_by('X', distance, 100);
}

Result<void> jog_to(Machine& m, double distance) {
    control::Point target = m.stream().interpreter().position();
    target[0] += distance;
    return m.manual().jog_to(target, 100);
}

Result<void> release(Machine& m, double) {
    return m.manual().jog('X', 0);
}

TEST(JogSuccession, OfAPulseAxisNeverReportsStandstill) {
    expect_never_called_standstill(two_axes(), jog_by, 0.158, 0.168);
    expect_never_called_standstill(two_axes(), jog_to, 0.158, 0.168);
}

TEST(JogSuccession, OfAServoNeverReportsStandstill) {
    expect_never_called_standstill(carriage(), release, 0.1, 0.105);
}

TEST(JogSuccession, EndsAtOnceWhereAStopComesWhileItsAxisIsTakenOver) {
    for (double stop = 0.1001; stop < 0.11; stop += 0.0005) {
        SCOPED_TRACE(testing::Message() << "the stop at " << stop << " s");
        MachineSettings settings;
        settings.slice = microseconds(100);
        Operated o(carriage(), std::move(settings));
        o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 0)); });
        o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 50)); });
        o.at(stop, [](Machine& m) { m.cancel(); });
        o.run(0.6);
        EXPECT_EQ(o.machine->state(), MachineState::standstill);
        EXPECT_LT(std::fabs(o.x()), 3) << "a jog of a whole lease takes it 12 mm";
    }
}

}  // namespace
}  // namespace motionrack::operate
